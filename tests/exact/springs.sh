# Bars and springs in one model: a block between two springs below and two rods above, pressed evenly by 12 (nu = 0). What the springs
# take and the rods give follows from three stiffnesses in a row.
cards springs <<'DECK'
SPC = 1;SUBCASE 1;  LOAD = 10;  INCR = 5
BEGIN BULK;BLOCK2,1,1,1,1,0.0,0.0;+,8.0,5.0;PSHELL,1,1,2.0;MAT1,1,9500.0,,0.0;GRID,52,,0.0,15.0;GRID,54,,8.0,15.0
CONROD,92,2,52,1,1.5;CONROD,94,4,54,1,1.5;CELAS2,81,700.0,1,2;CELAS2,83,700.0,3,2;SPC1,1,1,1;SPC1,1,12,52,54
FORCE,10,2,,6.0,0.0,-1.0;FORCE,10,4,,6.0,0.0,-1.0;JINCR,5,2;ENDDATA
DECK
run springs && {
   rod=$(number '9500*1.5/10') block=$(number '9500*2*8/5/2')         # of half the block
   below=$(number "1/(1/700 + 1/$block)")                              # half the block on its spring
   top=$(number "6/($rod + $below)")                                   # how far the top goes down
   last() { table springs "$1" | awk -v id="$2" -v c="$3" '{ for (k = 2; k <= 3; k++) if ($k == id) v = $c } END { print v }'; }
   for id in 92 94; do near "bars and springs: rod $id" "$(last 'BOLT FORCES' $id 5)" "$rod*$top" 2e-6; done
   for id in 81 83; do near "bars and springs: spring $id" "$(last 'FORCES OF SPRINGS' $id 6)" "-$below*$top" 2e-6; done
   same 'rods are no springs' "$(table springs 'FORCES OF SPRINGS' | grep -c '^ *[12]  *9[24]')" 0
   same 'springs are no rods' "$(table springs 'BOLT FORCES' | grep -c '^ *[12]  *8[13]')" 0
   same 'rods are no bolts' "$(ls "$work"/springs.bolt.csv 2> /dev/null) $(grep -c '^ *BOLT ' "$work/springs.out")" ' 1'
}

