# The prism with different numbers of increments, from the joint histories: deflection and pressure along the interface after the
# last increment, a column for each deck.
#
#    awk -f prism_table.awk prism03.joint.csv prism05.joint.csv ...
BEGIN { FS = "," }
FNR == 1 {
   deck++
   name[deck] = FILENAME
   sub(/.*\//, "", name[deck])
   sub(/\.joint\.csv$/, "", name[deck])
   for (i = 1; i <= NF; i++) column[$i] = i
   next
}
{
   node = $column["node1"]
   if (!(node in known)) { known[node] = 1; nodes[++n] = node }
   lambda[deck, node] = $column["lambda"]
   pressure[deck, node] = $column["pressure"]
   branch[deck, node] = $column["branch"]
}
END {
   print ""
   print "  Deflection lambda of the interface nodes [1E-3 mm]"
   heading()
   for (i = 1; i <= n; i++) {
      line = sprintf("  %4d", nodes[i])
      for (d = 1; d <= deck; d++) line = line sprintf("%10.5f %-6s", 1000 * lambda[d, nodes[i]], mark(d, nodes[i]))
      print line
   }
   print ""
   print "  Pressure p [kgf/mm2]"
   heading()
   for (i = 1; i <= n; i++) {
      line = sprintf("  %4d", nodes[i])
      for (d = 1; d <= deck; d++) line = line sprintf("%10.6f %-6s", pressure[d, nodes[i]], mark(d, nodes[i]))
      print line
   }
   print ""
}
function heading(    d, line) {
   line = "  node"
   for (d = 1; d <= deck; d++) line = line sprintf("%10s       ", name[d])
   print line
}
function mark(d, node) { return branch[d, node] == "LOAD" ? "" : tolower(branch[d, node]) }
