# NAME.stage.csv, NAME.out: prints every node of the largest pressure that differs between the table of increments and the answer.
FNR == 1 { split("", column); n_files++ }
n_files == 1 && FNR == 1 { for (i = split($0, title, ","); i > 0; i--) at[title[i]] = i; next }
n_files == 1 { split($0, cell, ","); if (cell[at["p_node"]] != "") node[cell[1], cell[2]] = cell[at["p_node"]]; next }
/^ INCREMENTS OF STAGE/ { stage = $4; on = 1; next }
/^ [A-Z]/ { on = 0 }
on && $1 ~ /^[0-9]+$/ { listed[stage, $4] = $9 }
END {
   for (k in node) { n++; if (listed[k] != node[k]) { split(k, id, SUBSEP); print "stage " id[1] ", joint " id[2] ": node " listed[k] " in the listing, " node[k] " in the answer" } }
   print "checked " n
}
