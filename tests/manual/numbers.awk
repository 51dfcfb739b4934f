# How the manual prints numbers, and what its scripts share. Theory and program have six digits (or DIGITS), which every processor
# gives alike; a difference has two digits, and none below FLOOR, where rounding and the tolerances of iterations dominate.

# what a link to a heading is
function anchor(title) { title = tolower(title); gsub(/[^a-z0-9 _-]/, "", title); gsub(/ /, "-", title); return title }

function abs(x) { return x < 0 ? -x : x }
function size(x) { return x < 0 ? -x : x }
function cosh(x) { return (exp(x) + exp(-x)) / 2 }
function sinh(x) { return (exp(x) - exp(-x)) / 2 }
function power(x, n) { return x > 0 ? exp(n * log(x)) : 0 }

# 1.23e-05 as 1.23E-5
function short(text) {
   sub(/e/, "E", text); sub(/E\+0*/, "E", text); sub(/E-0*/, "E-", text); sub(/E$/, "", text); sub(/\.$/, "", text)
   return text
}
function six(x,   n) {
   n = digits ? digits : 6
   return x == 0 ? "0" : short(sprintf(size(x) < 0.1 || size(x) >= 1e6 ? "%." n - 1 "e" : "%#." n "g", x))
}

# what the two differ by, relative where the theory is not zero
function difference(theory, program) { return theory == 0 ? program : program / theory - 1 }
function difference_text(d, floor,   n) {
   if (size(d) < floor) return "< " short(sprintf("%.0e", floor))
   n = size(d) < 10 * floor ? 1 : 2
   return size(d) >= 5e-4 ? sprintf("%+." n "g %%", 100 * d) : (d < 0 ? "-" : "+") short(sprintf("%." n - 1 "e", size(d)))
}

# The row of a table; behind it, on a line of its own, the size of the difference.
function cells(theory, program, floor,   d) {
   if (program !~ /^[-+]?[0-9.]/) { print "| no number: " program; return }
   d = difference(theory, program)
   printf "| %s | %s | %s |\n%.3e\n", six(theory), theory == 0 && size(program) < floor ? "0" : six(program), difference_text(d, floor), size(d)
}
