# The block of the sweep under uniform pressure, in every combination of modulus, joint law, pressure, size and Poisson's ratio.
#
#     awk -v method=NEWTON -v folder=OUT -f sweep_decks.awk
#
# Writes OUT/d1.bdf, OUT/d2.bdf, ... and prints a line for each: number, E, c, m, p, size, nu.

BEGIN {
   n_e = split("1.0-6 1.0-3 1.0 1.0+3 2.1+5 1.0+10 1.0+15", e, " ")
   n_c = split("1.0-12 1.0-9 1.0-6 1.0-3 1.0 1.0+3 1.0+6", c, " ")
   n_m = split("0.001 0.1 0.5 1.0", m, " ")
   n_p = split("1.0-12 1.0 1.0+12", p, " ") # the sizes too
   split("-0.99 0.3 .4999999", nu, " ")
   for (i = 1; i <= n_e; i++) for (j = 1; j <= n_c; j++) for (k = 1; k <= n_m; k++) for (a = 1; a <= n_p; a++) for (b = 1; b <= n_p; b++)
      write_deck(++n, e[i], c[j], m[k], p[a], p[b], nu[1 + (a + b) % 3])
}

function write_deck(n, e, c, m, p, size, nu,   deck) {
   deck = folder "/d" n ".bdf"
   print "SPC = 1\nMETHOD = " method "\nSUBCASE 1\n  LOAD = 1\n  INCR = 1\n  OUTPUT = NONE\nBEGIN BULK" > deck
   printf "BLOCK2  1       1       2       2       0.0     0.0\n+       %-8s%-8s\n", size, size > deck
   print "+       20              22      23\nPMARK   20\nPMARK   22\nPMARK   23" > deck
   printf "PSHELL  1       1       %-8s\nMAT1    1       %-8s        %-8s\n", size, e, nu > deck
   printf "JOINT   1       1       20\nPJOINT  1       1\nJNORM   1       %-8s%-8s1.0+3\n", c, m > deck
   printf "SPCM    1       1       23\nPLOADM  1       %-8s22\nJINCR   1       1       ARITH   1.0\nENDDATA\n", p > deck
   close(deck)
   print n, value_of(e), value_of(c), value_of(m), value_of(p), value_of(size), value_of(nu)
}

# A number as NASTRAN writes it
function value_of(text) {
   if (text ~ /[0-9.][+-][0-9]/) sub(/[+-][0-9]+$/, "E&", text)
   return text + 0
}
