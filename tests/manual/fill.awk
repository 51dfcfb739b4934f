# The second pass: {{contents}}, {{NAME}} of notes, {{3.1}} the largest difference of a case.
#    awk -f numbers.awk -f fill.awk -v notes=FILE -v found=FILE DRAFT DRAFT
BEGIN {
   while ((getline line < notes) > 0) { name = line; sub(/ .*/, "", name); sub(/^[^ ]* /, "", line); value[name] = line }
   while ((getline line < found) > 0) {
      split(line, f, " ")
      if (!(f[1] in worst) || f[2] + 0 > worst[f[1]]) worst[f[1]] = f[2] + 0
      if (!(f[1] in floors) || f[3] + 0 > floors[f[1]]) floors[f[1]] = f[3] + 0
   }
   for (c in worst) { d = difference_text(worst[c], floors[c]); sub(/^\+/, "", d); value[c] = d }
}
NR == FNR {
   if (/^```/) fence = !fence
   if (!fence && /^##+ [0-9]/) { title = $0; sub(/^#+ /, "", title); contents = contents (/^###/ ? "   - [" : "- [") title "](#" anchor(title) ")\n" }
   next
}
/^{{contents}}$/ { printf "%s", contents; blank = 0; next }
/^$/ && blank { next }
{
   blank = /^$/
   while (match($0, /{{[^}]*}}/)) {
      name = substr($0, RSTART + 2, RLENGTH - 4)
      if (!(name in value)) { print "nothing is known of {{" name "}}" > "/dev/stderr"; exit 1 }
      $0 = substr($0, 1, RSTART - 1) value[name] substr($0, RSTART + RLENGTH)
   }
   print
}
