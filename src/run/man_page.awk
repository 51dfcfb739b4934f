# The manual page of a program from what its --help prints.
#
#    bin/jointfem --help | awk -v name=jointfem -v version='jointfem 0.1.0' -v about='what it is' -f man_page.awk > jointfem.1

function text(line) {
   gsub(/\\/, "\\e", line)
   gsub(/-/, "\\-", line)
   if (line ~ /^[.']/) line = "\\&" line
   return line
}

NR == 1 {
   print ".TH " toupper(name) " 1 \"\" \"" version "\" \"User commands\""
   print ".SH NAME"
   print name " \\- " text(about)
   print ".SH SYNOPSIS"
   sub(/^usage: /, "")
   print text($0)
   next
}
/^examples:/ { print ".SH EXAMPLES"; examples = 1; next }
$0 == "" && examples { print ".fi"; literal = examples = 0 }
$0 != "" && !examples && !described { print ".SH DESCRIPTION"; described = 1 }
/^exit status:/ {
   if (literal) print ".fi"
   literal = 0
   print ".SH EXIT STATUS"
   sub(/^exit status: /, "")
}
/^ / && !literal { print ".nf"; literal = 1 }
/^[^ ]/ && literal { print ".fi"; literal = 0 }
$0 == "" { if (!literal) print ".PP"; else print ""; next }
{ print text($0) }
END {
   if (literal) print ".fi"
   print ".SH SEE ALSO"
   print (name == "jointfem" ? "jointfit(1)" : "jointfem(1)") ", the card manual input/cards.md in the documentation"
}
