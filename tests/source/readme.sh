#!/usr/bin/env bash
# Checks src/README.md against src: the list of modules, src/modules.md, is current; snippets stand word for word in the patches;
# names exist. Also the links and blocks of all pages, the index of the decks and that of the cards, lines that are too long, and
# tolerances.
#
#    readme.sh README SOURCE_FOLDER
set -u
export LC_ALL=C
readme=$1 source=$2 here=tests/source
pages="$readme $source/additions.md"
narrow_pages='README.md input/*.md input/*/*.md src/*.md src/*/*.md tests/*.md tests/*/*.md reference_output/differs.md reference_output/*/*.md'
passed=0 failed=0
check() { if [ -z "$2" ]; then passed=$((passed + 1)); else echo "$1:"; echo "$2"; failed=$((failed + 1)); fi; }

check "src/modules.md is not current (<): make modules" \
   "$(diff "$source/modules.md" <($here/modules.sh "$readme" "$source"))"
check 'modules whose first line does not say what they are' "$(grep -E '\) \| *\|$' "$source/modules.md")"

# the index of decks: every deck once, with the largest displacement of its reference at the end of any stage
decks=$(awk '/^## / { on = /^## The decks of this folder/ }
   on && /^\| `/ { split($0, part, "`"); split($0, cell, "|"); gsub(/ /, "", cell[4]); print part[2], cell[4] }' input/README.md | sort)
answers=$(for deck in input/*.bdf; do
   name=$(basename "$deck" .bdf)
   echo "$name $(awk '/LARGEST DISPLACEMENT +[0-9]/ && (u == "" || $3 + 0 > u + 0) { u = $3 } END { print u }' "reference_output/$name.out")"
done | sort)
check 'decks in the index of input/README.md (<), and in input (>)' "$(diff <(echo "$decks") <(echo "$answers"))"

# the paper's program alone: the lines of its files, of all ten and of src, to a tenth
counts=$(cd "$source" && for file in *.f90 */*.f90; do echo "$file $(wc -l < "$file")"; done)
check 'lines of the files of the paper' "$(awk '
   function compare(what, n, about) { if (about > 1.1*n || about < 0.9*n) print what ": " n " lines, not about " about }
   FNR == NR { lines[$1] = $2; all += $2; next }
   /^## / { on = /^## The paper/ }
   on && match($0, /about [0-9,]+ of [0-9,]+ lines/) { said = substr($0, RSTART, RLENGTH); gsub(",", "", said); split(said, word, " ") }
   on && /^\| \[/ { split($0, cell, /[()|]/); files++; sum += lines[cell[3]]; compare(cell[3], lines[cell[3]], cell[5]) }
   END { if (files != 10) print files + 0 " files"; compare("the files", sum, word[2]); compare("src", all, word[4]) }' <(echo "$counts") "$readme")"

# the index of the card manual: every key and card that has a section, with a link to it; every card that the program reads has a section
index=$(awk '/^## / { on = /^## Index/; part = /^## Case control/ ? "####" : /^## Bulk data cards/ ? "###" : "" }
   on && /^\|/ { line = $0
      while (match(line, /\[[^]]*\]\(#[^)]*\)/)) {
         link = substr(line, RSTART + 1, RLENGTH - 2)
         line = substr(line, RSTART + RLENGTH)
         anchor = link
         sub(/.*\(#/, "", anchor)
         sub(/\].*/, "", link)
         n = split(link, name, ", ")
         for (i = 1; i <= n; i++) listed[name[i], anchor]
      } }
   /^#+ / && !fence { title = substr($0, index($0, " ") + 1); anchor = tolower(title); gsub(/[^a-z0-9 _-]/, "", anchor); gsub(/ /, "-", anchor)
      anchor = anchor (seen[anchor]++ > 0 ? "-" seen[anchor] - 1 : "") }
   /^```/ { fence = !fence }
   part != "" && !fence && $1 == part { n = split(title, name, ", ")
      for (i = 1; i <= n; i++) if (!((name[i], anchor) in listed)) print name[i] ": no entry in the index with the link #" anchor }
   END { for (key in listed) k++; if (k < 100) print k + 0 " entries" }' input/cards.md)
check 'the index of input/cards.md' "$index"
sections=$(awk '/^## / { on = /^## Bulk data cards/ } on && /^### / { sub(/^### /, ""); gsub(/, /, "\n"); print }' input/cards.md | sort)
read=$(awk '/subroutine list_cards/ { on = 1 } /^   contains/ { on = 0 }
   on && /call add\(\[/ { n = split($0, part, "\047"); for (i = 2; i <= n; i += 2) { gsub(/ /, "", part[i]); print part[i] } }
   END { for (i = 1; i <= 6; i++) print "CORD" (i > 3 ? 2 : 1) substr("RCSRCS", i, 1) }' "$source/deck/deck_input.f90" | sort)
check 'cards with a section (<), that the program reads (>)' "$(diff <(echo "$sections") <(echo "$read"))"

# tolerances stand in base/tolerances.f90: no other module has a number such as 1.0e-3_wp or smaller, but for these: FILE | TEXT | WHY
small='build/unit_watch.f90 | real(wp), parameter | units and usual sizes of materials
deck/field_rules.f90 | smallest_size = | the range of fields
fit/data_columns.f90 | 1.0e-3_wp | units
increment/newton_method.f90 | anint(1.0e4_wp*analysis%fraction)*1.0e-4_wp | a fraction of four digits, for print
joint/normal_curve.f90 | least_power = | the range of M of JNORM
base/text_tools.f90 | abs(value) >= 1.0e-3_wp | a smaller number is printed with an exponent
solver/distribution.f90 | _time = | seconds'
check 'tolerances outside of base/tolerances.f90; exceptions that are no longer' "$(cd "$source" && awk -v small="$small" '
   BEGIN { n = split(small, line, "\n"); for (i = 1; i <= n; i++) { split(line[i], part, / [|] ?/); file[i] = part[1]; text[i] = part[2] } }
   FILENAME == "base/tolerances.f90" { next }
   { code = $0; gsub(/\047[^\047]*\047/, "", code); sub(/!.*/, "", code) }
   code ~ /epsilon\(|[0-9.]e-(0?[3-9]|[1-9][0-9]+)_wp|0\.00[0-3][0-9]*_wp/ {
      for (i = 1; i <= n; i++) if (FILENAME == file[i] && index($0, text[i])) { met[i] = 1; next }
      print FILENAME ", line " FNR ":" $0
   }
   END { for (i = 1; i <= n; i++) if (!met[i]) print line[i] }' *.f90 */*.f90)"

# prose in lines of at most 120 characters: all but tables, code and comments for the reader of the text
check 'lines of prose above 120 characters' "$(awk '/^ *```/ { fence = !fence; next }
   !fence && length($0) > 120 && !/^ *\|/ && !/^    / && !/^ *<(!--|img )/ { print FILENAME ", line " FNR ": " length($0) }' $narrow_pages)"

# a fenced block ```diff FILE stands in FILE, line after line
snippets=$(awk '/^```diff / { file = $2; n = 0; next }
   file != "" && /^```$/ {
      blocks++
      found = lines = 0
      while ((getline line < file) > 0) text[++lines] = line
      close(file)
      for (i = 1; i <= lines - n + 1 && !found; i++) {
         for (k = 1; k <= n && text[i + k - 1] == block[k]; k++) ;
         found = k > n
      }
      if (!found || n == 0) print "line " FNR - n ": these lines do not stand in " file
      file = ""
      next
   }
   file != "" { block[++n] = $0 }
   END { if (blocks == 0) print "there are none" }' $pages input/course.md)
check 'snippets' "$snippets"

# names with an underscore in the charts, and all names between back-quotes, are words of the source, of the examples or of the tests
named=$(awk '/^```/ { fence = !fence; is_text = $0 == "```"; next }
   fence && is_text { while (match($0, /[a-z][a-z0-9]*_[a-z0-9_]*/)) { print substr($0, RSTART, RLENGTH); $0 = substr($0, RSTART + RLENGTH) } }
   !fence { n = split($0, part, "`"); for (i = 2; i <= n; i += 2) if (part[i] ~ /^[a-z][a-z0-9_%]*$/) print part[i] }' $pages | sort -u)
words=$(cat "$source"/*.f90 "$source"/*/*.f90 $here/*.patch | grep -oE '[a-z][a-z0-9_%]*' | sort -u)
folders=$(ls "$source" | sort)
check 'names that are nowhere in the source' "$(comm -23 <(echo "$named") <(printf '%s\n%s\nk_b\nk_s\nk_int\n' "$words" "$folders" | sort -u))"

paths=$(grep -ohE '`(src|input|tests)/[a-z0-9_./]+`' $pages | tr -d '`' | sort -u)
check 'files that are not there' "$(for path in $paths; do [ -e "$path" ] || grep -qx "+++ b/$path" $here/*.patch || echo "$path"; done)"

# all pages but the sources of the verification manual
all_pages=$(find README.md input reference_output src tests -name '*.md' -not -path 'tests/manual/*' | sort)
# a block in a list, or one without an end, turns what follows on the page inside out
check 'blocks of code that do not begin in the first column, or do not end' "$(awk '
   FNR == 1 { if (fence) print page ": a block has no end"; fence = 0; page = FILENAME }
   /^ +```/ { print FILENAME ", line " FNR } /^ *```/ { fence = !fence }
   END { if (fence) print page ": a block has no end" }' $all_pages)"
check 'links that lead nowhere' "$(awk -f $here/links.awk $all_pages)"

echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
