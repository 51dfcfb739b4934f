# The mesh of a foot with cut bolts (foot.geo, free field) as input of CalculiX: surface to surface contact of linear law, normal 1.0E5,
# shear 2.4E4 N/mm3, MU 0.15; four pretension sections of 60 kN, locked in the second step; 5 kN at the top.
#
#    awk -F, -f foot_ccx.awk MESH > NAME.inp

$1 == "GRID" { node[++nodes] = $2; x[$2] = $4; y[$2] = $5; z[$2] = $6; last = $2 > last ? $2 : last; next }
$1 == "CTRIA6" {
   if ($3 == 24) for (k = 4; k <= 9; k++) held[$k]
   if ($3 == 25) { a = area($4, $5, $6); top += a; for (k = 7; k <= 9; k++) share[$k] += a/3 }
   if ($3 <= 23 || $3 > 40) pid[key($4, $5, $6)] = $3
   next
}
$1 == "CTETRA" { id = $2; body = $3; for (k = 1; k <= 6; k++) n[k] = $(k + 3); next }
$1 ~ /^\+E/ {
   elements[body] = elements[body] id ", " n[1] ", " n[2] ", " n[3] ", " n[4] ", " n[5] ", " n[6] ", " $2 ", " $3 ", " $4 ", " $5 "\n"
   face(1, n[1], n[2], n[3]); face(2, n[1], n[4], n[2]); face(3, n[2], n[4], n[3]); face(4, n[3], n[4], n[1])
}
END {
   print "*NODE, NSET=NODES"
   for (k = 1; k <= nodes; k++) print node[k] ", " x[node[k]] ", " y[node[k]] ", " z[node[k]]
   for (k = 1; k <= 4; k++) print last + k ", 0., 0., 0."          # reference nodes of the sections
   for (body = 1; body <= 4; body++) printf "*ELEMENT, TYPE=C3D10, ELSET=B%d\n%s", body, elements[body]
   for (k = 20; k <= 44; k++) if (k in surface) printf "*SURFACE, NAME=S%d\n%s", k, surface[k]
   print "*MATERIAL, NAME=IRON\n*ELASTIC\n120000., 0.26\n*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3"
   for (body = 1; body <= 4; body++) print "*SOLID SECTION, ELSET=B" body ", MATERIAL=" (body < 4 ? "IRON" : "STEEL")
   print "*SURFACE INTERACTION, NAME=JOINT\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1.E5, 1.\n*FRICTION\n0.15, 2.4E4"
   print "*CONTACT PAIR, INTERACTION=JOINT, TYPE=SURFACE TO SURFACE\nS20, S21\n*CONTACT PAIR, INTERACTION=JOINT, TYPE=SURFACE TO SURFACE\nS22, S23"
   for (k = 1; k <= 4; k++) print "*PRE-TENSION SECTION, SURFACE=S4" k ", NODE=" last + k
   print "*BOUNDARY"
   for (k in held) print k ", 1, 3"
   print "*STEP, INC=500\n*STATIC\n0.2, 1.\n*CLOAD"
   for (k = 1; k <= 4; k++) print last + k ", 1, -60000."          # the normal points out of the half above
   print "*NODE PRINT, NSET=NODES, FREQUENCY=999\nU\n*END STEP"
   print "*STEP, INC=500\n*STATIC\n0.1, 1., , 0.1\n*BOUNDARY, FIXED"
   for (k = 1; k <= 4; k++) print last + k ", 1, 1"
   print "*CLOAD"
   for (k in share) printf "%d, 1, %.10g\n%d, 3, %.10g\n", k, 4000*share[k]/top, k, -3000*share[k]/top
   print "*NODE PRINT, NSET=NODES, FREQUENCY=999\nU\n*END STEP"
}

function area(a, b, c,   u, v, w) {
   u = (y[b] - y[a])*(z[c] - z[a]) - (z[b] - z[a])*(y[c] - y[a])
   v = (z[b] - z[a])*(x[c] - x[a]) - (x[b] - x[a])*(z[c] - z[a])
   w = (x[b] - x[a])*(y[c] - y[a]) - (y[b] - y[a])*(x[c] - x[a])
   return sqrt(u^2 + v^2 + w^2)/2
}

# Three numbers of nodes in order, as one word
function key(a, b, c,   t) {
   a += 0; b += 0; c += 0
   if (a > b) { t = a; a = b; b = t }
   if (b > c) { t = b; b = c; c = t }
   if (a > b) { t = a; a = b; b = t }
   return a " " b " " c
}

# Face SIDE of the tetrahedron; of a section, that of the element above it
function face(side, a, b, c,   f) {
   f = key(a, b, c)
   if (!(f in pid)) return
   if (pid[f] > 40 && z[n[1]] + z[n[2]] + z[n[3]] + z[n[4]] < 60) return
   surface[pid[f]] = surface[pid[f]] id ", S" side "\n"
}
