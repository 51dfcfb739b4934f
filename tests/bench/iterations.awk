# Of a listing: one line with HEAD, the number of increments, of iterations, the most iterations of an increment, the increments that
# were divided as STAGE.INCREMENT with commas between, or -, and SECONDS. The parts of a divided increment count as iterations. ONLY: of
# this stage.

/^ CONVERGENCE HISTORY, STAGE / { stage = $4 + 0; on = only == "" || stage == only; next }
/^ [A-Z]/ { on = 0 }
on && $2 == "..." { count[stage "." $1] += $3; iterations += $3; next } # rows that the listing leaves out
on && $1 + 0 > 0 && NF >= 6 {
   key = stage "." $1
   if (!(key in count)) increments++
   count[key]++
   iterations++
   if (count[key] > most) most = count[key]
   if ($2 > 1 && !(key in split_up)) { split_up[key] = 1; list = list (list == "" ? "" : ",") key }
}
END { print head, increments + 0, iterations + 0, most + 0, list == "" ? "-" : list, seconds }
