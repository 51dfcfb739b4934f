# Which folder of src uses modules of which other one, as src/README.md shows it.
#
#    awk -f folder_uses.awk src/*/*.f90

FNR == 1 {
   parts = split(FILENAME, part, "/")
   folder = part[parts - 1]
   module = part[parts]
   sub(/\.f90$/, "", module)
   home[module] = folder
}
$1 == "use" { used = $2; sub(/,.*/, "", used); users[++n] = folder; modules[n] = used }
END {
   count = split("base element joint deck model build solver serial mpi increment vibration result run fit", order, " ")
   for (i = 1; i <= n; i++) if (modules[i] in home) edge[users[i], home[modules[i]]]
   line = sprintf("%-12s", "")
   for (k = 1; k <= count - 2; k++) line = line "  " order[k]
   print line
   for (i = 2; i <= count; i++) {
      line = sprintf("%-12s", order[i])
      for (k = 1; k <= count - 2; k++) {
         width = length(order[k])
         left = int((width - 1)/2)
         mark = order[k] != order[i] && (order[i], order[k]) in edge ? "x" : " "
         line = line sprintf("  %" left "s%s%" width - left - 1 "s", "", mark, "")
      }
      sub(/ +$/, "", line)
      print line
   }
}
