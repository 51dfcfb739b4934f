# Converts a mesh of Gmsh from small fields into the other formats, as Gmsh writes them: awk -v form=free (or large) -f
# field_format.awk SMALL.bdf
#
# Free fields have commas and no blanks; in large fields only GRID has sixteen columns a field, numbers have all their digits, and
# continuations have no names.
BEGIN { OFS = "" }
/^GRID/ && form == "large" {
   for (k = 0; k < 5; k++) f[k] = sprintf("%-16s", substr($0, 9 + 8 * k, 8) + 0)
   print "GRID*   ", f[0], f[1], f[2], f[3]
   print "*       ", f[4]
   next
}
/^[GC+]/ && form == "large" {
   if (/^\+/) $0 = sprintf("%8s", "") substr($0, 9)
   print substr($0, 1, 72)
   next
}
/^[GC+]/ {
   line = ""
   for (k = 1; k <= length($0); k += 8) { field = substr($0, k, 8); gsub(/ /, "", field); line = line (k > 1 ? "," : "") field }
   print line
   next
}
{ print }
