# A column of thin walls, 200 x 200 x 600 with walls of 6, clamped below, open above; 1000 along x and a torque at the corners of its top:
#    awk -v n=16 -v m=48 [-v ccx=1 [-v modes=5]] [-v modes=5] -f calculix_box.awk
# n elements a wall, m along it: CQUAD4 of this program, or S8R of CalculiX, each of which takes the nodes of 2 x 2 of them but the middle.
function id(i, k) { return 1 + i % w + w*k }
function grid(i, k,   q, t) {
   q = int(i/n); t = -100 + 200*(i % n)/n
   printf ccx ? "%d, %.9f, %.9f, %.9f\n" : "GRID,%d,,%.9f,%.9f,%.9f\n", id(i, k), \
      q == 0 ? t : q == 1 ? 100 : q == 2 ? -t : -100, q == 0 ? -100 : q == 1 ? t : q == 2 ? 100 : -t, 600*k/m
}
function force(i, x, y) {
   if (ccx) printf "%d, 1, %s\n%d, 2, %s\n", id(i, m), x, id(i, m), y
   else printf "FORCE,1,%d,,1.0,%.1f,%.1f,0.0\n", id(i, m), x, y
}
BEGIN {
   w = 4*n
   if (ccx) print "*NODE, NSET=NODES"
   else printf "MODEL = SPACE\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n%sBEGIN BULK\nEIGRL,5,,,%d\nMAT1,1,210000.0,,0.3,7.85-9\nPSHELL,1,1,6.0,1,,1\n", modes ? "  MODES = 5\n" : "", modes ? modes : 1
   for (k = 0; k <= m; k++) for (i = 0; i < w; i++) if (!ccx || !(i % 2 && k % 2)) grid(i, k)
   if (ccx) {
      print "*ELEMENT, TYPE=S8R, ELSET=WALLS"
      for (k = 0; k < m; k += 2) for (i = 0; i < w; i += 2)
         printf "%d, %d, %d, %d, %d, %d, %d, %d, %d\n", ++e, id(i, k), id(i + 2, k), id(i + 2, k + 2), id(i, k + 2), id(i + 1, k), id(i + 2, k + 1), id(i + 1, k + 2), id(i, k + 1)
      print "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n*DENSITY\n7.85E-9\n*SHELL SECTION, ELSET=WALLS, MATERIAL=STEEL\n6.\n*BOUNDARY"
      for (i = 0; i < w; i++) print id(i, 0) ", 1, 6"
      print modes ? "*STEP\n*FREQUENCY\n" modes "\n*END STEP" : "*STEP\n*STATIC\n*CLOAD"
      if (modes) exit
   } else for (i = 0; i < w; i++) print "SPC1,1,123456," id(i, 0)
   if (!ccx) for (k = 0; k < m; k++) for (i = 0; i < w; i++) printf "CQUAD4,%d,1,%d,%d,%d,%d\n", ++e, id(i, k), id(i + 1, k), id(i + 1, k + 1), id(i, k + 1)
   force(0, 350, -100); force(n, 350, 100); force(2*n, 150, 100); force(3*n, 150, -100)
   print ccx ? "*NODE PRINT, NSET=NODES\nU\n*END STEP" : "ENDDATA"
}
