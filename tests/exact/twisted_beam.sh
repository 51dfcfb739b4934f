# The twisted beam of MacNeal and Harder, of solid elements as a pre-processor writes them, IN and ISOP of PSOLID blank. Its end moves
# by 5.424E-3 under a unit force along its width, by 1.754E-3 across it.
# Source: R. H. MacNeal, R. L. Harder, A proposed standard set of problems to test finite element accuracy, Finite Elements in Analysis
# and Design 1 (1985) 3-20, Fig. 4 and Table 6.

for direction in 1 0; do
   exact=$([ $direction = 1 ] && echo 5.424e-3 || echo 1.754e-3)
   twisted twisted CHEXA $direction '' && near "twisted beam of CHEXA, ISOP blank, along the width: $direction" "$(tip twisted $direction)" $exact 0.01
   twisted twisted_modes CHEXA $direction MODES && near "twisted beam of CHEXA: blank is MODES, along the width: $direction" \
      "$(tip twisted_modes $direction)" "$(tip twisted $direction)" 0
   twisted twisted_plain CHEXA $direction PLAIN && holds "twisted beam of plain CHEXA is a sixth too stiff or more, along the width: $direction" \
      "$(tip twisted_plain $direction) < 0.84*$exact"
   twisted twisted_full CHEXA $direction FULL && near "twisted beam of CHEXA: FULL is PLAIN, along the width: $direction" \
      "$(tip twisted_full $direction)" "$(tip twisted_plain $direction)" 0
   twisted wedges CPENTA $direction '' && near "twisted beam of CPENTA, ISOP blank, along the width: $direction" "$(tip wedges $direction)" $exact 0.02
   twisted wedges_plain CPENTA $direction PLAIN && holds "twisted beam of plain CPENTA, along the width: $direction" \
      "$(tip wedges_plain $direction) < 0.84*$exact"
done
says 'twisted beam: the listing names the formulation of CHEXA' "$work/twisted.out" 'CHEXA OF 8 NODES, INCOMPATIBLE MODES  *576$'
says 'twisted beam: that of plain ones' "$work/twisted_full.out" 'CHEXA OF 8 NODES, PLAIN  *576$'
says 'twisted beam: that of CPENTA' "$work/wedges.out" 'CPENTA OF 6 NODES, INCOMPATIBLE MODES  *1152$'
