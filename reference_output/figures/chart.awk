# A flow chart drawn in characters to SVG: the code block of a Markdown file that follows the heading which holds TITLE.
#
#    awk -v title='Fig. 6(a)' -f chart.awk README.md > fig6a.svg
#
# - | + / \ beside one another are lines and corners, a box with corners / \ is a question; < > ^ v at the end of a line are
# arrow heads; all else is text, set to the width that it has in characters.
BEGIN { wide = 9; high = 18; fence = "```" }
index($0, fence) == 1 { if (on) exit; if (found) on = 1; next }
on { row[++rows] = $0; if (length($0) > columns) columns = length($0); next }
/^#/ && index($0, title) { found = 1; heading = $0; sub(/^#+ */, "", heading) }

function char(x, y) { return y < 1 || y > rows || x < 1 ? " " : (substr(row[y], x, 1) == "" ? " " : substr(row[y], x, 1)) }
function one_of(c, set) { return c != " " && index(set, c) > 0 }
function across(x, y) { return char(x, y) == "-" && (one_of(char(x - 1, y), "-+<|/\\") || one_of(char(x + 1, y), "-+>|/\\")) }
function line(x1, y1, x2, y2) {
   printf "<line x1=\"%g\" y1=\"%g\" x2=\"%g\" y2=\"%g\"/>\n", wide*x1, high*y1, wide*x2, high*y2
}
function head(x, y, along, down,    tip_x, tip_y) { # an arrow to the next character in the direction (along, down)
   tip_x = wide*x + 9*along
   tip_y = high*y + 17*down
   printf "<path d=\"M %g %g L %g %g L %g %g Z\" fill=\"black\"/>\n", tip_x, tip_y, \
      tip_x - 10*along - 4*down, tip_y - 10*down - 4*along, tip_x - 10*along + 4*down, tip_y - 10*down + 4*along
}
# what the character at (x, y) draws; 0: it is text
function drawn(x, y,    c, left, right, last) {
   c = char(x, y)
   left = one_of(char(x - 1, y), "-+")
   right = one_of(char(x + 1, y), "-+")
   if (across(x, y)) { # from the first of a row to the last, to the middle of an upright line beside them
      if (char(x - 1, y) == "-") return 1
      for (last = x; char(last + 1, y) == "-"; last++);
      line(x - (char(x - 1, y) == "|" ? 1 : 0.5), y, last + (char(last + 1, y) == "|" ? 1 : 0.5), y)
   } else if (c == "|") {
      if (char(x, y - 1) == "|") return 1
      if (across(x, y - 1)) line(x, y - 1, x, y - 0.5)
      for (last = y; char(x, last + 1) == "|"; last++);
      if (across(x, last + 1)) line(x, last + 0.5, x, last + 1)
      line(x, y - 0.5, x, last + 0.5)
   } else if (c == "+" && (left || right)) {
      if (left) line(x - 0.5, y, x, y)
      if (right) line(x, y, x + 0.5, y)
      if (one_of(char(x, y - 1), "|+^")) line(x, y - 0.5, x, y)
      if (one_of(char(x, y + 1), "|+v")) line(x, y, x, y + 0.5)
   } else if (c == "/" && right && char(x, y + 1) == "|") {
      line(x, y + 0.5, x + 0.5, y)
   } else if (c == "/" && left && char(x, y - 1) == "|") {
      line(x - 0.5, y, x, y - 0.5)
   } else if (c == "\\" && (left || right)) {
      if (left) line(x - 0.5, y, x, y + 0.5)
      else line(x, y - 0.5, x + 0.5, y)
   } else if (c == "v" && char(x, y - 1) == "|") {
      line(x, y - 0.5, x, y + 0.5)
      head(x, y, 0, 1)
   } else if (c == "^" && char(x, y + 1) == "|") {
      line(x, y - 0.5, x, y + 0.5)
      head(x, y, 0, -1)
   } else if (c == ">" && char(x - 1, y) == "-") {
      line(x - 0.5, y, x, y)
      head(x, y, 1, 0)
   } else if (c == "<" && char(x + 1, y) == "-") {
      line(x, y, x + 0.5, y)
      head(x, y, -1, 0)
   } else {
      return 0
   }
   return 1
}
function text(x, y, words) {
   gsub(/&/, "\\&amp;", words)
   gsub(/</, "\\&lt;", words)
   printf "<text x=\"%g\" y=\"%g\" textLength=\"%g\" xml:space=\"preserve\">%s</text>\n", wide*(x - 0.5), high*y + 5, \
      wide*width, words
}
END {
   if (!rows) { print "no chart " title > "/dev/stderr"; exit 1 }
   printf "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" font-family=\"monospace\" font-size=\"15\">\n", \
      wide*(columns + 3), high*(rows + 4)
   print "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>"
   printf "<text x=\"%d\" y=\"%d\" font-family=\"Helvetica, sans-serif\" font-size=\"18\">%s</text>\n", wide, high*1.3, heading
   printf "<g transform=\"translate(%d %d)\" stroke-width=\"1.5\">\n<g stroke=\"black\">\n", wide, high*2
   for (y = 1; y <= rows; y++) {
      for (x = 1; x <= length(row[y]); x++) {
         if (char(x, y) != " " && drawn(x, y)) row_of_text[y] = row_of_text[y] " "
         else row_of_text[y] = row_of_text[y] char(x, y)
      }
   }
   print "</g>"
   for (y = 1; y <= rows; y++) {
      rest = row_of_text[y]
      x = 1
      while (match(rest, /[^ ]( ?[^ ])*/)) {
         width = RLENGTH
         text(x + RSTART - 1, y, substr(rest, RSTART, RLENGTH))
         x += RSTART + RLENGTH - 1
         rest = substr(rest, RSTART + RLENGTH)
      }
   }
   print "</g>\n</svg>"
}
