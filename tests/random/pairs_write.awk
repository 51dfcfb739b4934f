# Writes the model of pairs_model.awk as a deck: as it is, by the other solver, renumbered, mirrored, turned, in other units; with `path`
# also p, by a tenth of PATHTOL.
#
#     awk -v seed=S -v from=A -v to=B -v folder=F -f random.awk -f pairs_features.awk -f pairs_model.awk -f pairs_write.awk
#
# A place x becomes length * T x + shift, a force force * T f. Prints for the judge, a line each: DECK number pair features; what
# must come out of it (JOINT, LOADS, CARRIES); VARIANT name T length force shift.

BEGIN {
   for (copy = from; copy <= to; copy++) {
      start_random(copy)
      pair = choose_features(copy)
      make_model()
      describe()
      n_variants = split("a t r m q u" (on["path"] ? " p" : ""), variant, " ")
      solver = random(2) ? "SKYLINE" : "TREE"
      other = solver == "TREE" ? "SKYLINE" : "TREE"
      gap_table()
      for (v = 1; v <= n_variants; v++) write_variant(variant[v])
   }
}

function real(x,   s) {
   s = sprintf("%.17g", x)
   return s ~ /[.e]/ ? s : s "."
}

function describe(   j, s, n) {
   method = on["newton"] ? "NEWTON" : on["back"] ? "BACK" : "STEP"
   print "DECK", copy, pair, method, (space ? "space" : axi ? "axi" : "plane"), features
   for (j = 1; j <= n_joints; j++)
      printf "JOINT %d %.17g %.17g %.17g %.17g %.17g %d %.17g %d\n", j, area[j], c, m, e_u, rough ? mu : -1, nrean, sheared && !on["cubic"] && !a12 && !rough ? a11 : 0, !on["cubic"] && !a12
   n = 0
   for (j = 1; j <= ne; j++) if (e_pid[j] < 10) n++
   print "CELLS", n
   if (on["gap"] && !on["moved"] && !(gap_kind == "CONST" && g0 > 0) && gap_kind != "TRUE") print "PUSHED_AWAY"
   if (sheared && !rough && on["newton"]) print "DROPS"
   if (on["path"]) print "PATH", path_tol = copy % 3 ? 1e-3 : 1e-2
   for (s = 1; s <= n_stages; s++) {
      printf "LOADS %d %.17g %.17g %.17g\n", s, total_x[s], total_y[s], total_z[s]
      # what each joint carries where nothing else holds what stands on it
      for (j = 1; j <= n_joints; j++) if (free) printf "CARRIES %d %d %.17g %.17g\n", s, j, press[s], sqrt(push[s] ^ 2 + side[s] ^ 2)
   }
}

# Points of a table of gaps: scattered, and corners beyond the joint
function gap_table(   k) {
   if (gap_kind != "TABLE") return
   n_table = 4 + random(4)
   for (k = 1; k <= n_table; k++) {
      t_x[k] = joint_x[gap_joint] + joint_length[gap_joint] * (k <= 4 ? (k % 2 ? -1 : 1) * between(0.55, 0.8) : between(-0.4, 0.4))
      t_y[k] = space ? joint_y[gap_joint] + joint_width[gap_joint] * (k <= 4 ? (k > 2 ? -1 : 1) * between(0.55, 0.8) : between(-0.4, 0.4)) : joint_z[gap_joint]
      t_g[k] = lambda_ref * between(-0.4, 0.6)
   }
}

# the transformation of the variant: T, det, lengths, forces, shift
function identity(   i, j) { for (i = 1; i <= 3; i++) for (j = 1; j <= 3; j++) T[i, j] = i == j; det = 1; s_l = s_f = 1; shift = 0 }

function turn(   a, b, g, i, j, k, r, q) {
   if (axi) { shift = between(10, 30); return }
   if (!space) { a = between(-3.1, 3.1); T[1, 1] = T[2, 2] = cos(a); T[2, 1] = sin(a); T[1, 2] = -sin(a); return }
   if (!isotropic) { a = between(0.1, 0.9) * (random(2) ? 1 : -1); T[1, 1] = T[3, 3] = cos(a); T[1, 3] = sin(a); T[3, 1] = -sin(a); return }
   a = between(-3.1, 3.1); b = between(-3.1, 3.1); g = between(-3.1, 3.1)
   T[1, 1] = cos(a) * cos(b); T[1, 2] = cos(a) * sin(b) * sin(g) - sin(a) * cos(g); T[1, 3] = cos(a) * sin(b) * cos(g) + sin(a) * sin(g)
   T[2, 1] = sin(a) * cos(b); T[2, 2] = sin(a) * sin(b) * sin(g) + cos(a) * cos(g); T[2, 3] = sin(a) * sin(b) * cos(g) - cos(a) * sin(g)
   T[3, 1] = -sin(b); T[3, 2] = cos(b) * sin(g); T[3, 3] = cos(b) * cos(g)
}

function turned(x, y, z) { o1 = T[1, 1] * x + T[1, 2] * y + T[1, 3] * z; o2 = T[2, 1] * x + T[2, 2] * y + T[2, 3] * z; o3 = T[3, 1] * x + T[3, 2] * y + T[3, 3] * z }
function placed(x, y, z) { turned(x, y, z); o1 *= s_l; o2 = o2 * s_l + shift; o3 *= s_l }

# Sign of component C of node N in this variant against that of the model: mirrored, axis 2 of a system turns round, without one the mirrored axis
function sign(n, comp,   axis, s) {
   if (det > 0) return 1
   axis = comp > 3 ? comp - 3 : comp
   s = axis == (frame_of[n] ? 2 : axi ? 2 : 1) ? -1 : 1
   return comp > 3 ? -s : s
}

function put(text) { out[++n_out] = text }

# a card and its continuations, eight entries a line
function card(text,   w, n, k, line) {
   n = split(text, w, ",")
   line = w[1]
   for (k = 2; k <= n; k++) {
      line = line "," w[k]
      if ((k - 1) % 8 == 0 && k < n) line = line "\n+"
   }
   put(line)
}

# numbers of nodes and elements
function numbers(shuffled,   i, k, t, step) {
   for (i = 1; i <= nn; i++) id[i] = i
   for (i = 1; i <= ne + 300; i++) eid[i] = i
   if (!shuffled) return
   for (i = nn; i > 1; i--) { k = 1 + random(i); t = id[i]; id[i] = id[k]; id[k] = t }
   for (i = ne + 300; i > 1; i--) { k = 1 + random(i); t = eid[i]; eid[i] = eid[k]; eid[k] = t }
   step = 1 + random(30)
   for (i = 1; i <= nn; i++) id[i] = 7 + step * id[i] + (step > 1 ? random(step) : 0)
}

# The nodes of element E as this variant has them: round the other way where it is mirrored, from another corner where renumbered
function connection(e, renumbered,   t, list, k, n, turns, text) {
   t = e_type[e]
   n = e_n[e]
   for (k = 1; k <= n; k++) nodes[k] = e_node[e, k]
   order_text = ""
   if (renumbered) {
      if (t == "CQUAD4") order_text = chance("2,3,4,1 3,4,1,2 4,1,2,3")
      else if (t == "CTRIA3") order_text = chance("2,3,1 3,1,2")
      else if (t == "CTRIA6") order_text = chance("2,3,1,5,6,4 3,1,2,6,4,5")
      else if (t == "CQUAD8") order_text = chance("2,3,4,1,6,7,8,5 4,1,2,3,8,5,6,7")
      else if (t == "CBAR") order_text = "2,1"
      else if (t == "CHEXA") order_text = n == 8 ? chance("2,3,4,1,6,7,8,5 5,8,7,6,1,4,3,2") : chance("2,3,4,1,6,7,8,5,10,11,12,9,14,15,16,13,18,19,20,17 5,8,7,6,1,4,3,2,20,19,18,17,13,16,15,14,12,11,10,9")
      else if (t == "CPENTA") order_text = n == 6 ? "2,3,1,5,6,4" : "2,3,1,5,6,4,8,9,7,11,12,10,14,15,13"
      else if (t == "CTETRA") order_text = n == 4 ? "2,3,1,4" : "2,3,1,4,6,7,5,9,10,8"
   } else if (det < 0) {
      if (t == "CQUAD4") order_text = "1,4,3,2"
      else if (t == "CTRIA3") order_text = "1,3,2"
      else if (t == "CTRIA6") order_text = "1,3,2,6,5,4"
      else if (t == "CQUAD8") order_text = "1,4,3,2,8,7,6,5"
      else if (t == "CHEXA") order_text = n == 8 ? "5,6,7,8,1,2,3,4" : "5,6,7,8,1,2,3,4,17,18,19,20,13,14,15,16,9,10,11,12"
      else if (t == "CPENTA") order_text = n == 6 ? "4,5,6,1,2,3" : "4,5,6,1,2,3,13,14,15,10,11,12,7,8,9"
      else if (t == "CTETRA") order_text = n == 4 ? "1,3,2,4" : "1,3,2,4,7,6,5,8,10,9"
   }
   if (order_text == "") for (k = 1; k <= n; k++) list[k] = k
   else split(order_text, list, ",")
   text = ""
   for (k = 1; k <= n; k++) text = text "," id[nodes[list[k]]]
   return text
}

# FORCE or MOMENT: a vector, in global axes or, in a turned model, in those of its system 90
function vector(scale, axial, x, y, z) {
   if (own_axes) { o1 = x; o2 = y; o3 = z; vector_system = 90 }
   else { turned(x, y, z); if (axial && det < 0) { o1 = -o1; o2 = -o2; o3 = -o3 }; vector_system = 0 }
   return vector_system "," real(scale) "," real(o1) "," real(o2) "," real(o3)
}

function point(x, y, z) { placed(x, y, z); return real(o1) "," real(o2) "," real(o3) }

function write_variant(name,   i, k, s, j, file, n, text, f, set, e, kept, t, cd, place, law) {
   identity()
   isotropic = !on["cubic"] && gap_kind != "PLANE"
   own_axes = own_places = 0
   start_random(copy * 7 + v)
   if (name == "m") { det = -1; k = axi ? 2 : 1; T[k, k] = -1 }
   if (name == "q") { turn(); if (!axi) { own_axes = random(2); own_places = random(2) } }
   if (name == "u") { s_l = 10 ^ (random(7) - 3); s_f = 10 ^ (random(7) - 3) }
   numbers(name == "r")
   printf "VARIANT %s", name
   for (i = 1; i <= 3; i++) for (k = 1; k <= 3; k++) printf " %.17g", T[i, k]
   printf " %.17g %.17g %.17g\n", s_l, s_f, shift
   n_out = 0
   stress = s_f / s_l ^ 2
   # bodies
   for (i = 1; i <= nn; i++) {
      cd = frame_of[i] ? frame_of[i] : (name == "q" && !axi && (need[i] || i == rbe2 || i == rbe3 || i % 2)) ? 90 : ""
      if (own_places) put("GRID," id[i] ",90," real(X[i]) "," real(Y[i]) "," real(Z[i]) "," cd)
      else put("GRID," id[i] ",," point(X[i], Y[i], Z[i]) "," cd)
   }
   if (name == "q" && !axi) card("CORD2R,90,," point(0, 0, 0) "," point(0, 0, 1) "," point(1, 0, 0))
   for (f = 1; f <= n_frames; f++)
      card("CORD2" f_kind[f] "," f ",," point(f_a[f, 1], f_a[f, 2], f_a[f, 3]) "," point(f_b[f, 1], f_b[f, 2], f_b[f, 3]) "," point(f_c[f, 1], f_c[f, 2], f_c[f, 3]))
   for (e = 1; e <= ne; e++)
      card(e_type[e] "," eid[e] "," e_pid[e] connection(e, name == "r") (e_offset[e] ? ",," real(e_offset[e] * s_l) : ""))
   for (k = 1; k <= n_blocks; k++) {
      if (axi) put("PAXIS," k "," k)
      else if (shell_thickness && k == n_blocks) put("PSHELL," k "," k "," real(shell_thickness * s_l) "," k ",," k)
      else if (space) put("PSOLID," k "," k ",,,," (on["tri"] && k == 1 || order_of[k] == 2 ? "" : "MODES"))
      else put("PSHELL," k "," k "," real(thick * s_l) (k == 1 ? ",,,,,\n+,YES" : ""))
      put("MAT1," k "," real(modulus * (k == 2 ? 0.6 : 1) * stress) ",," (k == 2 ? ".33" : ".27") "," real(density * s_f / s_l ^ 4) "," real(expansion * k) ",20.")
      put("PMARK," 10 * k + 1)
      if (!on["split"] || k == n_blocks) put("PMARK," 10 * k + 2)
   }
   if (wall_thickness) put("PSHELL,9," n_blocks "," real(wall_thickness * s_l) "," n_blocks ",," n_blocks "\nPMARK,95\nSHELLTO,95," 10 * n_blocks + 2)
   # joints
   for (j = 1; j <= n_joints; j++) put("JOINT," j ",1," side_1[j] "," (side_2[j] ? side_2[j] : "") "," (gap_kind == "TRUE" && side_2[j] ? real(0.05 * s_l) : ""))
   put("PJOINT,1,1," (sheared ? "1,1" : ",") "," (rough ? real(mu) "," nrean : ",") "," (p0 ? real(p0 * stress) : ""))
   put("JNORM,1," real(c * s_l / stress ^ m) "," real(m) "," real(e_u * stress / s_l))
   law = stress / s_l
   if (sheared) {
      if (on["cubic"]) {
         put("JSHEAR,1," real(a11 * law) "," real(a12 / s_l) "," real(-0.5 * a11 / d_ref * law / s_l) "," real(-0.5 * a12 / d_ref / s_l ^ 2) "," real(0.25 * a11 / d_ref ^ 2 * law / s_l ^ 2) "," real(0.25 * a12 / d_ref ^ 2 / s_l ^ 3) \
             (n_spc % 2 ? "\n+," real(a11 * law) "," real(a12 / s_l) ",,,,\n+," real(a11 * law) "," real(a12 / s_l) ",,,," : masing_branches()))
      } else put("JSHEAR,1," real(a11 * law) "," real(a12 / s_l))
   }
   if (on["gap"]) write_gap()
   # supports, springs
   for (i = 1; i <= n_spc; i++) put("SPC1,1," spc_comp[i] "," id[spc_node[i]])
   for (i = 1; i <= n_springs; i++) put("CELAS2," eid[ne + 2 + i] "," real(s_k[i] * s_f / s_l) "," id[s_node[i]] "," s_comp[i])
   # dependent nodes
   if (rbe2) {
      text = "RBE2," eid[ne + 1] "," id[rbe2] "," (space ? "123" : "12")
      kept = name == "r" ? random(n_top) : 0
      for (i = 1; i <= n_top; i++) text = text "," id[top_node[1 + (i + kept) % n_top]]
      card(text)
   }
   if (rbe3) {
      text = "RBE3," eid[ne + 2] ",," id[rbe3] "," (space ? "123456" : "126")
      kept = name == "r" ? random(n_top) : 0
      for (i = 1; i <= n_top; i++) { k = 1 + (i + kept) % n_top; text = text "," real(rbe3_w[k]) "," (space ? "123" : "12") "," id[top_node[k]] }
      card(text)
   }
   if (on["mpc"] && n_mpc) {
      text = "MPC,1," id[m_dependent] "," m_comp "," real(sign(m_dependent, m_comp)) "," id[m_node[1]] "," m_comp "," real(m_w[1] * sign(m_node[1], m_comp)) ","
      for (i = 2; i <= n_mpc; i++) text = text (i % 2 ? "" : "\n+,") "," id[m_node[i]] "," m_comp "," real(m_w[i] * sign(m_node[i], m_comp)) (i % 2 ? "," : "")
      put(text)
   }
   # bolt
   if (bolt) {
      put("CROD," eid[ne + 299] ",90," id[bolt_top] "," id[bolt])
      put("PROD,90,1," real(bolt_area * s_l ^ 2))
      put("BOLT,1," eid[ne + 299] "," real(preload * s_f) "," bolt_stage)
   }
   # loads
   for (i = 1; i <= n_loads; i++) {
      if (l_kind[i] == "FORCE") put("FORCE," l_set[i] "," id[l_where[i]] "," vector(s_f, 0, l_1[i], l_2[i], l_3[i]))
      else if (l_kind[i] == "MOMENT") put("MOMENT," l_set[i] "," id[l_where[i]] "," vector(s_f * s_l, 1, l_1[i], l_2[i], l_3[i]))
      else if (l_kind[i] == "FORCEM") {
         if (l_1[i] != 0 || l_2[i] != 0 || l_3[i] != 0) { turned(l_1[i], l_2[i], l_3[i]); put("FORCEM," l_set[i] "," real(s_f) "," real(o1) "," real(o2) "," real(o3) "," l_where[i]) }
      } else if (l_kind[i] == "PLOADM") put("PLOADM," l_set[i] "," real(l_1[i] * stress) "," l_where[i])
      else if (l_kind[i] == "SPCD") put("SPCD," l_set[i] "," id[l_where[i]] "," l_1[i] "," real(l_2[i] * s_l * sign(l_where[i], l_1[i])))
   }
   for (s = 1; s <= n_stages; s++) {
      if (on["path"]) ;
      else if (progression[s] == "LIST") { text = "JINCR," 50 + s ",,LIST"; for (k = 1; k <= parts[s]; k++) text = text "," real(2 * k / (parts[s] * (parts[s] + 1))); card(text) }
      else put("JINCR," 50 + s "," parts[s] "," progression[s] (progression[s] == "GEOM" && parts[s] > 1 ? "," real(0.7 / parts[s]) : ",.1"))
      if (warm[s]) for (i = 1; i <= nn; i++) put("TEMP," 70 + s "," id[i] "," real(20 + warm[s] * temp_of[i]))
      if (warm[s] && shell_thickness) for (e = 1; e <= ne; e++) if (e_pid[e] == n_blocks && e % 3)
         put("TEMPP1," 70 + s "," eid[e] "," real(20 + warm[s] * shell_warm) "," real(warm[s] * shell_slope / s_l))
   }
   if (on["modes"]) put("EIGRL,4,,," (space ? 4 : 3))
   # the file
   file = folder "/d" copy name ".bdf"
   printf "METHOD = %s\nSOLVER = %s\nECHO = NO\n", method, name == "t" ? other : solver > file
   if (n_spc) print "SPC = 1" > file
   if (on["carry"]) print "CARRY = YES" > file
   if (on["path"]) print "PATHTOL = " real(name == "p" ? path_tol / 10 : path_tol) > file
   if (on["mpc"] && n_mpc) print "MPC = 1" > file
   if (on["restart"]) print "RESTART = 1" > file
   if (on["modes"]) printf "MODES = 4\nSTIFFNESS = %s\n", copy % 2 ? "LOAD" : "UNLOAD" > file
   print on["vtu"] ? "OUTPUT = LAST, VTU, STATE" : "OUTPUT = LAST" > file
   for (s = 1; s <= n_stages; s++) {
      printf "SUBCASE %d\n  LOAD = %d\n", s, 10 * s > file
      if (method != "BACK" && !on["path"]) printf "  INCR = %d\n", 50 + s > file
      if (warm[s]) printf "  TEMPERATURE(LOAD) = %d\n", 70 + s > file
   }
   print "BEGIN BULK" > file
   if (name == "r") for (i = n_out; i > 1; i--) { k = 1 + random(i); t = out[i]; out[i] = out[k]; out[k] = t }
   for (i = 1; i <= n_out; i++) print out[i] > file
   print "ENDDATA" > file
   close(file)
}

function write_gap(   k, n, text, sgn, list, s1, b) {
   if (gap_kind == "CONST") put("JGAP," gap_joint ",CONST," real(g0 * s_l))
   else if (gap_kind == "TRUE") put("JGAP," gap_joint ",TRUE")
   else if (gap_kind == "PLANE") {
      # x of the joint points towards +x of the model, in the plane of the joint
      sgn = (det < 0 && !axi) || (!space && T[1, 1] < 0) ? -1 : 1
      gy_sign = 1
      put("JGAP," gap_joint ",PLANE," real(g0 * s_l) "," real(sgn * gsx) "," real(gsy * y_sense()) "," real(gcx / s_l) "," real(gcy / s_l))
   } else if (gap_kind == "TABLE") {
      text = "JGAP," gap_joint ",TABLE"
      for (k = 1; k <= n_table; k++) {
         if (space) placed(t_x[k], t_y[k], joint_z[gap_joint]); else placed(t_x[k], t_y[k], 0)
         text = text (k % 2 ? "\n+," : ",") real(o1) "," real(o2) "," real(o3) "," real(t_g[k] * s_l)
      }
      put(text)
   } else {
      text = "JGAP," gap_joint ",NODES"
      b = int(side_1[gap_joint] / 10)
      n = side_1[gap_joint] % 10 == 1 ? bottom_of(b, list) : top_of(b, list)
      s1 = 0
      for (k = 1; k <= n; k++) if (k % 3) { s1++; text = text (s1 % 4 == 1 ? "\n+," : ",") id[list[k]] "," real(lambda_ref * s_l * (0.5 * sin(5 * k + copy))) }
      put(text)
   }
}

# y of a joint is its normal cross x: in the model the normal of side 1 points down or up
function y_sense() { return 1 }

# ORIGIN BRANCH with B = C = 2 A(d/2)
function masing_branches(   b) {
   b = "\n+," real(a11 * stress / s_l) "," real(a12 / s_l) "," real(-0.25 * a11 / d_ref * stress / s_l ^ 2) "," real(-0.25 * a12 / d_ref / s_l ^ 2) "," \
       real(0.0625 * a11 / d_ref ^ 2 * stress / s_l ^ 3) "," real(0.0625 * a12 / d_ref ^ 2 / s_l ^ 3)
   return b b "\n+,,,BRANCH"
}
