# The clamped flange pair with rings of different thickness: how far the faces touch beside the bolt circle, radius 40. The contact
# grows with the thickness and vanishes at the edges of thin rings; between stiff faces it spreads nearly as the 45-degree
# pressure cone of Roetscher (Die Maschinenelemente, 1927), from flexible ones farther.

source tests/exact/contact_edges.sh

# reach NAME-END C E_U T...: run the rings, collect the last edges
reach() {
   local c=$1 e_u=$2 t edges
   shift 2
   outers='' inners='' opens=''
   for t in "$@"; do
      awk -v t="$t" -f tests/exact/flange_thickness.awk input/flange_pair.bdf | sed "s/^JNORM.*/JNORM,1,$c,0.5,$e_u/" > "$work/flange.bdf"
      run flange || return 1
      read -r -a edges <<< "$(contact_edges "$query" "$work/flange.joint.csv")"
      inners="$inners ${edges[0]}" outers="$outers ${edges[1]}" opens="$opens ${edges[2]}"
      near "rings $t thick: the joint carries the preload" "${edges[3]}" 80000 1e-8
   done
}
# grows WORDS T VALUES: strictly, as numbers do
grows() {
   local values=($3) i all='1 = 1'
   for ((i = 1; i < ${#values[@]}; i++)); do all="$all and ${values[i]} > ${values[i - 1]}"; done
   holds "$1: $3 at $2" "${#values[@]} = $(wc -w <<< "$2") and ${#values[@]} > 1 and $all"
}

thin='2 3 4 5 6 8'
reach 1.0-3 2.0+5 $thin && {
   grows 'flexible faces: the contact reaches farther out as the rings are thicker' "$thin" "$outers"
   grows 'flexible faces: and farther in' "$thin" "$(for r in $inners; do number "60 - $r"; done)"
   grows 'flexible faces: fewer elements are open' "$thin" "$(for n in $opens; do printf '%d ' $((100 - n)); done)"
   set -- $outers
   holds 'rings 2 thick: nothing touches beyond the radius 45' "$1 < 45"
}
reach 1.0-3 2.0+5 16 && same 'rings 16 thick: the whole joint touches' "${opens# }" 0
stiff='3 4 5 6 8'
reach 1.0-5 2.0+7 $stiff && {
   grows 'stiff faces: the contact reaches farther out as the rings are thicker' "$stiff" "$outers"
   set -- $stiff
   for r in $outers; do
      holds "stiff faces, rings $1 thick: near the cone of 45 degrees" "($r - 40)/$1 = 0.95 within 0.15"
      shift
   done
}
