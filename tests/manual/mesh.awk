# Cards of a block of CQUAD4 or CQUAD8, explicitly, for decks that need the numbers of nodes at the middle of edges, or a block bent
# into a quarter of a ring (x is then the angle from pi/2 down to 0, y the radius).
#    awk -v kind=8 -v nx=5 -v ny=2 -v x0=0 -v y0=0 -v x1=50 -v y1=20 -v first=1 -v pid=1 [-v low=MARK] [-v high=MARK] [-v bent=1] -f mesh.awk
# Node (i, j), counted in half divisions, is FIRST + i + (2 nx + 1) j; elements and sides are numbered from FIRST.
function id(i, j) { return first + i + (2*nx + 1)*j }
function place(i, j,   x, y, angle) {
   x = x0 + (x1 - x0)*i/(2*nx); y = y0 + (y1 - y0)*j/(2*ny)
   if (bent) { angle = 2*atan2(1, 1)*(1 - x); x = i == 0 ? 0 : y*cos(angle); y = i == 2*nx ? 0 : y*sin(angle) }
   printf "GRID,%d,,%.14f,%.14f\n", id(i, j), x, y
}
BEGIN {
   for (j = 0; j <= 2*ny; j++) for (i = 0; i <= 2*nx; i++) if (kind == 8 ? i % 2 == 0 || j % 2 == 0 : i % 2 + j % 2 == 0) place(i, j)
   e = first - 1
   for (j = 0; j < 2*ny; j += 2) for (i = 0; i < 2*nx; i += 2) {
      corners = id(i, j) "," id(i + 2, j) "," id(i + 2, j + 2) "," id(i, j + 2)
      if (kind == 4) print "CQUAD4," ++e "," pid "," corners
      else print "CQUAD8," ++e "," pid "," corners "," id(i + 1, j) "," id(i + 2, j + 1) "\n+," id(i + 1, j + 2) "," id(i, j + 1)
   }
   for (i = 0; i < 2*nx; i += 2) {
      if (low) print "CBAR," ++e "," low "," id(i, 0) "," id(i + 2, 0)
      if (high) print "CBAR," ++e "," high "," id(i, 2*ny) "," id(i + 2, 2*ny)
   }
   if (low) print "PMARK," low
   if (high) print "PMARK," high
}
