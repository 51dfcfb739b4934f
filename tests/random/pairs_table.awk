# The decks by what is in them: by method and kind, by feature, by pair of features.
#
#     awk -v matrix=FILE -f pairs_table.awk TALLIES

$1 == "DECK" {
   decks++
   if ($6 > 0) bad++
   of[$3, $4]++; not_solved[$3, $4] += $5 == "unsolved"; wrong[$3, $4] += $6 > 0
   for (k = 7; k <= NF; k++) {
      if (!($k in place)) { place[$k] = ++n; name[n] = $k }
      with[$k]++
      wrong_with[$k] += $6 > 0
      for (l = 7; l < k; l++) { both[$l, $k]++; both[$k, $l]++; if ($6 > 0) { wrong_both[$l, $k]++; wrong_both[$k, $l]++ } }
   }
}

END {
   printf "%-8s %-6s %8s %10s %10s\n", "method", "model", "decks", "no answer", "violations"
   split("STEP NEWTON BACK", method, " ")
   split("plane axi space", kind, " ")
   for (i = 1; i <= 3; i++) for (j = 1; j <= 3; j++) if (of[method[i], kind[j]])
      printf "%-8s %-6s %8d %10d %10d\n", method[i], kind[j], of[method[i], kind[j]], not_solved[method[i], kind[j]], wrong[method[i], kind[j]]
   printf "%-15s %8d %10s %10d\n", "all", decks, "", bad
   least = 1e9
   for (i = 1; i <= n; i++) {
      line = line sprintf("%s%s %d/%d", i > 1 ? ", " : "", name[i], with[name[i]], wrong_with[name[i]])
      printf "%-9s", name[i] > matrix
      for (j = 1; j < i; j++) {
         pairs += both[name[i], name[j]] > 0
         if (both[name[i], name[j]] && both[name[i], name[j]] < least) least = both[name[i], name[j]]
         printf " %s:%d/%d", name[j], both[name[i], name[j]], wrong_both[name[i], name[j]] > matrix
      }
      print "" > matrix
   }
   print "decks/violations with: " line
   print pairs " pairs of features, each in " least " decks or more"
}
