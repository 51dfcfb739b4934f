# What supports take, card by card: forces and moments by statics, and by the tables of the listing.
reaction() { awk -F, -v s="$2" -v kind="$3" -v id="$4" -v c="$5" 'NR == 1 { for (k = 1; k <= NF; k++) at[$k] = k }
   $1 == s && $2 == kind && $3 == id { print $at[c] }' "$work/$1.reaction.csv"; }

# Statically determinate: a bar 100 x 10 x 10 pinned at its left end, on a roller at its right one, 600 down and 40 along at the top
cards reactions <<'DECK'
SPC = 5;LOAD = 10
BEGIN BULK;BLOCK3,1,1,4,1,1,0.0,0.0,0.0;+,100.0,10.0,10.0;+,31,32;PSOLID,1,1;MAT1,1,2.1E5,,0.3;PMARK,31;PMARK,32
SPC1,1,13,1,3;SPC1,2,3,17;SPC1,2,3,19;SPC,3,1,2,0.0,3,2,0.0;SPCADD,5,1,2,3
FORCE,10,6,,300.0,0.0,0.0,-1.0;FORCE,10,8,,300.0,0.0,0.0,-1.0;FORCE,10,6,,20.0,1.0;FORCE,10,8,,20.0,1.0;ENDDATA
DECK
run reactions && {
   near 'left bearing up' "$(reaction reactions 1 SPC1 1 force_z)" '600 - (600*25 + 40*10)/100' 1e-9
   near '... and along' "$(reaction reactions 1 SPC1 1 force_x)" -40 1e-9
   near 'right bearings up' "$(awk -F, '$2 == "SPC1" && $3 == 2 { f += $11 } END { printf "%.17g", f }' "$work/reactions.reaction.csv")" '(600*25 + 40*10)/100' 1e-9
   same 'two SPC1 cards, two rows; SPC cards of a set, one' "$(awk -F, '$2 ~ /SPC/ { printf "%s %s %s;", $2, $3, $5 }' "$work/reactions.reaction.csv")" \
        'SPC1 1 2;SPC1 2 1;SPC1 2 1;SPC 3 2;'
   near 'moment of all about y at the origin' "$(reaction reactions 1 ALL 0 moment_y)" '-(600*25 + 40*10)' 1e-9
   near 'moment of the loads there' "$(reaction reactions 1 LOADS 0 moment_y)" '600*25 + 40*10' 1e-12
}

# The sums of all cards are those of BALANCE OF FORCES, of supports in turned systems, rigid bases, reference nodes, springs.
for name in prism05 flange_sector bracket_spiders gib lap_joint slideway; do
   run_input "$name" || continue
   for c in 1 2 3; do
      case $c in 1) axis=x;; 2) axis=y;; 3) axis=z;; esac
      [ "$(total $name LOADS)" = "$(total $name LOADS $c)" ] && [ $c = 3 ] && grep -q 'MODEL PLANE' "$work/$name.out" && continue
      listed=$(for line in SUPPORTS 'RIGID BASES, THROUGH THE JOINTS' 'GROUND, THROUGH SPRINGS'; do total $name "$line" $c; done |
               awk '{ s += $1; a += $1^2 } END { printf "%.12g %.12g", s, sqrt(a) }')
      all=$(awk -F, -v k=ALL -v c=$((8 + c)) '$2 == k { v = $c } END { print v }' "$work/$name.reaction.csv")
      near "reactions of $name along $axis" "$all" "${listed% *}" 2e-5 "1e-5*${listed#* }+1e-4"
   done
   holds "moments of $name balance" "$(awk -F, '$2 == "ALL" { for (i = 12; i <= 14; i++) a[i] = $i } $2 == "LOADS" { for (i = 12; i <= 14; i++) { l = a[i] + $i
      d = l > 0 ? l : -l; if (d > worst) worst = d; m = $i > 0 ? $i : -$i; if (m > most) most = m } } END { printf "%.6g <= 0.05*%.6g", worst, most }' \
      "$work/$name.reaction.csv")"
done
# a card that holds rotations alone, one of them under a moment
cards held_rotation <<'DECK'
MODEL = SPACE;SPC = 1;SUBCASE 1;  LOAD = 1;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,1000.0,0.0,0.0;CBAR,1,1,1,2,0.0,1.0,0.0
PBAR,1,1,400.0,8.0+4,4.0+4,6.0+4;MAT1,1,210000.0,,0.3;SPC1,1,123456,1;SPC1,1,45,2;FORCE,1,2,,12.0,0.0,0.0,1.0;MOMENT,1,2,,8000.0,1.0,0.0,0.0;ENDDATA
DECK
run held_rotation && {
   near 'a held rotation: moment of the load on it' "$("$query" "$work/held_rotation.reaction.csv" rows 'kind = "SPC1" and x = 1000 within 1e-6' print moment_x)" -8000 1e-9
   near 'a held rotation: moment of the bar' "$("$query" "$work/held_rotation.reaction.csv" rows 'kind = "SPC1" and x = 1000 within 1e-6' print moment_y)" '12*1000/2' 1e-9
   near 'a held rotation: all moments' "$("$query" "$work/held_rotation.reaction.csv" rows 'kind = "ALL"' print moment_y)" '12*1000' 1e-9
}

# CJOINT between nodes that stand beside each other: its force has a moment that nothing balances, and a warning says so
cards beside <<'DECK'
METHOD = NEWTON;MODEL = SPACE;LOAD = 1;BEGIN BULK;GRID,1,,0.,0.,0.,,123456;GRID,2,,0.,0.,10.;GRID,3,,30.,0.,10.;GRID,4,,30.,0.,20.
CBAR,1,5,1,2,1.,0.,0.;CBAR,2,5,3,4,1.,0.,0.;PBAR,5,1,100.,800.,800.,1600.;MAT1,1,2.1+5,,.3;CJOINT,71,1,2,3,100.,0.,0.,1.;PJOINT,1,1,1,1,,,1.
JNORM,1,1.-3,.5,2.+4;JSHEAR,1,3.+3;CELAS2,7,1.+3,4,4;CELAS2,8,1.+3,4,5;CELAS2,9,1.+3,4,6;FORCE,1,4,,500.,0.,0.,-1.;ENDDATA
DECK
run beside && says 'a CJOINT with a lever' "$work/beside.log" 'the nodes of CJOINT 71 stand 30 beside each other, and nothing balances the moment'
