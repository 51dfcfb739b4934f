# Converts a deck of the project, small or free field, into input of CalculiX, one step for each SUBCASE; only these cards:
#    GRID, CTETRA, CPENTA, CHEXA, CTRIA3, CTRIA6, CQUAD4, CQUAD8, PSOLID, PSHELL, PAXIS, MAT1, SPC1 (a list of nodes), FORCE, GRAV,
#    PLOAD4 (uniform), PLOADE
# CHEXA of a PSOLID with PLAIN or FULL becomes C3D8, otherwise C3D8I, with twenty nodes C3D20, and so on. Plane elements of PAXIS
# become CAX, all others CPE, plane strain: CalculiX expands CPS in its own way, so a plane-stress deck gets the constants that make
# plane strain equal, E (1+2 nu)/(1+nu)**2 and nu/(1+nu); -v stress=CPS keeps CPS. With -v modes_wanted=8 the only step finds the
# eight lowest natural frequencies.
function real(text) { sub(/^ */, "", text); if (text !~ /[Ee]/) { m = match(substr(text, 2), /[-+]/); if (m) text = substr(text, 1, m) "E" substr(text, m + 1) } return text == "" ? 0 : text + 0 }
# element(KIND, ORDER): its nodes in the order of CalculiX, their places on the card in ORDER
function element(kind, order,   k, count, place, line) {
   line = f[2]
   count = split(order, place, " ")
   for (k = 1; k <= count; k++) line = line (k == 16 ? ",\n" : ", ") f[3 + place[k]]
   of[kind, f[3]] = of[kind, f[3]] line "\n"
   kinds[kind, f[3]] = kind; property[kind, f[3]] = f[3]
   name[f[2]] = f[1]
   for (k = 1; k <= 8; k++) corner[f[2], k] = f[3 + k]
}
# side(FACES): which of the sides, given by the places of their corners, has the corners f[first] and f[last] (but not f[without])
function side(faces, first, last, without,   count, k, j, s, place, has) {
   count = split(faces, s, " ")
   for (k = 1; k <= count; k++) {
      delete has
      for (j = 1; j <= length(s[k]); j++) has[corner[first_id, substr(s[k], j, 1)]]
      if ((first in has) && (last == "" || (last in has)) && !(without in has)) return k
   }
}
function card(   k) {
   if (f[1] == "GRID") grids = grids sprintf("%d, %.15g, %.15g, %.15g\n", f[2], real(f[4]), real(f[5]), real(f[6]))
   else if (f[1] == "CTETRA" && n > 7) element("C3D10", "1 2 3 4 5 6 7 8 9 10")
   else if (f[1] == "CTETRA") element("C3D4", "1 2 3 4")
   else if (f[1] == "CPENTA" && n > 9) element("C3D15", "1 2 3 4 5 6 7 8 9 13 14 15 10 11 12")
   else if (f[1] == "CPENTA") element("C3D6", "1 2 3 4 5 6")
   else if (f[1] == "CHEXA" && n > 11) element("C3D20", "1 2 3 4 5 6 7 8 9 10 11 12 17 18 19 20 13 14 15 16")
   else if (f[1] == "CHEXA") element("C3D8", "1 2 3 4 5 6 7 8")
   else if (f[1] == "CTRIA3") element("3", "1 2 3")
   else if (f[1] == "CTRIA6") element("6", "1 2 3 4 5 6")
   else if (f[1] == "CQUAD4") element("4", "1 2 3 4")
   else if (f[1] == "CQUAD8") element("8", "1 2 3 4 5 6 7 8")
   else if (f[1] == "PSOLID") modes[f[2]] = f[7]
   else if (f[1] == "PSHELL") { thickness[f[2]] = real(f[4]); strain[f[2]] = f[5] }
   else if (f[1] == "PAXIS") ring[f[2]]
   else if (f[1] == "MAT1") { young = real(f[3]); nu = real(f[5]); rho = real(f[6]) }
   else if (f[1] == "SPC1") { for (k = 4; k <= n; k++) if (f[k] != "") for (c = 1; c <= length(f[3]); c++) fixed = fixed f[k] ", " substr(f[3], c, 1) "\n" }
   else if (f[1] == "FORCE") { for (c = 1; c <= 3; c++) if (real(f[5 + c]) != 0) load[f[2]] = load[f[2]] sprintf("*CLOAD\n%d, %d, %.15g\n", f[3], c, real(f[5]) * real(f[5 + c])) }
   else if (f[1] == "GRAV") {
      a = real(f[4]); x = real(f[5]); y = real(f[6]); z = real(f[7]); l = sqrt(x * x + y * y + z * z)
      load[f[2]] = load[f[2]] sprintf("*DLOAD\nALL, GRAV, %.15g, %.15g, %.15g, %.15g\n", a * l, x / l, y / l, z / l)
   } else if (f[1] ~ /^PLOAD[4E]$/) pressed[++pressures] = f[2] " " f[3] " " real(f[4]) " " (f[1] == "PLOADE" ? f[5] " " f[6] : f[8] " " f[9])
   else if (f[1] != "" && f[1] != "ENDDATA") { print "convert.awk: there is no conversion of " f[1] > "/dev/stderr"; bad = 1 }
}
# press(SID EID P G1 G34): the sides of elements by the numbers that CalculiX has for them
function press(text,   w, k) {
   split(text, w, " "); first_id = w[2]
   if (name[w[2]] == "CTETRA") k = side("123 142 243 341", w[4], "", w[5])
   else if (name[w[2]] == "CPENTA") k = side("123 456 1254 2365 3146", w[4], w[5], "none")
   else if (name[w[2]] == "CHEXA") k = side("1234 5876 1562 2673 3784 4851", w[4], w[5], "none")
   else k = side(name[w[2]] ~ /TRIA/ ? "12 23 31" : "12 23 34 41", w[4], w[5], "none")
   load[w[1]] = load[w[1]] sprintf("*DLOAD\n%d, P%d, %.15g\n", w[2], k, w[3])
}
/^\$/ || /^ *$/ { next }
!bulk { if ($1 == "LOAD") stage_load[++stages] = $3; if (/^BEGIN/) bulk = 1; next }
{
   sub(/\$.*/, "")
   if (index($0, ",")) entries = split($0, e, ",")
   else { entries = 9; for (k = 1; k <= 9; k++) e[k] = substr($0, 8 * k - 7, 8) }
   for (k = 1; k <= entries; k++) gsub(/ /, "", e[k])
   if (e[1] !~ /^\+?$/) { if (n) card(); delete f; n = 1; f[1] = e[1] }
   for (k = 2; k <= entries; k++) f[++n] = e[k]
}
END {
   card()
   if (bad) exit 1
   for (k = 1; k <= pressures; k++) press(pressed[k])
   printf "*NODE, NSET=NODES\n%s", grids
   for (k in kinds) {
      kind = kinds[k]; p = property[k]
      if (kind ~ /^[0-9]$/ && p in ring) kind = "CAX" kind
      else if (kind ~ /^[0-9]$/ && strain[p] != "-1" && stress == "CPS") kind = "CPS" kind
      else if (kind ~ /^[0-9]$/) { kind = "CPE" kind; converted = strain[p] != "-1" }
      if (kind == "C3D8" && modes[p] !~ /^(PLAIN|FULL)$/) kind = "C3D8I"
      printf "*ELEMENT, TYPE=%s, ELSET=ALL\n%s", kind, of[k]
      if (p in thickness) t = thickness[p]
   }
   if (converted) { young *= (1 + 2 * nu) / (1 + nu)^2; nu /= 1 + nu }
   printf "*MATERIAL, NAME=BODY\n*ELASTIC\n%.15g, %.15g\n*DENSITY\n%.15g\n", young, nu, rho
   printf "*SOLID SECTION, ELSET=ALL, MATERIAL=BODY\n%s*BOUNDARY\n%s", t == "" ? "" : t "\n", fixed
   if (modes_wanted) { printf "*STEP\n*FREQUENCY\n%d\n*END STEP\n", modes_wanted; exit }
   for (s = 1; s <= stages; s++)
      printf "*STEP\n*STATIC\n*CLOAD, OP=NEW\n*DLOAD, OP=NEW\n%s*NODE PRINT, NSET=NODES\nU\n*END STEP\n", load[stage_load[s]]
}
