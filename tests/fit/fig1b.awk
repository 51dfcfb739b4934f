# Points of a shear test as in Fig. 1(b), O-A-1-A-B-2-B-C-3, at each of p = 0.2, 0.4, 0.6: loading by the cubic a, unloading and
# reloading by b, each branch of N points from the last point of the previous one.
#
#    awk -v form=FORM [-v n=8] -f fig1b.awk
#
# FORM: record (d tau p), run (numbered branches), words (branches and numbers), stretches (branches), unloading (only the three
# unloading branches of each pressure, numbered), turned (a record of a test that first loads in the negative sense).
function load(d, p)   { return (60 + 100 * p) * d - (500 + 300 * p) * d^2 + 1000 * d^3 }
function unload(d, p) { return (40 + 90 * p) * d + (100 + 50 * p) * d^2 + 2000 * d^3 }
function row(d, tau, branch) {
   if (form == "turned") { d = -d; tau = -tau }
   if (form == "unloading" && branch != "UNLOAD") return
   printf "%.17g %.17g %.17g", d, tau, p
   if (form == "words" || form == "stretches") printf " %s", branch
   if (form == "run" || form == "words" || form == "unloading") printf " %d", run
   print ""
}
BEGIN {
   if (!n) n = 8
   print "d tau p" (form ~ /words|stretches/ ? " branch" : "") (form ~ /run|words|unloading/ ? " run" : "")
   for (i = 1; i <= 3; i++) {
      p = 0.2 * i; run = 1; from = 0
      row(0, 0, "LOAD")
      for (k = 1; k <= 3; k++) {
         to = 0.01 * k; back = 0.6 * to
         for (j = 1; j <= n; j++) { d = from + (to - from) * j / n; row(d, load(d, p), "LOAD") }
         b0 = load(to, p) - unload(to, p)
         run++
         for (j = 1; j <= n; j++) { d = to + (back - to) * j / n; row(d, b0 + unload(d, p), "UNLOAD") }
         run++
         for (j = 1; j <= n && k < 3; j++) { d = back + (to - back) * j / n; row(d, b0 + unload(d, p), "RELOAD") }
         from = to
      }
   }
}
