# Applies a unified diff below a folder, as `patch -p1` and `git apply` do, but strictly: the lines that a hunk removes or shows as
# context must stand exactly once in the file, at any line. A file is written only if all its hunks apply.
#
#    awk -v root=build/tour/src -f apply.awk EXAMPLE.patch
#
# Prints the hunks that do not apply; exit status 1 then.

/^--- / { end_file(); next }
/^\+\+\+ / && file == "" {
   file = root "/" substr($2, 3)
   n = 0
   while ((status = (getline line < file)) > 0) text[++n] = line
   close(file)
   next
}
/^@@ / {
   end_hunk()
   in_hunk = 1
   head = FNR
   if (status < 0 && $2 != "-0,0") complain("there is no such file")
   next
}
in_hunk {
   mark = substr($0, 1, 1)
   if (mark == " " || mark == "-" || $0 == "") old[++n_old] = substr($0, 2)
   if (mark == " " || mark == "+" || $0 == "") new[++n_new] = substr($0, 2)
}
END {
   end_file()
   if (hunks == 0) { print FILENAME ": no hunks"; failed = 1 }
   exit failed
}

function complain(words) {
   print FILENAME ", line " head + 0 ": " file ": " words
   wrong = failed = 1
}

# The hunk that has been read, on the lines text[1] to text[n].
function end_hunk(   i, k, place, found) {
   if (!in_hunk) return
   hunks++
   in_hunk = 0
   found = 0
   if (n_old == 0 && n == 0) { place = 1; found = 1 }
   else for (i = 1; i <= n - n_old + 1; i++) {
      for (k = 1; k <= n_old && text[i + k - 1] == old[k]; k++) ;
      if (k > n_old) { found++; place = i }
   }
   if (found != 1) complain("the lines of this hunk occur " found " times, not once")
   else {
      for (i = 1; i <= n - n_old; i++) rest[i] = text[i < place ? i : i + n_old]
      for (i = n - n_old; i >= place; i--) text[i + n_new] = rest[i]
      for (k = 1; k <= n_new; k++) text[place + k - 1] = new[k]
      n += n_new - n_old
   }
   n_old = n_new = 0
}

# All hunks of a file have been read.
function end_file(   i) {
   end_hunk()
   if (file != "" && !wrong) {
      for (i = 1; i <= n; i++) print text[i] > file
      close(file)
   }
   file = ""
   wrong = 0
}
