# RFORCE: forces of rotation, m w^2 r outwards and -m dw/dt r across, on bodies, rings, shells, beams and masses at nodes.

w2='(2*3.14159265358979324*5.0)^2' rho='7.85e-9'
# the sum of the loads is the mass times w^2 times the place of its centre
spun() { # NAME LINES: a deck whose axis is z through node 1000 at (10, -20, 5)
   cards "$1" <<DECK
MODEL = ${3:-SPACE};SPC = 1;SUBCASE 1;  LOAD = 1;BEGIN BULK;MAT1,1,210000.0,,0.3,7.85-9;GRID,1000,,10.0,-20.0,${4:-5.0}
$2;RFORCE,1,1000,,5.0,0.0,0.0,1.0;+,3.0;ENDDATA
DECK
   run "$1"
}
sums() { # WORDS NAME MASS X Y: a body whose centre is at (X, Y)
   near "$1: x" "$(total "$2" LOADS 1)" "$3*($w2*($4 - 10) + 2*3.14159265358979324*3*($5 + 20))" 3e-5
   near "$1: y" "$(total "$2" LOADS 2)" "$3*($w2*($5 + 20) - 2*3.14159265358979324*3*($4 - 10))" 3e-5
}
for order in 1 2; do
   spun solid "BLOCK3,1,1,3,2,2,40.0,30.0,0.0;+,70.0,50.0,10.0;+,5,,,,,,,$order;PMARK,5;SPCM,1,123,5;PSOLID,1,1" &&
      sums "solid of order $order" solid "$rho*30*20*10" 55 40
   spun plane "BLOCK2,1,1,3,2,40.0,30.0;+,70.0,50.0;+,,,,5,,$order;PMARK,5;SPCM,1,12,5;PSHELL,1,1,10.0" PLANE 0.0 &&
      sums "plane body of order $order" plane "$rho*30*20*10" 55 40
done
spun shell 'GRID,1,,40.0,30.0,5.0;GRID,2,,70.0,30.0,5.0;GRID,3,,70.0,50.0,5.0;GRID,4,,40.0,50.0,5.0;CQUAD4,1,1,1,2,3,4;PSHELL,1,1,10.0,1,,1;SPC1,1,123456,1,4' &&
   sums 'shell' shell "$rho*30*20*10" 55 40
spun beam 'GRID,1,,40.0,30.0,5.0;GRID,2,,70.0,50.0,5.0;CBAR,1,1,1,2,0.0,0.0,1.0;PBAR,1,1,12.0,20.0,30.0,40.0;SPC1,1,123456,1;CONM2,9,2,,0.004' && {
   near 'beam and a mass: x' "$(total beam LOADS 1)" "$rho*12*sqrt(1300)*($w2*45 + 6*3.14159265358979324*60) + 0.004*($w2*60 + 6*3.14159265358979324*70)" 3e-5
   near 'beam and a mass: y' "$(total beam LOADS 2)" "$rho*12*sqrt(1300)*($w2*60 - 6*3.14159265358979324*45) + 0.004*($w2*70 - 6*3.14159265358979324*60)" 3e-5
}
# a thin ring: u = rho w^2 r^3/E; a bar from the axis out, held there: u = rho w^2 L^3/(3 E), and N at its root rho A w^2 L^2/2
cards ring <<'DECK'
MODEL = AXISYMMETRIC;SPC = 1;SUBCASE 1;  LOAD = 1;BEGIN BULK;MAT1,1,210000.0,,0.0,7.85-9;PAXIS,1,1
BLOCK2,1,1,1,1,999.5,0.0;+,1000.5,10.0;SPC1,1,2,1,3;RFORCE,1,,,5.0,0.0,1.0,0.0;ENDDATA
DECK
run ring && near 'a thin ring' "$(moved ring 1 1)" "$rho*$w2*1000^3/210000" 2e-3
cards bar <<'DECK'
MODEL = PLANE;SPC = 1;SUBCASE 1;  LOAD = 1;  OUTPUT = ALL;BEGIN BULK;MAT1,1,210000.0,,0.0,7.85-9;PSHELL,1,1,2.0
BLOCK2,1,1,40,1,0.0,-5.0;+,1000.0,5.0;+,,,,5;PMARK,5;SPCM,1,12,5;RFORCE,1,,,5.0,0.0,0.0,1.0;ENDDATA
DECK
run bar && near 'a bar that turns about its end' "$(moved bar 81 1)" "$rho*$w2*1000^3/(3*210000)" 1e-3
# half of it by LOAD, its axes by a system: the same forces
sed -e 's/^RFORCE.*/RFORCE,2,1000,7,5.0,0.0,1.0,0.0/; s/^+,3.0$/+,3.0\nLOAD,1,0.5,2.0,2\nCORD2R,7,,0.0,0.0,0.0,1.0,0.0,0.0\n+,0.0,1.0,0.0/' "$work/solid.bdf" > "$work/system.bdf"
run system && sums 'in a system, by LOAD' system "$rho*30*20*10" 55 40
# gravity on beams is what it was: q L/2 at both ends
cards heavy <<'DECK'
MODEL = SPACE;SPC = 1;SUBCASE 1;  LOAD = 1;BEGIN BULK;MAT1,1,210000.0,,0.3,7.85-9;GRID,1,,0.0,0.0,0.0;GRID,2,,1000.0,0.0,0.0
CBAR,1,1,1,2,0.0,0.0,1.0;PBAR,1,1,100.0,1000.0,1000.0,2000.0;SPC1,1,123456,1;GRAV,1,,9810.0,0.0,0.0,-1.0;ENDDATA
DECK
run heavy && near 'a heavy cantilever' "$(moved heavy 2 3)" "-$rho*100*9810*1000^4/(8*210000*1000)" 2e-5
