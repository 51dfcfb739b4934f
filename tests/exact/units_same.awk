# Compares histories in other units with those in the first.
#
#     awk -v length_power=-3 -v force_power=2 -v tolerance=1e-9 -f units_same.awk FIRST OTHER
#
# Prints the differences: words and counts must be equal, every other column within TOLERANCE of its largest value (secants within
# 100 times that). The scale of a moment is the largest force times the largest coordinate, that of an angle the largest
# displacement over that coordinate: a joint under uniform pressure has moments and angles that are small differences.

BEGIN {
   FS = ","
   say("lambda gap x y z delta_x delta_y slid_x slid_y u_max gap_max move_x move_y move_n", 0, 1)
   say("area", 0, 2)
   say("pressure tau_x tau_y p_max mises_centre mises_max", 1, -2)
   say("force n t force_x force_y force_n", 1, 0)
   say("m moment_x moment_y moment_n", 1, 1)
   say("k_n k_sx k_sy tangent_x tangent_y tangent_n secant_x secant_y secant_n", 1, -1)
   say("tangent_tilt_x tangent_tilt_y tangent_twist secant_tilt_x secant_tilt_y secant_twist", 1, 1)
   say("load contact safety normal_x normal_y normal_z turn_x turn_y turn_n", 0, 0)
}

function say(names, f, l,   n, i, name) {
   n = split(names, name, " ")
   for (i = 1; i <= n; i++) { has_unit[name[i]] = 1; factor[name[i]] = f * force_power + l * length_power }
}

FNR == 1 { file++ }
{ for (i = 1; i <= NF; i++) entry[file, FNR, i] = $i; columns[file] = NF; rows[file] = FNR }

# The largest value of the first file among the columns NAMES
function largest_of(names,   n, c, i, k, r, a, most) {
   n = split(names, c, " ")
   for (i = 1; i <= columns[1]; i++) for (k = 1; k <= n; k++) if (entry[1, 1, i] == c[k]) for (r = 2; r <= rows[1]; r++) {
      a = entry[1, r, i] + 0
      if (a < 0) a = -a
      if (a > most) most = a
   }
   return most + 0
}

END {
   lever = largest_of("x y z")
   measure["moment"] = lever * largest_of("n t force_x force_y force_n")
   if (lever > 0) measure["turn"] = largest_of("move_x move_y move_n") / lever
   if (rows[1] != rows[2] || columns[1] != columns[2] || rows[1] < 2) { print "rows or columns are missing"; exit }
   for (i = 1; i <= columns[1]; i++) {
      name = entry[1, 1, i]
      kind = name == "m" ? "moment" : name
      sub(/_.*/, "", kind)
      largest = measure[kind] + 0
      off = 0
      if (!(name in has_unit)) {
         for (r = 1; r <= rows[1]; r++) if (entry[1, r, i] != entry[2, r, i]) {
            print name ", line " r ": " entry[1, r, i] " and " entry[2, r, i]
            break
         }
         continue
      }
      for (r = 2; r <= rows[1]; r++) {
         if ((entry[1, r, i] == "") != (entry[2, r, i] == "")) { print name ", line " r ": a field is empty"; break }
         a = entry[1, r, i] + 0
         b = entry[2, r, i] * 10 ^ -factor[name]
         if (a > largest) largest = a
         if (-a > largest) largest = -a
         if (a - b > off) { off = a - b; at = r }
         if (b - a > off) { off = b - a; at = r }
      }
      room = name ~ /^secant/ ? 100 * tolerance : tolerance # quotients of forces and movements that may both be small beside others
      if (!(off <= room * largest)) print name ", line " at ": off by " off / (largest > 0 ? largest : 1e-99) " of the largest"
   }
}
