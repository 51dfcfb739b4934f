#!/usr/bin/env bash
# The surfaces of input/surfaces: jointfem reads every file, and every number on its cards is computed again from the original
# constants in its comments.
#
#    surfaces.sh JOINTFEM
set -u
export LC_ALL=C

if [ $# -ne 1 ] || [ ! -x "$1" ]; then
   echo 'usage: surfaces.sh JOINTFEM' >&2
   exit 2
fi
jointfem=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
surfaces=$(cd "$here/../../input/surfaces" && pwd)
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 2
passed=0 failed=0

pass() { passed=$((passed + 1)); }
fail() { failed=$((failed + 1)); echo "FAILED: $1"; }

# deck NID SID FILE...: a small deck whose joint has the laws NID and SID (blank: none), and that includes the files
deck() {
   local nid=$1 sid=$2 file
   shift 2
   printf '%s\n' 'UNITS = MM, KGF' 'SPC = 1' 'SUBCASE 1' '  LOAD = 10' '  INCR = 5' 'BEGIN BULK' \
      'BLOCK2  1       1       2       1       0.0     0.0' '+       20.0    10.0' '+       20      21' 'PMARK   20' 'PMARK   21' \
      'PSHELL  1       1       10.0' 'MAT1    1       9500.0          0.25' 'JOINT   1       1       20' \
      'SPCM    1       1       21' 'FORCE   10      6               100.0   0.0     -1.0' 'JINCR   5       5' \
      'JNORM   1       0.008   0.5'
   printf 'PJOINT  1       %-8s%-8s%s\n' "$nid" "$sid" "$sid"
   for file in "$@"; do echo "INCLUDE '$file'"; done
   echo ENDDATA
}

# accepted TITLE: deck.bdf is in order; skipped where jointfem does not know JSHEAR yet
accepted() {
   if "$jointfem" --check deck.bdf > said 2>&1; then pass
   elif grep -q "'JSHEAR' is no card" said; then echo "skipped: $1: jointfem does not know JSHEAR yet"
   else fail "$1"; head -n 6 said; fi
}

# ---- read by jointfem ----

for file in "$surfaces"/*/*.bdf; do
   name=${file#"$surfaces"/}
   id=$(sed -n 's/^J[A-Z]*\** *\([0-9]*\).*/\1/p' "$file" | sort -u)
   nid=1 sid=
   grep -q '^JNORM' "$file" && nid=$id
   grep -q '^JSHEAR' "$file" && sid=$id
   deck "$nid" "$sid" "$file" > deck.bdf
   accepted "$name"
   if grep -q -F "| ${name#mm_*/} | $id |" "$surfaces/README.md"; then pass; else fail "$name: not in README.md with id $id"; fi
done
for folder in mm_kgf mm_n; do
   deck 9101 9106 "$surfaces/$folder"/*.bdf "$surfaces"/as_printed/*.bdf > deck.bdf
   accepted "all of $folder in one deck"
done
deck 9121 '' "$surfaces"/mm_kgf/paper_prism.bdf "$surfaces"/mm_n/paper_prism.bdf > deck.bdf
if "$jointfem" --check deck.bdf > said 2>&1; then fail 'two unit systems in one deck are taken'; else pass; fi
a=$(cd "$surfaces/mm_kgf" && echo *) b=$(cd "$surfaces/mm_n" && echo *)
if [ "$a" = "$b" ] && [ "$(echo "$a" | wc -w)" -eq 9 ]; then pass; else fail 'the same nine files in mm_kgf and mm_n'; fi

# ---- the conversion, again ----

for file in "$surfaces"/mm_*/*.bdf; do
   name=${file#"$surfaces"/}
   { grep '^\$' "$file"; awk -f "$here/card_values.awk" "$file"; } > numbers
   awk -v folder="${name%%/*}" '
      # a constant, or the mean of a range
      function mean(text,   ends, n) { n = split(text, ends, "-"); return n == 2 ? (ends[1] + ends[2]) / 2 : text + 0 }
      function off(got, expected) { got = (got - expected) / expected; return got < 0 ? -got : got }
      function check(words, got, expected, tolerance) {
         if (!(off(got, expected) <= tolerance)) { print words ": " got ", expected " expected; bad = 1 } }
      /^\$ Constants/ { n = split($0, pair, "[ ,]+"); for (i = 3; i < n; i += 2) constant[pair[i]] = pair[i + 1] }
      /^\$ Unload .* E = 9500 kgf\/mm2 per mm/ { paper = 1 }
      /^\$ Units .* p in MPa/ { newton = 1 }
      /^\$ Units .* p in kgf\/cm2/ { newton = 0 }
      / k0 = / { for (i = 1; i < NF; i++) { if ($i == "k0") k0 = $(i + 2); if ($i == "k1") k1 = $(i + 2) } }
      /^\$ Fit error/ { end_error = $5; middle_error = substr($0, index($0, "kgf/cm2, ") + 9) + 0 }
      !/^\$/ { value[$1, $2] = $3; count++ }
      END {
         C = mean(constant["C"]); m = mean(constant["m"])
         # pascals in one unit of p: of the source, of the card
         source = newton ? 1e6 : 98066.5; card = folder == "mm_kgf" ? 9806650 : 1e6
         micrometre = 0.001
         check("c", value["JNORM", 2], C * micrometre * (card / source)^m, 5e-4)
         check("m", value["JNORM", 3], m, 1e-12)
         # EU: three times the slope of loading at 25 kgf/cm2; of the paper its E, 9500 kgf/mm2, over 1 mm
         p = 25 * 98066.5 / card
         check("EU", value["JNORM", 4], paper ? 9500 * 9806650 / card : 3 * p^(1 - m) / (m * value["JNORM", 2]), 5e-5)
         if (!("R" in constant)) { exit bad || count != 4 }
         R = mean(constant["R"]); S = mean(constant["S"])
         # least squares of (k0 + k1 p)/(p^S/R) - 1 over ln p from 1 to 25, summed at 20000 midpoints
         for (i = 0; i < 20000; i++) {
            p = exp(log(25) * (i + 0.5) / 20000); u = R * p^-S; v = u * p
            uu += u * u; uv += u * v; vv += v * v; su += u; sv += v
         }
         f0 = (su * vv - sv * uv) / (uu * vv - uv * uv); f1 = (uu * sv - uv * su) / (uu * vv - uv * uv)
         check("k0 of the comment", k0, f0, 1e-5); check("k1 of the comment", k1, f1, 1e-5)
         for (p = 1; p <= 25.0001; p += 0.001) {
            e = (f0 + f1 * p) * R / p^S - 1
            if (e > most) most = e
            if (e < least) least = e
         }
         check("largest error of the comment", end_error, 100 * most, 0.005)
         check("error at p = 5 of the comment", middle_error, 100 * least, 0.005)
         stiffness = source / (card * micrometre)
         check("a11", value["JSHEAR", 2], f0 * stiffness, 2e-5)
         check("a12", value["JSHEAR", 3], f1 * stiffness * card / source, 2e-5)
         for (k = 4; k <= 7; k++) if (value["JSHEAR", k] != 0) { print "a quadratic or cubic term"; bad = 1 }
         check("PMAX", value["JSHEAR", 25], 25 * source / card, 2e-5)
         exit bad || count != 12
      }' numbers > said
   if [ $? -eq 0 ]; then pass; else fail "$name: the conversion"; cat said; fi
done

# the joint of the paper is the one on the cards of the prism
grep -h '^JNORM' "$surfaces/mm_kgf/paper_prism.bdf" | awk -v name=JNORM -f "$here/card_values.awk" | awk '$2 == 2 || $2 == 3' > paper
grep -h '^JNORM' "$here/../../input/prism05.bdf" | awk -v name=JNORM -f "$here/card_values.awk" | tail -n 2 > prism
if [ "$(wc -l < prism)" -eq 2 ] && cmp -s paper prism; then pass; else fail 'paper_prism.bdf has other constants than prism05.bdf'; fi

# Sanad: the lines once more, by the formulas of regression, from the cubics in the comments
file=$surfaces/as_printed/steel_ground_sanad.bdf
{ sed -n 's/^\$ \(Cubics\)\{0,1\} *\(p [0-9]*:\)/\2/p' "$file" | tr ';' '\n'; awk -f "$here/card_values.awk" "$file"; } | awk '
   $1 == "p" { n++; gsub(/[:,]/, " "); p = $2; sx += p; sxx += p * p; for (k = 1; k <= 3; k++) { sy[k] += $(k + 2); sxy[k] += p * $(k + 2) } }
   $1 == "JSHEAR" { value[$2] = $3; count++ }
   END { for (k = 1; k <= 3; k++) {
            b = (n * sxy[k] - sx * sy[k]) / (n * sxx - sx * sx); a = (sy[k] - b * sx) / n
            if ((value[2 * k] / a - 1)^2 > 1e-18 || (value[2 * k + 1] / b - 1)^2 > 1e-18) { print "a" k ": " a " + " b " p"; bad = 1 } }
         exit bad || n != 5 || count != 8 || value[25] != 128 }' > said
if [ $? -eq 0 ]; then pass; else fail 'as_printed/steel_ground_sanad.bdf: the lines'; cat said; fi
if diff <(sed 's/,//g; s/;/\n/g' "$file" | grep -o 'p [0-9]*: .*' | tr -d ':' | awk '{ print $2 + 0, $3 + 0, $4 + 0, $5 + 0 }') \
        <(awk '$5 == "RELOAD" { print $1 + 0, $2 + 0, $3 + 0, $4 + 0 }' "$here/sanad.dat") > said; then pass
else fail 'as_printed/steel_ground_sanad.bdf: the cubics of tests/fit/sanad.dat'; cat said; fi

echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
