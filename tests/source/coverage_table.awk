# Turns the text of gcov -t (count:line:text, one source after another) into the table of coverage.sh.
BEGIN {
   while ((getline line < explained) > 0) {
      if (line ~ /^ *(#|$)/) continue
      if (split(line, part, / *\| */) != 3) { print explained ": not FILE | TEXT | CLASS: " line; wrong = 1; continue }
      n_rules++
      rule_file[n_rules] = part[1]; rule_text[n_rules] = part[2]; rule_class[n_rules] = part[3]
   }
}

{ count = $0; sub(/:.*/, "", count); gsub(/[ *]/, "", count)
  rest = substr($0, index($0, ":") + 1)
  number = rest; sub(/:.*/, "", number); number += 0
  text = substr(rest, index(rest, ":") + 1) }

number == 0 {
   if (text ~ /^Source:/) { file = substr(text, 8); ours = index(file, sources "/") == 1 }
   next
}

# The end of a module is what the compiler adds to it: copies and comparisons of its types
!ours || count == "-" || text ~ /^ *end (module|submodule|subroutine|function)/ { next }

# A source can come more than once: a line ran if it did in any of them.
{
   key = file SUBSEP number
   if (!(key in ran)) { ran[key] = 0; what[key] = text; order[++n_lines] = key; of_file[n_lines] = file }
   if (count !~ /^[#=]/ && count + 0 > 0) ran[key] = 1
}

END {
   for (i = 1; i <= n_lines; i++) {
      all[of_file[i]]++
      if (all[of_file[i]] == 1) files[++n_files] = of_file[i]
      done[of_file[i]] += ran[order[i]]
      total_done += ran[order[i]]
   }
   if (n_lines == 0) { print "no line was counted"; exit 1 }
   printf "%-40s %7s %7s %8s\n", "file", "lines", "ran", "%"
   for (i = 1; i <= n_files; i++) printf "%-40s %7d %7d %8.1f\n", files[i], all[files[i]], done[files[i]], 100*done[files[i]]/all[files[i]] | "sort"
   close("sort")
   print "\nLines that did not run:"
   for (i = 1; i <= n_lines; i++) {
      if (ran[order[i]]) continue
      split(order[i], at, SUBSEP)
      class = class_of(at[1], what[order[i]])
      classes[class]++
      line = what[order[i]]; sub(/^ +/, "", line)
      printf "%s:%d: [%s] %s\n", at[1], at[2], class, line
   }
   print ""
   for (class in classes) printf "%5d  %s\n", classes[class], class | "sort -k 2"
   close("sort -k 2")
   for (i = 1; i <= n_rules; i++) if (!(i in used)) { print explained ": no such line is left: " rule_file[i] " | " rule_text[i]; }
   percent = 100*total_done/n_lines
   printf "\n%d of %d lines ran: %.2f %%\n", total_done, n_lines, percent
   if (percent < least) { print "less than " least " %"; wrong = 1 }
   if ("unexplained" in classes) { print classes["unexplained"] " lines are not explained in " explained; wrong = 1 }
   exit wrong
}

function class_of(file, text,    i, rule) {
   sub(/^ +/, "", text); sub(/ +$/, "", text)
   for (i = 1; i <= n_rules; i++) {
      if (substr(file, length(file) - length(rule_file[i]) + 1) != rule_file[i]) continue
      rule = rule_text[i]
      if (rule == text || matches(text, rule)) { used[i]; return rule_class[i] }
   }
   return "unexplained"
}

# RULE with a `*` before or behind: TEXT holds it there
function matches(text, rule,    from, to) {
   from = substr(rule, 1, 1) == "*"
   to = substr(rule, length(rule)) == "*"
   if (!from && !to) return 0
   rule = substr(rule, 1 + from, length(rule) - from - to)
   if (from && to) return index(text, rule) > 0
   if (to) return index(text, rule) == 1
   return length(text) >= length(rule) && substr(text, length(text) - length(rule) + 1) == rule
}
