# A mesh of column.geo in free field as input of CalculiX: CTETRA with ten nodes, supports on surface 21, 10 kN along y uniform over
# surface 22: a straight triangle with six nodes loads each of its three mid-side nodes with a third.
#
#    awk -f column.awk MESH > NAME.inp
BEGIN { FS = "," }
function twice_area(a, b, c,   u, v, w) {
   u = (y[b] - y[a]) * (z[c] - z[a]) - (z[b] - z[a]) * (y[c] - y[a])
   v = (z[b] - z[a]) * (x[c] - x[a]) - (x[b] - x[a]) * (z[c] - z[a])
   w = (x[b] - x[a]) * (y[c] - y[a]) - (y[b] - y[a]) * (x[c] - x[a])
   return sqrt(u^2 + v^2 + w^2)
}
/^GRID/ { node[++nodes] = $2; x[$2] = $4; y[$2] = $5; z[$2] = $6; next }
/^CTETRA/ { head = $2 ", " $4 ", " $5 ", " $6 ", " $7 ", " $8 ", " $9; next }
/^\+/ { body[++bodies] = head ", " $2 ", " $3 ", " $4 ", " $5; next }
/^CTRIA6/ && $3 == 21 { for (k = 4; k <= 9; k++) held[$k] }
/^CTRIA6/ && $3 == 22 { a = twice_area($4, $5, $6) / 2; area += a; for (k = 7; k <= 9; k++) share[$k] += a / 3 }
END {
   print "*NODE, NSET=NODES"; for (k = 1; k <= nodes; k++) print node[k] ", " x[node[k]] ", " y[node[k]] ", " z[node[k]]
   print "*ELEMENT, TYPE=C3D10, ELSET=ALL"; for (k = 1; k <= bodies; k++) print body[k]
   print "*MATERIAL, NAME=BODY\n*ELASTIC\n120000., 0.26\n*SOLID SECTION, ELSET=ALL, MATERIAL=BODY\n*BOUNDARY"
   for (k in held) print k ", 1, 3"
   print "*STEP\n*STATIC\n*CLOAD"; for (k in share) printf "%d, 2, %.12g\n", k, 10000 * share[k] / area
   print "*NODE PRINT, NSET=NODES\nU\n*END STEP"
}
