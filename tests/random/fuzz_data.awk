# Files of test data for jointfit, made from files of test data at random.
#
#     awk -v seed=N -v from=A -v to=B -v folder=OUT -f random.awk -f data.awk DATA...
#
# Writes OUT/data_A.dat ... OUT/data_B.dat and prints a line for each: its number, the options of jointfit, a colon, what was done.

FNR == 1 { files++; name[files] = FILENAME; sub(/.*\//, "", name[files]) }
{ sub(/\r$/, ""); rows[files] = FNR; row[files, FNR] = $0 }

# Rows beyond the heading: any but the comments
function some_row(   k, i) {
   for (i = 1; i <= 20; i++) {
      k = 1 + random(n)
      if (line[k] ~ /^[-+ 0-9.]/) return k
   }
   return 1 + random(n)
}

function insert(k, new,   i) {
   for (i = n; i > k; i--) line[i + 1] = line[i]
   line[k + 1] = new
   n++
}

# Entry f of line k becomes `new`; f = 0: any.
function put_entry(k, f, new,   at, parts, width, i) {
   parts = 0
   at = 1
   while (match(substr(line[k], at), /[^ \t;,]+/)) {
      parts++
      place[parts] = at + RSTART - 1; size[parts] = RLENGTH
      at += RSTART + RLENGTH - 1
   }
   if (!parts || f > parts) return ""
   if (!f) f = 1 + random(parts)
   old = substr(line[k], place[f], size[f])
   if (new == "times") { new = old; sub(/,/, ".", new); new = new * factor }
   line[k] = substr(line[k], 1, place[f] - 1) new substr(line[k], place[f] + size[f])
   return old
}

function change(what,   k, j, i, kept, f, old) {
   k = some_row()
   if (what < 3) { kept = extreme_real(); old = put_entry(k, 0, kept); return "'" old "' to '" kept "'" }
   if (what < 6) { factor = chance("0 -1 0.5 2 1E3 1E-3 1E30 1E-30 1.01 0.99 1E200"); put_entry(k, 0, "times"); return "an entry times " factor }
   if (what == 6) { line[k] = ""; return "a row less" }
   if (what == 7) { insert(k, line[k]); return "a row twice" }
   if (what == 8) { j = some_row(); kept = line[k]; line[k] = line[j]; line[j] = kept; return "two rows swapped" }
   if (what == 9) {
      f = 1 + random(5); factor = chance("0 -1 1E3 1E-3 1E6 1E-6 1E30 1E-30 1E150 1E-150 1E-200 1E300")
      for (i = 1; i <= n; i++) if (line[i] ~ /^[-+ 0-9.]/) put_entry(i, f, "times")
      return "column " f " times " factor
   }
   if (what == 10) { n = 1 + random(n); return "the first rows" }
   if (what == 11) {
      for (i = 1; i <= n; i++) if (line[i] ~ /^[-+ 0-9.]/ && random(3)) line[i] = ""
      return "some rows"
   }
   if (what == 12) {
      k = 1 + random(n)
      put_entry(k, 0, chance("lambda p d tau c1 c2 c3 run branch LOAD UNLOAD RELOAD [mm] [um] [MPa] [N] UNITS = - p[bar] 1 2 3 A \377 \303\244"))
      return "a word"
   }
   if (what == 13) { insert(random(n), chance("p;lambda d,tau,p UNITS=mm,N UNITS=um,MPa # $ 1;2 1 1,2,3,4,5,6,7 ; , \001 lambda;p c1;c2;c3;p;branch") ); return "a line more" }
   if (what == 14) { for (i = 1; i <= n; i++) gsub(/[;,\t]/, " ", line[i]); return "blanks for separators" }
   if (what == 15) { for (i = 1; i <= n; i++) line[i] = line[n + 1 - i] ; return "the first half mirrored" }
   if (what == 16) {
      j = 1 + random(files)
      for (i = 1; i <= rows[j]; i++) line[n + i] = row[j, i]
      n += rows[j]
      return "and " name[j]
   }
   if (what == 17) { j = 1 + random(length(line[k])); line[k] = substr(line[k], 1, j) long_text(chance("1 X ; \t"), chance("1 2 40 5000")) substr(line[k], j + 1); return "text put in" }
   if (what == 18) { f = 1 + random(5); kept = extreme_real(); for (i = 1; i <= n; i++) if (line[i] ~ /^[-+ 0-9.]/) put_entry(i, f, kept); return "column " f " all " kept }
   line[k] = substr(line[k], 1, random(length(line[k])) + 1)
   return "a row cut"
}

function options(   i, out, one) {
   for (i = random(4); i > 0; i--) {
      one = chance("--units --joint-fit --one-pressure --p-tolerance --branch --as --dmax --id --large --small --zero --unordered --noise --decimal-comma --plot")
      if (one == "--units") one = one " " chance("mm,n mm,kgf m,n in,lbf mm n,mm x,y")
      else if (one == "--p-tolerance" || one == "--noise") one = one " " chance("0.01 0.05 0.5 0.9 1E-9 0 1 1E9")
      else if (one == "--branch" || one == "--as") one = one " " chance("LOAD UNLOAD RELOAD load X")
      else if (one == "--dmax") one = one " " chance("0.01 0.02 20 1E-6 1E6 0 -1 1E300")
      else if (one == "--id") one = one " " chance("1 7 2147483647 2147483646 99999999 0 -1 2147483648 1000000")
      else if (one == "--plot") one = one " fit.gp"
      out = out " " one
   }
   return out
}

END {
   for (copy = from; copy <= to; copy++) {
      start_random(copy)
      source = 1 + random(files)
      n = rows[source]
      for (i = 1; i <= n; i++) line[i] = row[source, i]
      what = name[source]
      for (times = random(5); times > 0; times--) what = what ", " change(random(20))
      file = folder "/data_" copy ".dat"
      printf "" > file
      for (i = 1; i <= n; i++) print line[i] > file
      close(file)
      gsub(/[^ -~]/, "?", what)
      print copy options() ":", substr(what, 1, 150)
   }
}
