# The cards of a machine, from its mesh (first file, as Gmsh writes it in free field) and its piece (second file).
#
#    awk -F, -v mu=MU -v order=ORDER -f zoo.awk MESH PIECE
#
# The piece holds cards, and lines
#
#    %bolt ID MARK1 MARK2 PRELOAD AREA     a bar between spiders on two marked surfaces, tightened in stage 1
#    %spring ID MARK1 MARK2 K1 K2 K3       springs along x, y, z at the centre of MARK1, between spiders on two surfaces; MARK2 0: the ground
#
# Every mark gets its PMARK. Marks are numbered from 20 on, bodies below.

FNR == 1 { file++ }
file == 1 && $1 == "GRID" { x[$2, 1] = $4; x[$2, 2] = $5; x[$2, 3] = $6; nodes++; next }
file == 1 && $1 ~ /^C(TRIA|QUAD|ROD|BAR)/ && $3 >= 20 {
   for (i = 4; i <= NF; i++) if (($i, 1) in x) for (c = 1; c <= 3; c++) {
      if (!($3 in marks) || x[$i, c] < low[$3, c]) low[$3, c] = x[$i, c]
      if (!($3 in marks) || x[$i, c] > high[$3, c]) high[$3, c] = x[$i, c]
      if (c == 3) marks[$3] = 1
   }
   next
}
file == 1 { next }
{ gsub(/\$\{MU\}/, sprintf("%-8s", mu)); sub(/ +$/, "") }
/^%bolt / {
   split($0, w, " ")
   spider(2*w[2], w[3], w[3]); spider(2*w[2] + 1, w[4], w[4])
   printf "PROD,%d,2,%s\nCROD,%d,%d,%d,%d\nBOLT,%d,%d,%s,1\n", 900 + w[2], w[6], 990000 + w[2], 900 + w[2], 900000 + 2*w[2], 900001 + 2*w[2], w[2], 990000 + w[2], w[5]
   next
}
/^%spring / {
   split($0, w, " ")
   spider(500 + 2*w[2], w[3], w[3])
   if (w[4] > 0) spider(501 + 2*w[2], w[4], w[3])
   printf "PBUSH,%d,K,%s,%s,%s\nCBUSH,%d,%d,%d,%s,,,,0\n", 800 + w[2], w[5], w[6], w[7], 980000 + w[2], 800 + w[2], 900500 + 2*w[2], (w[4] > 0 ? 900501 + 2*w[2] : "")
   next
}
/^%/ { print "zoo.awk: what is " $0 "?" > "/dev/stderr"; failed = 1; exit 1 }
{ print }
END { if (!failed) for (i = 20; i < 1000; i++) if (i in marks) print "PMARK," i }

# A spider (RBE3) on surface MARK, its reference node at the middle of the extent of surface AT
function spider(k, mark, at) {
   if (!(mark in marks)) { print "zoo.awk: no surface " mark > "/dev/stderr"; failed = 1; exit 1 }
   printf "GRID,%d,,%.4f,%.4f,%.4f\n", 900000 + k, (low[at, 1] + high[at, 1])/2, (low[at, 2] + high[at, 2])/2, (low[at, 3] + high[at, 3])/2
   printf "RBE3M,%d,%d,123,123,%d\n", 970000 + k, 900000 + k, mark
}
