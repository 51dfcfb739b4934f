# Prints which folder of src uses modules of which other folder, for src/modules.md.
#
#    awk -v order="base element ..." -f folder_uses.awk src/*/*.f90

FNR == 1 {
   parts = split(FILENAME, part, "/")
   folder = part[parts - 1]
   module = part[parts]
   sub(/\.f90$/, "", module)
   home[module] = folder
}
$1 == "use" { used = $2; sub(/,.*/, "", used); users[++n] = folder; modules[n] = used }
END {
   count = split(order, name, " ")
   for (i = 1; i <= n; i++) if (modules[i] in home) edge[users[i], home[modules[i]]]
   line = sprintf("%-12s", "")
   for (k = 1; k <= count - 2; k++) line = line "  " name[k]
   print line
   for (i = 2; i <= count; i++) {
      line = sprintf("%-12s", name[i])
      for (k = 1; k <= count - 2; k++) {
         width = length(name[k])
         left = int((width - 1)/2)
         mark = name[k] != name[i] && (name[i], name[k]) in edge ? "x" : " "
         line = line sprintf("  %" left "s%s%" width - left - 1 "s", "", mark, "")
      }
      sub(/ +$/, "", line)
      print line
   }
}
