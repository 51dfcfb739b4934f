# Bolts as bars of the foot (foot.geo), from its mesh in free field (-F, and OFS=,): CROD with BOLT between the reference nodes of two
# RBE3, one on washer 31 to 34, one on the wall of threaded hole 35 to 38. Nodes at the middle of edges alone have a part in them: on
# triangles of second order an even pressure has no forces at corners.

$1 == "GRID" { x[$2] = $4; y[$2] = $5; z[$2] = $6; last = $2 > last ? $2 : last; next }
$1 == "CTRIA6" && $3 >= 31 && $3 <= 38 {
   for (i = 7; i <= 9; i++) if (!seen[$3, $i]++) node[$3, ++nodes[$3]] = $i
}
END {
   for (bolt = 1; bolt <= 4; bolt++) {
      spider(bolt, 30 + bolt)
      spider(bolt + 4, 34 + bolt)
      print "CROD", 900000 + bolt, 90, last + bolt, last + bolt + 4
      print "PMARK", 30 + bolt
      print "PMARK", 34 + bolt
      print "BOLT", bolt, 900000 + bolt, "60000.0", 1
   }
}

# The reference node number LAST + K at the centre of the nodes of surface PID.
function spider(k, pid,    i, n, s, line) {
   n = nodes[pid]
   if (!n) { print "foot_spiders.awk: no faces of surface " pid > "/dev/stderr"; exit 1 }
   for (i = 1; i <= n; i++) { s = node[pid, i]; sx[k] += x[s]/n; sy[k] += y[s]/n; sz[k] += z[s]/n }
   printf "GRID,%d,,%.4f,%.4f,%.4f\n", last + k, sx[k], sy[k], sz[k]
   line = "RBE3," 900010 + k ",," last + k ",123,1.0,123"
   for (i = 1; i <= n; i++) {
      line = line "," node[pid, i]
      if (i % 8 == 2 && i < n) { print line; line = "+" }
   }
   print line
}
