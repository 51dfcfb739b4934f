#!/usr/bin/env bash
# The paper's findings on the prism (section 6.1, Fig. 7), each asserted from the joint histories of the four decks, and the
# numbers of an independent computation (a dense stiffness matrix of the same mesh, written in another language).
#
#    prism_findings.sh FOLDER_WITH_THE_CSV_FILES
set -u
folder=$1
awk -F, '
function test(ok, words) { if (ok) passed++; else { failed++; print "FAILED " words } }
function near(a, b, digits) { return (a - b < 0 ? b - a : a - b) <= 0.5 * 10^(-digits) * (b < 0 ? -b : b) * 10 }
FNR == 1 {
   n = FILENAME; sub(/.*prism/, "", n); sub(/\.joint.*/, "", n); n += 0
   for (i = 1; i <= NF; i++) c[$i] = i
   next
}
{
   l[n, $c["node1"]] = $c["lambda"]; p[n, $c["node1"]] = $c["pressure"]; b[n, $c["node1"]] = $c["branch"]
   key = n SUBSEP $c["increment"]
   force[key] += $c["force"]; fraction[key] = $c["load"]
   if ($c["branch"] == "OPEN") open[key]++
   last[n] = $c["increment"]
   rows++
}
END {
   test(rows == 11 * (3 + 5 + 10 + 15), "11 interface elements in every increment of every deck")
   # independent computation, 6 digits
   test(near(l[5, 51], 7.62013e-3, 6), "prism05: lambda at node 51 is 7.62013E-3 mm")
   test(near(p[5, 51], 0.574067, 6), "prism05: p at node 51 is 0.574067 kgf/mm2")
   test(b[5, 1] == "OPEN", "prism05: node 1 is open")
   test(b[5, 6] == "UNLOAD", "prism05: node 6 is on the unloading branch")
   test(near(l[3, 51], 9.406482e-3, 6) && near(p[3, 51], 0.543063, 6), "prism03: lambda 9.40648E-3, p 0.543063 at node 51")
   test(near(l[10, 51], 6.921697e-3, 6) && near(p[10, 51], 0.588122, 6), "prism10: lambda 6.92170E-3, p 0.588122 at node 51")
   test(near(l[15, 51], 6.775946e-3, 6) && near(p[15, 51], 0.591572, 6), "prism15: lambda 6.77595E-3, p 0.591572 at node 51")
   # the deflection of node 51 falls steadily as 3, 5, 10, 15 increments are used
   test(l[3, 51] > l[5, 51] && l[5, 51] > l[10, 51] && l[10, 51] > l[15, 51], "deflection of node 51 falls with the increments")
   # much from 3 to 5, little from 10 to 15
   test(l[3, 51] - l[5, 51] > 5 * (l[10, 51] - l[15, 51]), "it falls much from 3 to 5 and little from 10 to 15")
   # the pressures of nodes 36 to 51 rise, those of nodes 6 to 26 fall
   split("3 5 10 15", decks, " ")
   for (k = 1; k < 4; k++) {
      for (node = 36; node <= 51; node += 5)
         test(p[decks[k + 1], node] > p[decks[k], node], "pressure of node " node " rises from " decks[k] " to " decks[k + 1])
      for (node = 6; node <= 26; node += 5)
         test(p[decks[k + 1], node] < p[decks[k], node] || b[decks[k], node] == "OPEN" && b[decks[k + 1], node] == "OPEN", \
            "pressure of node " node " falls from " decks[k] " to " decks[k + 1] ", or the node stays open")
   }
   # the joint carries every increment of the load in which no element was removed
   for (k = 1; k <= 4; k++) {
      n = decks[k]
      for (i = 1; i <= last[n]; i++) {
         now = n SUBSEP i; before = n SUBSEP (i - 1)
         if (open[now] > open[before]) continue
         change = 800 * (fraction[now] - fraction[before])
         test(force[now] - force[before] - change < 1e-10 * 800 && force[now] - force[before] - change > -1e-10 * 800, \
            "prism" n ", increment " i ": joint force and load rise alike")
      }
   }
   print passed + 0 " passed, " failed + 0 " failed"
   exit failed > 0 || passed == 0
}' "$folder"/prism03.joint.csv "$folder"/prism05.joint.csv "$folder"/prism10.joint.csv "$folder"/prism15.joint.csv
