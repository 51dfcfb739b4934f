# The cards of a machine, from its mesh (first file, as Gmsh writes it in free field) and its piece (second file).
#
#    awk -F, -f zoo.awk MESH PIECE
#
# The piece holds cards, and lines
#
#    %bolt ID MARK1 MARK2 PRELOAD AREA          a bar between spiders on two marked surfaces, tightened in stage 1
#    %anchor ID MARK PRELOAD AREA LENGTH        the same from a marked surface down to the ground
#    %spring ID MARK1 MARK2 K1 K2 K3            springs along x, y, z at the centre of MARK1, between spiders on two surfaces
#
# and of sheets, whose elements are shells with the number PID (below 20):
#
#    %sheet PID T MID                           their property
#    %face MARK up|down PID...                  their upper or lower faces as a marked surface
#    %hold SET COMPONENTS PID                   their nodes supported
#    %clamp ID PID1 PID2 PRELOAD AREA           a bolt between spiders on their nodes
#
# Every marked surface gets its PMARK: surfaces have the numbers from 20 on, bodies those below. HELD BY and ORDER are for zoo.sh.

FNR == 1 { file++ }
file == 1 && $1 == "GRID" { x[$2, 1] = $4; x[$2, 2] = $5; x[$2, 3] = $6; next }
file == 1 && $1 ~ /^C(TRIA|QUAD)/ {
   elements[$3]++
   line[$3, elements[$3]] = $0
   if ($2 + 0 > last) last = $2 + 0
   if ($3 >= 20) marks[$3] = 1
   for (i = 4; i <= NF; i++) if (($i, 1) in x) {
      if (!(($3, $i) in member)) { member[$3, $i] = 1; node[$3, ++nodes[$3]] = $i }
      for (c = 1; c <= 3; c++) {
         if (!(($3, c) in low) || x[$i, c] < low[$3, c]) low[$3, c] = x[$i, c]
         if (!(($3, c) in high) || x[$i, c] > high[$3, c]) high[$3, c] = x[$i, c]
      }
   }
   next
}
file == 1 { next }
{ n = split($0, w, " ") }
w[1] == "%bolt" {
   spider(2*w[2], w[3], w[3])
   spider(2*w[2] + 1, w[4], w[4])
   bar(w[2], w[5], w[6])
   next
}
w[1] == "%anchor" {
   spider(2*w[2], w[3], w[3])
   printf "GRID,%d,,%.4f,%.4f,%.4f\n", 900001 + 2*w[2], centre(w[3], 1), centre(w[3], 2), centre(w[3], 3) - w[6]
   printf "SPC1,1,123,%d\n", 900001 + 2*w[2]
   bar(w[2], w[4], w[5])
   next
}
w[1] == "%spring" {
   spider(500 + 2*w[2], w[3], w[3])
   spider(501 + 2*w[2], w[4], w[3])
   printf "PBUSH,%d,K,%s,%s,%s\n", 800 + w[2], w[5], w[6], w[7]
   printf "CBUSH,%d,%d,%d,%d,,,,0\n", 980000 + w[2], 800 + w[2], 900500 + 2*w[2], 900501 + 2*w[2]
   next
}
w[1] == "%sheet" { printf "PSHELL,%d,%d,%s,%d\n", w[2], w[4], w[3], w[4]; next }
w[1] == "%face" {
   for (k = 4; k <= n; k++) for (i = 1; i <= elements[w[k]]; i++) {
      m = split(line[w[k], i], e, ",")
      up = (x[e[5], 1] - x[e[4], 1])*(x[e[6], 2] - x[e[4], 2]) - (x[e[5], 2] - x[e[4], 2])*(x[e[6], 1] - x[e[4], 1]) > 0
      text = e[1] "," ++last "," w[2] "," e[4]
      if (up == (w[3] == "up")) for (j = 5; j <= m; j++) text = text "," e[j]
      else                      for (j = m; j >= 5; j--) text = text "," e[j]
      print text
   }
   marks[w[2]] = 1
   next
}
w[1] == "%hold" { for (i = 1; i <= nodes[w[4]]; i++) printf "SPC1,%d,%s,%d\n", w[2], w[3], node[w[4], i]; next }
w[1] == "%clamp" {
   list(2*w[2], w[3])
   list(2*w[2] + 1, w[4])
   bar(w[2], w[5], w[6])
   next
}
w[1] ~ /^%/ { fail("what is " $0 "?") }
{ print }
END { if (!failed) for (i = 20; i < 1000; i++) if (i in marks) print "PMARK," i }

function fail(words) { print "zoo.awk: " words > "/dev/stderr"; failed = 1; exit 1 }
function centre(mark, c) { return (low[mark, c] + high[mark, c])/2 }

# A spider (RBE3) on surface MARK, its reference node at the middle of the extent of surface AT
function spider(k, mark, at) {
   if (!(mark in marks)) fail("no surface " mark)
   printf "GRID,%d,,%.4f,%.4f,%.4f\n", 900000 + k, centre(at, 1), centre(at, 2), centre(at, 3)
   printf "RBE3M,%d,%d,123,123,%d\n", 970000 + k, 900000 + k, mark
}

# A spider on the nodes of the shells PID
function list(k, pid,    i, text) {
   if (!(pid in nodes)) fail("no sheet " pid)
   printf "GRID,%d,,%.4f,%.4f,%.4f\n", 900000 + k, centre(pid, 1), centre(pid, 2), centre(pid, 3)
   text = "RBE3," 970000 + k ",," 900000 + k ",123,1.0,123"
   for (i = 1; i <= nodes[pid]; i++) {
      text = text "," node[pid, i]
      if (i % 8 == 2 && i < nodes[pid]) { print text; text = "+" }
   }
   print text
}

# The bar of bolt ID between the reference nodes 2 ID and 2 ID + 1
function bar(id, preload, area) {
   printf "PROD,%d,2,%s\nCROD,%d,%d,%d,%d\nBOLT,%d,%d,%s,1\n", 900 + id, area, 990000 + id, 900 + id, 900000 + 2*id, 900001 + 2*id, id, 990000 + id, preload
}
