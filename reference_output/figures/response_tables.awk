# From a response (NAME.response.csv), into FOLDER: `responses`, a line for each stage that has one; response.STAGE, a block for every
# component of a node that moves, with its name and frequency, amplitude. Amplitudes of zero are left out: their scale is logarithmic.
BEGIN { FS = "," }
FNR == 1 {
   for (i = 1; i <= NF; i++) column[$i] = i
   next
}
{
   stage = $column["stage"]
   amplitude = $column["amplitude"] + 0
   if (amplitude <= 0) next
   curve = stage SUBSEP $column["node"] SUBSEP $column["component"]
   if (!(stage in curves)) stages[++n_stages] = stage
   if (!(curve in rows)) {
      name[stage, ++curves[stage]] = curve
      title[curve] = "node " $column["node"] " " $column["component"]
   }
   rows[curve] = rows[curve] $column["frequency"] "," amplitude "\n"
}
END {
   for (n = 1; n <= n_stages; n++) {
      stage = stages[n]
      file = folder "/response." stage
      for (k = 1; k <= curves[stage]; k++)
         printf "%s\"%s\"\n%s", (k > 1 ? "\n\n" : ""), title[name[stage, k]], rows[name[stage, k]] > file
      close(file)
      print stage > (folder "/responses")
   }
}
