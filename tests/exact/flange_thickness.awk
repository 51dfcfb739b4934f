# input/flange_pair.bdf with rings of thickness T (there 16), in elements of half a millimetre along the radius.
#
#    awk -v t=8 -f flange_thickness.awk input/flange_pair.bdf
function ny() { return t < 4 ? 2 * t : t < 10 ? t : 10 }
/^\$/ { next }
/^SUBCASE 2/ { skip = 1 }
/^BEGIN BULK/ { skip = 0 }
skip || /^FORCEM/ { next }
/^BLOCK2/ { ring++; printf "BLOCK2,%d,1,80,%d,20.0,%.6f\n", ring, ny(), ring == 1 ? 0 : t; next }
/^\+ +60\.0/ { printf "+,60.0,%.6f%s\n", ring * t, ring == 1 ? "" : ",,,,,10001,10001"; next }
/^CROD/ { printf "CROD,90001,90,%d,%d\n", 40 * (ny() + 1) + 1, 10001 + 40 * (ny() + 1) + ny(); next }
/^BOLT/ { sub(/901 /, "90001") }
{ print }
