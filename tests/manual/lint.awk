# Prints text that Markdown would not show as meant: rows with more or fewer cells than their head, a line of text that begins like
# a list item or underlines the line above, links to missing headings.
#    awk -f numbers.awk -f lint.awk PAGE
/^#+ / { title = $0; sub(/^#+ /, "", title); there[anchor(title)] = 1 }
/^\|/ { n = gsub(/\|/, "|"); if (!width) width = n; else if (n != width) print NR ": " (n - 1) " cells, not " (width - 1) }
!/^\|/ { width = 0 }
/^([-+*]|[0-9]+[.)]) / && before != "" && before !~ /^ *- |^  |^[0-9]+[.)] / { print NR ": begins as an item of a list: " $0 }
/^(=+|-+) *$/ && before != "" { print NR ": underlines the line above" }
{
   before = $0
   while (match($0, /\]\(#[^)]*\)/)) { link[substr($0, RSTART + 3, RLENGTH - 4)] = NR; $0 = substr($0, RSTART + RLENGTH) }
}
END { for (l in link) if (!(l in there)) print link[l] ": no heading #" l }
