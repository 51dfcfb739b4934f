# A deck of the project, small or free field, as input of CalculiX: the cards below and no others, one step a SUBCASE.
#    GRID, CTETRA, CPENTA, CHEXA, CTRIA3, CQUAD4, CTRIA6, CQUAD8, PSOLID, PSHELL, PAXIS, MAT1, SPC1 (a list of nodes), FORCE, GRAV
# CHEXA of a PSOLID with MODES become C3D8I, others C3D8. Of second order CalculiX has the nodes between base and top last. Plane elements become CPE, plane strain: CalculiX expands CPS in its own
# way, so a plane-stress deck gets the constants with which plane strain is the same, E (1+2 nu)/(1+nu)**2 and nu/(1+nu).
function real(text) { sub(/^ */, "", text); if (text !~ /[Ee]/) { m = match(substr(text, 2), /[-+]/); if (m) text = substr(text, 1, m) "E" substr(text, m + 1) } return text == "" ? 0 : text + 0 }
function element(kind, n,   k, line) {
   line = f[2]
   for (k = 1; k <= n; k++) line = line (k == 13 ? ",\n" : ", ") f[3 + (n == 20 && k > 12 ? 13 + (k - 9) % 8 : n == 15 && k > 9 ? 10 + (k - 7) % 6 : k)]
   of[kind, f[3]] = of[kind, f[3]] line "\n"
   kinds[kind, f[3]] = kind; property[kind, f[3]] = f[3]
}
function card(   k) {
   if (f[1] == "GRID") grids = grids sprintf("%d, %.15g, %.15g, %.15g\n", f[2], real(f[4]), real(f[5]), real(f[6]))
   else if (f[1] == "CTETRA") element(n > 7 ? "C3D10" : "C3D4", n > 7 ? 10 : 4)
   else if (f[1] == "CPENTA") element(n > 9 ? "C3D15" : "C3D6", n > 9 ? 15 : 6)
   else if (f[1] == "CHEXA") element(n > 11 ? "C3D20" : "C3D8", n > 11 ? 20 : 8)
   else if (f[1] == "CTRIA3") element("3", 3)
   else if (f[1] == "CQUAD4") element("4", 4)
   else if (f[1] == "CTRIA6") element("6", 6)
   else if (f[1] == "CQUAD8") element("8", 8)
   else if (f[1] == "PAXIS") axis[f[2]] = 1
   else if (f[1] == "PSOLID") modes[f[2]] = f[7]
   else if (f[1] == "PSHELL") { thickness[f[2]] = real(f[4]); strain[f[2]] = f[5] }
   else if (f[1] == "MAT1") { young = real(f[3]); nu = real(f[5]); rho = real(f[6]) }
   else if (f[1] == "SPC1") { for (k = 4; k <= n; k++) if (f[k] != "") for (c = 1; c <= length(f[3]); c++) fixed = fixed f[k] ", " substr(f[3], c, 1) "\n" }
   else if (f[1] == "FORCE") { for (c = 1; c <= 3; c++) if (real(f[5 + c]) != 0) load[f[2]] = load[f[2]] sprintf("*CLOAD\n%d, %d, %.15g\n", f[3], c, real(f[5]) * real(f[5 + c])) }
   else if (f[1] == "GRAV") {
      a = real(f[4]); x = real(f[5]); y = real(f[6]); z = real(f[7]); l = sqrt(x * x + y * y + z * z)
      load[f[2]] = load[f[2]] sprintf("*DLOAD\nALL, GRAV, %.15g, %.15g, %.15g, %.15g\n", a * l, x / l, y / l, z / l)
   } else if (f[1] != "" && f[1] != "ENDDATA") { print "convert.awk: there is no conversion of " f[1] > "/dev/stderr"; bad = 1 }
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
   printf "*NODE, NSET=NODES\n%s", grids
   for (k in kinds) {
      kind = kinds[k]; p = property[k]
      if (kind ~ /^[3468]$/) { kind = (p in axis ? "CAX" : "CPE") kind; stress = !(p in axis) && strain[p] != "-1" }
      if (kind == "C3D8" && modes[p] == "MODES") kind = "C3D8I"
      printf "*ELEMENT, TYPE=%s, ELSET=ALL\n%s", kind, of[k]
      if (p in thickness) t = thickness[p]
   }
   if (stress) { young *= (1 + 2 * nu) / (1 + nu)^2; nu /= 1 + nu }
   printf "*MATERIAL, NAME=BODY\n*ELASTIC\n%.15g, %.15g\n*DENSITY\n%.15g\n", young, nu, rho
   printf "*SOLID SECTION, ELSET=ALL, MATERIAL=BODY\n%s*BOUNDARY\n%s", t == "" ? "" : t "\n", fixed
   for (s = 1; s <= stages; s++)
      printf "*STEP\n*STATIC\n*CLOAD, OP=NEW\n*DLOAD, OP=NEW\n%s*NODE PRINT, NSET=NODES\nU\n*END STEP\n", load[stage_load[s]]
}
