# Converts displacements of a CAX8 model into those in the plane: awk -f calculix_straighten.awk NAME.inp NAME.dat
#
# CalculiX makes a slice of 2 degrees of C3D20, and prints along x the mean over the nodes that one node has become: of a corner
# three, at -1, 0 and 1 degree, with the weights 1, 4 and 1, of a mid-side node two, at -1 and 1 degree. So it prints (2 + cos 1)/3
# of the radial displacement at corners, cos 1 between them: 5.1E-5 and 1.5E-4 less.
BEGIN { degree = atan2(0, -1) / 180; corner = (2 + cos(degree)) / 3; middle = cos(degree) }
FNR == NR && /^\*/ { inside = /TYPE=CAX8/; next }
FNR == NR { if (inside) { gsub(/,/, ""); for (k = 2; k <= 5; k++) is_corner[$k] } next }
NF == 4 && $1 + 0 == $1 { printf "%10d %13.6E %13.6E %13.6E\n", $1, $2 / ($1 in is_corner ? corner : middle), $3, $4; next }
{ print }
