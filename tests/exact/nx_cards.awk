# A flange of two plates and two bolts as NX writes it (form=nx) or in cards of this program (form=own): x 0 to 40, y 0 to 20, plates of
# thickness 10 on each other, elements 10 x 10 x 10. Each bolt is a bar between spiders on the outer faces. source: BSURFS, BCPROPS.
function node(plate, i, j, k) { return plate * 1000 + i * 100 + j * 10 + k + 1 }
function face(e, plate, i, j, k) { return sprintf("%d,%d,%d", node(plate, i, j, k), node(plate, i + 1, j, k), node(plate, i + 1, j + 1, k)) }
BEGIN {
   if (form == "nx") printf "SOL 101\nCEND\nTITLE = FLANGE\nSPC = 1\nLOAD = 1\nBOLTLD = 2\nBCSET = 10\n"
   else printf "TITLE = FLANGE\nMETHOD = NEWTON\nSPC = 1\nSUBCASE 1\n  LABEL = BOLT PRELOAD\nSUBCASE 2\n  LOAD = 1\n"
   print "BEGIN BULK"
   for (p = 1; p <= 2; p++) {
      for (i = 0; i <= 4; i++) for (j = 0; j <= 2; j++) for (k = 0; k <= 1; k++)
         printf "GRID,%d,,%d.,%d.,%d.\n", node(p, i, j, k), 10 * i, 10 * j, 10 * (p - 1 + k)
      for (i = 0; i < 4; i++) for (j = 0; j < 2; j++) {
         e = p * 1000 + i * 10 + j + 1
         printf "CHEXA,%d,%d,%d,%d,%d,%d,%d,%d\n,%d,%d\n", e, p, node(p, i, j, 0), node(p, i + 1, j, 0), node(p, i + 1, j + 1, 0),
            node(p, i, j + 1, 0), node(p, i, j, 1), node(p, i + 1, j, 1), node(p, i + 1, j + 1, 1), node(p, i, j + 1, 1)
         if (form == "own") printf "CQUAD4,%d,%d,%s,%d\n", 5000 + e, 20 + p, face(e, p, i, j, 2 - p), node(p, i, j + 1, 2 - p)
         else list[p] = list[p] sprintf(",%d,%s%s", e, face(e, p, i, j, 2 - p), (n[p]++ % 2 == 0) ? "\n" : "")
      }
      printf "PSOLID,%d,1\n", p
   }
   print "MAT1,1,210000.,,.3"
   for (b = 1; b <= 2; b++) {
      x = b == 1 ? 1 : 3
      printf "GRID,%d,,%d.,10.,-5.\nGRID,%d,,%d.,10.,25.\nCBAR,%d,90,%d,%d,1.,,\n", 9000 + b, 10 * x, 9010 + b, 10 * x, 9100 + b, 9000 + b, 9010 + b
      printf "RBE2,%d,%d,123", 9200 + b, 9000 + b
      for (j = 0; j <= 2; j++) printf ",%d", node(1, x, j, 0)
      printf ",%d\nRBE2,%d,%d,123", node(1, b == 1 ? 0 : 4, 1, 0), 9210 + b, 9010 + b
      for (j = 0; j <= 2; j++) printf ",%d", node(2, x, j, 1)
      printf ",%d\n", node(2, b == 1 ? 0 : 4, 1, 1)
   }
   print "PBAR,90,1,50.,200.,200.,400."
   for (i = 0; i <= 4; i += 2) {
      printf "SPC1,1,123,%d,%d\nFORCE,1,%d,,300.,.2,0.,1.\n", node(1, i, 0, 0), node(1, i, 2, 0), node(2, i, 2, 1)
   }
   if (form == "nx") {
      print "BCTADD,10,11\nBCTSET,11,7,8,.15,0.,1.\nBCTPARM,11,PENN,10.\nBOLT,1,1,9101\nBOLT,2,1,9102\nBOLTFOR,2,5000.,1,THRU,2"
      if (source == "BSURFS") {
         for (p = 1; p <= 2; p++) {
            m = split(list[p], rows, "\n")
            printf "BSURFS,%d,,,%s\n", 9 - p, rows[1]
            for (k = 2; k < m; k++) print rows[k]
            if (rows[m] != "") print rows[m]
         }
      } else print "BCPROPS,7,2\nBCPROPS,8,1"
   } else {
      print "PMARK,21\nPMARK,22\nJOINT,1,1,22,21,1.\nJGAP,1,TRUE\nBOLT,1,9101,5000.,1\nBOLT,2,9102,5000.,1"
      while ((getline line < law) > 0) print line
   }
   print "ENDDATA"
}
