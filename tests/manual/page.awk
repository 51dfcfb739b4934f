# Turns a chapter into a shell script: its text goes into the page, its blocks "```sh run" run in their places.
function close_text() { if (open) print "END OF TEXT"; open = 0 }
function text(line) { if (!open) print "cat >&3 <<'END OF TEXT'"; open = 1; print line }
/^```sh run$/ { close_text(); code = 1; next }
code && /^```$/ { code = 0; next }
code { print; next }
/^### [0-9]+\.[0-9]+ / { close_text(); print "begin_case " $2 }
{ text($0) }
END { close_text() }
