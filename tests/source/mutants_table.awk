#!/usr/bin/awk -f
# Prints the results of mutants.sh (standard input) as tables: how many were noticed, by which tests, by folder, by kind; and the
# survivors.
BEGIN { FS = "\t" }
$2 == "unbuilt" { unbuilt++; next }
{
   n++
   folder = $3; sub(/^src\//, "", folder); sub(/\/.*/, "", folder)
   drawn[folder]++; drawn[$4]++; folders[folder]; operators[$4]
   if ($2 == "survived") { left++; alive[folder]++; alive[$4]++; list = list "\n" $3 ": " $4 "\n   was  " $5 "\n   is   " $6 }
   else fates[$2]++
}
function row(name) { printf "| %s | %d | %d |\n", name, drawn[name], alive[name] | "sort"; }
END {
   print "| noticed by | mutants |\n|---|---|"
   for (f in fates) { name = f; sub(/^killed by:? */, "", name); printf "| %s | %d |\n", name, fates[f] | "sort" }
   close("sort")
   print "\n| folder | mutants | survived |\n|---|---|---|"
   for (f in folders) row(f)
   close("sort")
   print "\n| change | mutants | survived |\n|---|---|---|"
   for (f in operators) row(f)
   close("sort")
   if (left) print "\nSurvivors:" list
   printf "\n%d mutants, %d did not build and do not count, %d survived: %.1f %%\n", n, unbuilt, left, (n > 0 ? 100*left/n : 0)
   if (n == 0) exit 1
}
