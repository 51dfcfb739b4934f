# Prints links of Markdown pages that lead to no file, or to no heading of a page. Pages are paths from the root of the project.
#
#    awk -f links.awk PAGE...

function anchor(title) { title = tolower(title); gsub(/`/, "", title); gsub(/[^a-z0-9 _-]/, "", title); gsub(/ /, "-", title); return title }
# the path without `.` and `..`
function tidy(path,    part, kept, n, m, i) {
   n = split(path, part, "/")
   for (i = 1; i <= n; i++) {
      if (part[i] == "." || part[i] == "") continue
      if (part[i] == ".." && m > 0) m--; else kept[++m] = part[i]
   }
   path = ""
   for (i = 1; i <= m; i++) path = path (i > 1 ? "/" : "") kept[i]
   return path
}
FNR == 1 { page = tidy(FILENAME); folder = page; if (!sub(/\/[^\/]*$/, "", folder)) folder = "."; pages[page]; fence = 0; split("", seen) }
/^ *```/ { fence = !fence; next }
fence { next }
/^#+ / {
   name = $0
   sub(/^#+ /, "", name)
   gsub(/\]\([^)]*\)/, "", name)
   name = anchor(name)
   headings[page, name (seen[name]++ > 0 ? "-" (seen[name] - 1) : "")]
}
{
   line = $0
   gsub(/`[^`]*`/, "", line)
   while (match(line, /\]\([^) ]*\)/)) {
      links[++n] = substr(line, RSTART + 2, RLENGTH - 3)
      from[n] = page
      where[n] = FNR
      base[n] = folder
      line = substr(line, RSTART + RLENGTH)
   }
}
END {
   for (i = 1; i <= n; i++) {
      if (links[i] ~ /^https?:/) continue
      path = heading = links[i]
      if (!sub(/^[^#]*#/, "", heading)) heading = ""
      sub(/#.*$/, "", path)
      file = path == "" ? from[i] : tidy(base[i] "/" path)
      if (path != "" && file != "" && system("test -e '" file "'") != 0) print from[i] ", line " where[i] ": no file " path
      else if (heading != "" && file in pages && !((file, heading) in headings)) print from[i] ", line " where[i] ": no heading #" heading " in " file
   }
   if (n == 0) print "no links"
}
