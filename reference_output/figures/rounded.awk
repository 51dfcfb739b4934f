# A CSV file for a picture: real numbers with seven digits, and zero for what is below 1E-10 of the largest number of its column. The
# digits behind these depend on the processor, and with them whether an axis ends at a number or one step beyond it.
#
#    awk -f rounded.awk FILE FILE      the same file twice

BEGIN { FS = OFS = "," }

# a number without point and exponent counts something, or is the name of a node
function is_real(text) { return text ~ /^ *[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([Ee][-+]?[0-9]+)? *$/ && text ~ /[.Ee]/ }

function size(value) { return value < 0 ? -value : value }

NR == FNR { for (i = 1; i <= NF; i++) if (is_real($i) && size($i + 0) > largest[i]) largest[i] = size($i + 0); next }

{
   for (i = 1; i <= NF; i++) if (is_real($i)) $i = size($i + 0) <= 1e-10*largest[i] ? "0.0" : sprintf("%.7g", $i + 0)
   print
}
