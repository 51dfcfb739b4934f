# The history of the elements whose numbers the first file lists, of one JOINT, a block each that begins at rest:
# lambda, p, delta_x, tau_x, delta_y, tau_y. The first line of a block names the element and its node.
BEGIN { FS = "," }
FILENAME != ARGV[1] && FNR == 1 { for (i = 1; i <= NF; i++) column[$i] = i; next }
FILENAME == ARGV[1] { chosen[++n] = $1; rows[$1] = "0,0,0,0,0,0\n"; next }
$column["joint"] == joint && ($column["element"] in rows) {
   e = $column["element"]
   node[e] = $column["node1"]
   rows[e] = rows[e] sprintf("%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", $column["lambda"], $column["pressure"], $column["delta_x"], \
      $column["tau_x"], $column["delta_y"], $column["tau_y"])
}
END {
   for (k = 1; k <= n; k++) {
      if (k > 1) print "\n"
      printf "element %s at node %s\n%s", chosen[k], node[chosen[k]], rows[chosen[k]]
   }
}
