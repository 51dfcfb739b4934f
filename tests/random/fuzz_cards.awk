# A card of the copy as a name and its data fields, whatever form it is in, and back in any of the three forms.
#
# Lines are never put in nor taken out here, so that their numbers stay: a line of a card that is written anew holds all of its
# lines, the others are `gone`.

function trimmed(text) { sub(/^ +/, "", text); sub(/ +$/, "", text); return text }

# The data fields of one line into field[fields + 1 ...]; returns the name.
function cut_line(entry,   part, parts, i, width, wide) {
   sub(/\$.*/, "", entry)
   wide = substr(entry, 1, 8) ~ /\*/ ? 4 : 8
   if (entry ~ /,/) {
      parts = split(entry, part, ",")
      for (i = 1; i <= wide; i++) field[++fields] = i < parts ? trimmed(part[i + 1]) : ""
      return trimmed(part[1])
   }
   width = 64 / wide
   for (i = 0; i < wide; i++) field[++fields] = trimmed(substr(entry, 9 + width * i, width))
   return trimmed(substr(entry, 1, 8))
}

# Read the card that begins on line k: card_name, field[1 .. fields], its lines k to card_end. Only cards that have not been
# written anew; returns whether it is one.
function read_card(k,   i) {
   fields = 0
   card_end = k
   if (line[k] ~ /\n/ || line[k] == gone || length(line[k]) > 200) return 0
   card_name = toupper(cut_line(line[k]))
   sub(/\*$/, "", card_name)
   for (i = k + 1; i < last && line[i] ~ /^([+*,]|        )/ && line[i] !~ /\n/ && line[i] ~ /[^ ]/; i++) {
      cut_line(line[i])
      card_end = i
   }
   while (fields > 1 && field[fields] == "") fields--
   return card_name ~ /^[A-Z]+[0-9A-Z]*$/
}

# Write the card back in its place, in the form `small`, `large` or `free`; entries that are too long for their field make it free.
function write_card(k, form,   i, longest, out, wide, mark) {
   for (i = 1; i <= fields; i++) if (length(field[i]) > longest) longest = length(field[i])
   if (longest > 16 || (longest > 8 && form == "small") || length(card_name) > 7) form = "free"
   wide = form == "large" ? 4 : 8
   for (i = 1; i <= fields; i++) {
      if (i % wide == 1) {
         mark = i > 1 ? (form == "large" ? "*" : "+") : card_name (form == "large" ? "*" : "")
         if (form == "free" && i > 1) mark = ""
         out = out (i > 1 ? "\n" : "") (form == "free" ? mark : sprintf("%-8s", mark))
      }
      if (form == "free") out = out "," field[i]
      else out = out sprintf(form == "large" ? "%-16s" : "%-8s", field[i])
   }
   line[k] = out
   for (i = k + 1; i <= card_end; i++) line[i] = gone
}

# A form, small most often
function any_form(   k) {
   k = random(6)
   return k < 4 ? "small" : k < 5 ? "free" : "large"
}

function kind_of_entry(entry) {
   if (entry == "") return "blank"
   if (entry ~ /^[-+]?[0-9]+$/) return "integer"
   if (entry ~ /^[-+]?[0-9]*\.?[0-9]*([EDed]?[-+]?[0-9]+)?$/) return "real"
   return "word"
}

# The value of a NASTRAN real
function value_of(entry) {
   entry = toupper(entry)
   gsub(/D/, "E", entry)
   if (entry !~ /E/ && match(entry, /[0-9.][-+]/)) entry = substr(entry, 1, RSTART) "E" substr(entry, RSTART + 1)
   return entry + 0
}

# A number as a NASTRAN real of at most 8 characters, or more where more digits are asked for
function real_entry(value,   out) {
   if (value == 0) return "0.0"
   out = sprintf("%.3G", value)
   if (out !~ /[.E]/) out = out ".0"
   if (length(out) > 8) sub(/E/, "", out)
   if (out ~ /^-?[0-9]+[-+]/) sub(/[-+][0-9]+$/, ".&", out)
   return out
}

# Some card of the copy that can be read now; 0 if none was found
function some_card(pattern,   k, i) {
   for (i = 1; i <= 40; i++) {
      k = chance(my_cards)
      if (line[k] ~ /^[A-Za-z]/ && toupper(line[k]) ~ pattern && read_card(k)) return k
   }
   return 0
}
