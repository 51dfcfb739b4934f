# The model of a deck, once, in arrays; pairs_write.awk writes it as it is, renumbered, mirrored, turned, in other units.
#
# Blocks stand one on the other, along y in the plane and on rings, along z in space; the lowest is clamped, or stands on a rigid
# base. Joint j lies below block j + 1 (on a rigid base below block j). The load presses the top down and pushes it aside, never so
# much that it falls over, and, where nothing but friction holds it, never so much that it slides away.

# A random number between A and B with a step that no structure has twice
function between(a, b) { return a + (b - a) * (random(1000003) + 0.5) / 1000003 }

function node(x, y, z) {
   nn++
   X[nn] = x; Y[nn] = y; Z[nn] = z
   frame_of[nn] = 0; need[nn] = 0
   return nn
}

function element(type, pid, text) {
   ne++
   e_type[ne] = type; e_pid[ne] = pid
   e_n[ne] = split(text, words_of, " ")
   for (w = 1; w <= e_n[ne]; w++) e_node[ne, w] = words_of[w]
}

# The node at the middle of an edge, one for all
function middle(a, b,   low, high) {
   low = a < b ? a : b; high = a < b ? b : a
   if (!((low, high) in mid)) mid[low, high] = node((X[a] + X[b]) / 2, (Y[a] + Y[b]) / 2, (Z[a] + Z[b]) / 2)
   return mid[low, high]
}

# Divisions of a line: N parts, uneven
function divide(line, a, b, n,   i) {
   for (i = 0; i <= n; i++) line[i] = a + (b - a) * (i + (i > 0 && i < n ? between(-0.2, 0.2) : 0)) / n
}

# Second order: the nodes at the middle of EDGES, pairs of corners
function with_middles(text, edges, order,   corner, e, n, k, list) {
   if (order == 1) return text
   split(text, corner, " ")
   n = split(edges, list, " ")
   for (k = 1; k < n; k += 2) text = text " " middle(corner[list[k]], corner[list[k + 1]])
   return text
}

# Block B in the plane between lines gx (NX parts) and from Y0 to Y1
function block_2(b, nx, ny, y0, y1, order, tri,   i, j, x, y, a, c, d, f) {
   for (i = 0; i <= nx; i++) for (j = 0; j <= ny; j++) {
      x = gx[i]; y = y0 + (y1 - y0) * j / ny
      if (i > 0 && i < nx && j > 0 && j < ny) { x += between(-0.15, 0.15) * (gx[nx] - gx[0]) / nx; y += between(-0.15, 0.15) * (y1 - y0) / ny }
      at[b, i, j, 0] = shares && j == 0 ? at[b - 1, i, layers[b - 1], 0] : node(x, y, 0)
   }
   for (i = 0; i < nx; i++) for (j = 0; j < ny; j++) {
      a = at[b, i, j, 0]; c = at[b, i + 1, j, 0]; d = at[b, i + 1, j + 1, 0]; f = at[b, i, j + 1, 0]
      if (tri) {
         element(order == 2 ? "CTRIA6" : "CTRIA3", b, with_middles(a " " c " " d, "1 2 2 3 3 1", order))
         element(order == 2 ? "CTRIA6" : "CTRIA3", b, with_middles(a " " d " " f, "1 2 2 3 3 1", order))
      } else element(order == 2 ? "CQUAD8" : "CQUAD4", b, with_middles(a " " c " " d " " f, "1 2 2 3 3 4 4 1", order))
   }
   for (i = 0; i < nx; i++) {
      element("CBAR", 10 * b + 1, at[b, i, 0, 0] " " at[b, i + 1, 0, 0])
      if (!next_shares) element("CBAR", 10 * b + 2, at[b, i, ny, 0] " " at[b, i + 1, ny, 0])
      if (order == 2) { on_bottom[b, middle(at[b, i, 0, 0], at[b, i + 1, 0, 0])] = 1; on_top[b, middle(at[b, i, ny, 0], at[b, i + 1, ny, 0])] = 1 }
   }
   for (i = 0; i <= nx; i++) { on_bottom[b, at[b, i, 0, 0]] = 1; on_top[b, at[b, i, ny, 0]] = 1; if (ny > 1) within[b, at[b, i, 1, 0]] = 1 }
}

# A face between four corners, as one quadrilateral or two triangles, marked PID; its nodes to the bottom or the top of block B
function face(b, pid, p, q, r, s, tri, order,   k) {
   if (tri) { element("CTRIA3", pid, p " " q " " r); element("CTRIA3", pid, p " " r " " s) }
   else element("CQUAD4", pid, p " " q " " r " " s)
   side_node(b, pid, p); side_node(b, pid, q); side_node(b, pid, r); side_node(b, pid, s)
   if (order == 1) return
   side_node(b, pid, middle(p, q)); side_node(b, pid, middle(q, r)); side_node(b, pid, middle(r, s)); side_node(b, pid, middle(s, p))
   if (tri) side_node(b, pid, middle(p, r))
}
function side_node(b, pid, n) { if (pid % 10 == 1) on_bottom[b, n] = 1; else on_top[b, n] = 1 }

# Block B in space, of bricks, wedges (tri = 1) or tetrahedra (tri = 2)
function block_3(b, nx, ny, nz, z0, z1, order, tri,   i, j, k, x, y, z, c, n, s, t, list, corner) {
   for (i = 0; i <= nx; i++) for (j = 0; j <= ny; j++) for (k = 0; k <= nz; k++) {
      x = gx[i]; y = gy[j]; z = z0 + (z1 - z0) * k / nz
      if (i > 0 && i < nx && j > 0 && j < ny && k > 0 && k < nz) { x += between(-0.1, 0.1) * (gx[nx] - gx[0]) / nx; z += between(-0.1, 0.1) * (z1 - z0) / nz }
      at[b, i, j, k] = shares && k == 0 ? at[b - 1, i, j, layers[b - 1]] : node(x, y, z)
   }
   for (i = 0; i < nx; i++) for (j = 0; j < ny; j++) for (k = 0; k < nz; k++) {
      c = at[b, i, j, k] " " at[b, i + 1, j, k] " " at[b, i + 1, j + 1, k] " " at[b, i, j + 1, k] " " \
          at[b, i, j, k + 1] " " at[b, i + 1, j, k + 1] " " at[b, i + 1, j + 1, k + 1] " " at[b, i, j + 1, k + 1]
      split(c, corner, " ")
      if (tri == 0) element("CHEXA", b, with_middles(c, "1 2 2 3 3 4 4 1 1 5 2 6 3 7 4 8 5 6 6 7 7 8 8 5", order))
      else if (tri == 1) {
         element("CPENTA", b, with_middles(corner[1] " " corner[2] " " corner[3] " " corner[5] " " corner[6] " " corner[7], "1 2 2 3 3 1 1 4 2 5 3 6 4 5 5 6 6 4", order))
         element("CPENTA", b, with_middles(corner[1] " " corner[3] " " corner[4] " " corner[5] " " corner[7] " " corner[8], "1 2 2 3 3 1 1 4 2 5 3 6 4 5 5 6 6 4", order))
      } else {
         n = split("1 2 3 7 1 3 4 7 1 4 8 7 1 8 5 7 1 5 6 7 1 6 2 7", list, " ")
         for (s = 1; s < n; s += 4) {
            t = corner[list[s]] " " corner[list[s + 1]] " " corner[list[s + 2]] " " corner[list[s + 3]]
            element("CTETRA", b, with_middles(t, "1 2 2 3 3 1 1 4 2 4 3 4", order))
         }
      }
   }
   for (i = 0; i < nx; i++) for (j = 0; j < ny; j++) {
      face(b, 10 * b + 1, at[b, i, j, 0], at[b, i + 1, j, 0], at[b, i + 1, j + 1, 0], at[b, i, j + 1, 0], tri > 0, order)
      if (!next_shares) face(b, 10 * b + 2, at[b, i, j, nz], at[b, i + 1, j, nz], at[b, i + 1, j + 1, nz], at[b, i, j + 1, nz], tri > 0, order)
   }
   for (i = 0; i <= nx; i++) for (j = 0; j <= ny; j++) if (nz > 1) within[b, at[b, i, j, 1]] = 1
}

# Block B of one layer of shells of thickness T on the height Z0, their nodes off the middle by OFFSET; quadrilaterals or triangles
function block_s(b, nx, ny, z0, t, offset, tri,   i, j, p, q, r, s) {
   for (i = 0; i <= nx; i++) for (j = 0; j <= ny; j++) {
      at[b, i, j, 0] = at[b, i, j, 1] = node(gx[i], gy[j], z0 + t / 2 - offset)
      on_bottom[b, nn] = on_top[b, nn] = 1
   }
   for (i = 0; i < nx; i++) for (j = 0; j < ny; j++) {
      p = at[b, i, j, 0]; q = at[b, i + 1, j, 0]; r = at[b, i + 1, j + 1, 0]; s = at[b, i, j + 1, 0]
      if (tri) {
         element("CTRIA3", b, p " " q " " r); e_offset[ne] = offset
         element("CTRIA3", b, p " " r " " s); e_offset[ne] = offset
         element("CTRIA3", 10 * b + 1, p " " r " " q); element("CTRIA3", 10 * b + 1, p " " s " " r)
         element("CTRIA3", 10 * b + 2, p " " q " " r); element("CTRIA3", 10 * b + 2, p " " r " " s)
      } else {
         element("CQUAD4", b, p " " q " " r " " s); e_offset[ne] = offset
         element("CQUAD4", 10 * b + 1, p " " s " " r " " q)
         element("CQUAD4", 10 * b + 2, p " " q " " r " " s)
      }
   }
}

# A wall of shells on the top block, at Y along most of its LENGTH from X0 and upright from Z0; marked 95 on its lower edge
function stand_wall(x0, length_of, y, z0,   i, k, n, w) {
   wall_thickness = 0.05 * length_of
   n = 3 + random(3)
   for (k = 0; k <= 2; k++) for (i = 0; i <= n; i++) w[i, k] = node(x0 + length_of * (0.15 + 0.7 * i / n), y, z0 + 0.1 * length_of * k)
   for (k = 0; k < 2; k++) for (i = 0; i < n; i++) element("CQUAD4", 9, w[i, k] " " w[i + 1, k] " " w[i + 1, k + 1] " " w[i, k + 1])
   for (i = 0; i < n; i++) element("CBAR", 95, w[i, 0] " " w[i + 1, 0])
}

function forget(   k) {
   split("", X); split("", Y); split("", Z); split("", mid); split("", at); split("", on_bottom); split("", on_top); split("", within)
   split("", depends); split("", e_offset)
   shell_thickness = wall_thickness = 0
   split("", e_node); split("", held); split("", sign_of)
   nn = ne = n_frames = n_loads = n_mpc = n_springs = n_spc = n_temps = 0
   rbe2 = rbe3 = bolt = 0
}

# Support of components C of node N
function hold(n, c) { n_spc++; spc_node[n_spc] = n; spc_comp[n_spc] = c; need[n] = 1 }
function spring(n, c, k) { n_springs++; s_node[n_springs] = n; s_comp[n_springs] = c; s_k[n_springs] = k; need[n] = 1 }
function load(set, kind, where, a, b, c) {
   n_loads++
   l_set[n_loads] = set; l_kind[n_loads] = kind; l_where[n_loads] = where
   l_1[n_loads] = a; l_2[n_loads] = b; l_3[n_loads] = c
}
# A coordinate system for displacements: rectangular, axes turned by ANGLE about the axis of the stack (plane: about z)
function new_frame(kind, ax, ay, az, bx, by, bz, cx, cy, cz) {
   n_frames++
   f_kind[n_frames] = kind
   f_a[n_frames, 1] = ax; f_a[n_frames, 2] = ay; f_a[n_frames, 3] = az
   f_b[n_frames, 1] = bx; f_b[n_frames, 2] = by; f_b[n_frames, 3] = bz
   f_c[n_frames, 1] = cx; f_c[n_frames, 2] = cy; f_c[n_frames, 3] = cz
   return n_frames
}

# the nodes of the top of block B, in order, to list[1..]
function top_of(b, list,   i, n) { n = 0; for (i = 1; i <= nn; i++) if ((b, i) in on_top) list[++n] = i; return n }
function bottom_of(b, list,   i, n) { n = 0; for (i = 1; i <= nn; i++) if ((b, i) in on_bottom) list[++n] = i; return n }
function within_of(b, list,   i, n) { n = 0; for (i = 1; i <= nn; i++) if ((b, i) in within) list[++n] = i; return n }

function make_model(   b, i, j, n, x0, x1, y0, z, length_, width, h, e, list, top, angle, stage, d, share, fit, ord, triangles, nx, ny, nz, wide, k, area_top, lever) {
   forget()
   space = on["space"]; axi = on["axi"]; plane = !space && !axi
   up = space ? 3 : 2
   # laws: a pressure, a deflection at it
   modulus = between(2e4, 2e5)
   p_ref = between(0.3, 3)
   m = random(5) == 0 ? 1 : between(0.4, 0.9)
   lambda_ref = between(1e-3, 8e-3)
   c = lambda_ref / p_ref ^ m
   e_u = between(3, 8) * (3 * p_ref) ^ (1 - m) / (m * c)
   a11 = between(0.2, 0.7) * p_ref / lambda_ref
   a12 = random(2) ? between(0.1, 0.4) / lambda_ref : 0
   d_ref = lambda_ref * between(0.5, 1.5)
   mu = between(0.15, 0.4)
   nrean = chance("-1 -1 1 3")
   thick = between(8, 15)
   n_blocks = (on["base"] ? 1 : 2) + on["two"]
   n_joints = n_blocks - 1 + on["base"]
   length_ = between(24, 40)
   width = space ? between(15, 25) : thick
   x0 = axi ? between(15, 40) : between(-10, 10)
   x1 = x0 + length_
   y0 = between(-8, 8)
   z = between(-5, 5)
   bottom_height = z
   apart = on["gap"] && random(3) == 0 ? between(0.1, 0.8) * lambda_ref : 0 # the mesh itself has a gap
   gap_kind = !on["gap"] ? "" : apart ? "TRUE" : chance(space ? "CONST PLANE TABLE NODES" : "CONST PLANE TABLE NODES")
   if (apart && (on["base"] || on["split"])) { apart = 0; gap_kind = "CONST" }
   first_order = on["order2"] ? 2 : 1
   for (b = 1; b <= n_blocks; b++) {
      fit = on["fit"] || on["part"]
      ord = first_order
      if (b > 1 && fit && on["order2"] && random(2)) ord = 1
      if (b == 1 || !on["split"]) triangles = on["tri"] && (b == 1 || random(2)) ? (space ? 1 + random(2) : 1) : 0
      if (b == 1 || fit) {
         nx = space ? (ord == 2 ? 1 + random(2) : 2 + random(2)) : (ord == 2 ? 2 + random(2) : 3 + random(4))
         ny = space ? (ord == 2 ? 1 + random(2) : 1 + random(3)) : 0
         if (b > 1 && !on["part"] && nx == last_nx) nx++
         if (on["part"] && b > 1) { x0 += between(0.05, 0.2) * length_; x1 += between(-0.1, 0.2) * length_; if (space) { y0 += between(-0.2, 0.2) * width; } }
         divide(gx, x0, x1, nx)
         if (space) divide(gy, y0, y0 + width, ny)
         last_nx = nx
      } else if (space || ord == 2) triangles = triangles # the same divisions
      h = between(0.2, 0.35) * length_
      nz = on["mpc"] || random(2) ? 2 : 1
      left[b] = gx[0]; right[b] = gx[nx]; front[b] = gy[0]; back_[b] = gy[ny]
      layers[b] = nz
      shares = on["split"] && b > 1 # the nodes of the block below: a joint splits them
      next_shares = on["split"] && b < n_blocks
      if (on["shell"] && b == n_blocks) {
         h = shell_thickness = between(0.1, 0.2) * length_
         shell_warm = between(0.5, 1.5); shell_slope = between(-0.5, 0.5) / h
         block_s(b, nx, ny, z, h, random(2) ? between(-0.3, 0.3) * h : 0, triangles)
      } else if (space) block_3(b, nx, ny, nz, z, z + h, ord, triangles)
      else block_2(b, nx, nz, z, z + h, ord, triangles)
      bottom_at[b] = z; top_at[b] = z + h
      order_of[b] = ord
      z += h + apart
   }
   top = n_blocks
   if (on["wall"]) stand_wall(left[top], right[top] - left[top], front[top] + between(0.4, 0.6) * (back_[top] - front[top]), top_at[top])
   # areas of the joints: what both sides have in common
   for (j = 1; j <= n_joints; j++) {
      b = on["base"] ? j : j + 1 # the block above
      if (b == 1) { from_x = left[1]; to_x = right[1]; from_y = front[1]; to_y = back_[1] }
      else {
         from_x = left[b] > left[b - 1] ? left[b] : left[b - 1]; to_x = right[b] < right[b - 1] ? right[b] : right[b - 1]
         from_y = front[b] > front[b - 1] ? front[b] : front[b - 1]; to_y = back_[b] < back_[b - 1] ? back_[b] : back_[b - 1]
      }
      area[j] = axi ? 3.14159265358979324 * (to_x ^ 2 - from_x ^ 2) : space ? (to_x - from_x) * (to_y - from_y) : (to_x - from_x) * thick
      joint_x[j] = (from_x + to_x) / 2; joint_y[j] = (from_y + to_y) / 2; joint_z[j] = bottom_at[b]
      joint_length[j] = to_x - from_x; joint_width[j] = to_y - from_y
      side_1[j] = 10 * b + 1; side_2[j] = b == 1 ? 0 : 10 * (b - 1) + 2
      if (b > 1 && on["split"]) side_2[j] = 0
      else if (b > 1 && random(2)) { side_1[j] = 10 * (b - 1) + 2; side_2[j] = 10 * b + 1 }
   }
   n_press = p_ref * area[n_joints] * between(0.7, 1.3)
   height = top_at[top] - joint_z[1]
   # systems of displacements
   if (on["cd"] && !axi) {
      angle = between(0.2, 1.2)
      new_frame("R", 0, 0, 0, 0, 0, 1, cos(angle), sin(angle), 0)
      if (space) {
         new_frame("R", 1, 2, 3, 1 + between(0.3, 1), 2 + between(0.3, 1), 4, 2, 2, 3)
         new_frame("C", left[1] - 17, front[1] - 9, 0, left[1] - 17, front[1] - 9, 1, left[1], front[1] - 3, 0)
      } else new_frame("C", left[1] - 17, bottom_height - 9, 0, left[1] - 17, bottom_height - 9, 1, left[1], bottom_height - 3, 0)
      for (i = 1; i <= nn; i++) if (random(3) == 0) frame_of[i] = 1 + random(n_frames)
   }
   # what holds the lowest block
   if (!on["base"]) { n = bottom_of(1, list); for (i = 1; i <= n; i++) hold(list[i], axi ? "12" : space ? "123" : "12") }
   # the top: dependent nodes
   n = top_of(top, list)
   n_top = n
   for (i = 1; i <= n; i++) top_node[i] = list[i]
   lever = 0
   if (on["rbe2"]) {
      rbe2 = node((left[top] + right[top]) / 2 + between(-1, 1), plane ? top_at[top] + between(1, 3) : (front[top] + back_[top]) / 2 + between(-1, 1), plane ? 0 : top_at[top] + between(1, 3))
      if (n_frames && random(2)) frame_of[rbe2] = 1
      for (i = 1; i <= n; i++) depends[top_node[i]] = 1
   }
   if (on["rbe3"]) {
      rbe3 = node((left[top] + right[top]) / 2 + between(-1, 1), plane ? top_at[top] + between(1, 3) : (front[top] + back_[top]) / 2 + between(-1, 1), plane ? 0 : top_at[top] + between(1, 3))
      if (n_frames && random(2)) frame_of[rbe3] = 1
      for (i = 1; i <= n; i++) rbe3_w[i] = between(0.5, 2)
   }
   # what holds the top along the joint: its shear law alone, springs, a support
   holding = axi ? "none" : chance("shear shear springs support")
   if ((on["bolt"] || on["moved"]) && holding == "shear") holding = "springs"
   sheared = !(random(3) == 0 && holding != "shear") || on["friction"] || on["cubic"] || n_joints > 1
   if (axi) sheared = on["friction"] || random(2)
   for (b = on["base"] ? 1 : 2; b <= n_blocks; b++) if (holding == "springs" && (sheared == 0 || b == top)) {
      k = 0.3 * a11 * area[n_joints]
      if (b == top && rbe2) { spring(rbe2, 1, k); if (space) spring(rbe2, 2, k) }
      else {
         n = top_of(b, list)
         for (i = 1; i <= n; i++) { spring(list[i], 1, k / n); if (space) spring(list[i], 2, k / n) }
         # along directions of their own these springs press the joint too; keep them along the joint
         for (i = 1; i <= n; i++) frame_of[list[i]] = frame_of[list[i]] == 1 && space ? 1 : 0
      }
      if (b == top && rbe2) {
         if (!(space && frame_of[rbe2] == 1)) frame_of[rbe2] = 0
         if (space && !sheared && !on["moved"]) hold(rbe2, "6") # one spring along each axis: no hold against a twist
      }
   }
   if (holding == "support") {
      if (rbe2) { frame_of[rbe2] = space ? frame_of[rbe2] : 0; hold(rbe2, space ? (on["moved"] ? "12" : "126") : "1") }
      else if (space) {
         a = at[top, 0, 0, 1]; for (i = 1; (top, i, 0, 1) in at; i++) e = at[top, i, 0, 1]
         frame_of[a] = frame_of[a] == 1 ? 1 : 0; frame_of[e] = 0
         hold(a, "12"); hold(e, "2")
      } else { a = at[top, 0, 1, 0]; frame_of[a] = 0; hold(a, "1"); depends[a] = 1 }
      if (space && !rbe2) { depends[a] = 1; depends[e] = 1 }
   }
   if (on["mpc"]) {
      b = top
      n = within_of(b, list)
      d = 1 + random(n)
      while (list[d] in depends) d = 1 + (d % n)
      comp = axi ? 2 : 1 + random(up)
      n_mpc = 0
      share = 0
      for (i = 1; i <= n; i++) if (i != d && !((list[i] in depends) && rbe2) && (n_mpc < 2 || random(2))) { n_mpc++; m_node[n_mpc] = list[i]; m_w[n_mpc] = between(0.5, 1); share += m_w[n_mpc] }
      for (i = 1; i <= n_mpc; i++) { m_w[i] = -m_w[i] / share; need[m_node[i]] = 1; frame_of[m_node[i]] = 0 }
      m_dependent = list[d]; need[m_dependent] = 1; frame_of[m_dependent] = 0
      m_comp = comp
      if (n_mpc == 0) { m_dependent = 0 }
   }
   # without MU an element that opens drops its shear stress at once, and NEWTON may have no answer, or several
   rough = on["friction"]
   if (!rough && sheared && on["newton"] && random(2)) { rough = 1; mu = between(1, 1.5) }
   # a bolt: a bar from the top to a node below that is held
   if (on["bolt"]) {
      i = 1 + random(n_top)
      bolt_top = rbe3 ? rbe3 : rbe2 ? rbe2 : top_node[i]
      if (axi || plane) bolt = node(X[bolt_top], bottom_height - 12, 0); else bolt = node(X[bolt_top], Y[bolt_top], bottom_height - 12)
      hold(bolt, axi || plane ? "12" : "123")
      preload = n_press * between(0.2, 0.5)
      bolt_area = between(10, 50)
      bolt_stage = on["stages"] && random(3) == 0 ? 2 : 1
   }
   if (on["moved"]) {
      if (rbe2) { frame_of[rbe2] = 0; hold(rbe2, up); hold(rbe2, space ? "456" : "6") }
      else for (i = 1; i <= n_top; i++) { frame_of[top_node[i]] = 0; if (!(i == 1 && 0)) hold(top_node[i], up) }
   }
   # loads of the stages
   n_stages = on["stages"] ? 2 + random(3) : 1
   for (stage = 1; stage <= n_stages; stage++) {
      press[stage] = n_press * (stage == 1 ? 1 : between(0.2, 1.4))
      push[stage] = axi ? 0 : press[stage] * (stage == 1 && random(2) ? 0 : (stage % 2 ? -1 : 1) * between(0.02, 0.12))
      if (holding != "shear" && !axi) push[stage] *= 1.6
      side[stage] = space ? press[stage] * between(-0.08, 0.08) : 0
      if (holding == "shear" && on["friction"]) {
         e = sqrt(push[stage] ^ 2 + side[stage] ^ 2) / (0.6 * mu * press[stage])
         if (e > 1) { push[stage] /= e; side[stage] /= e }
      }
      # the moment about the lowest joint is kept below a third of its length by the force
      if (!on["moved"]) {
         if (rbe2 || rbe3) {
            i = rbe2 ? rbe2 : rbe3
            if (space) load(10 * stage, "FORCE", i, push[stage], side[stage], -press[stage])
            else load(10 * stage, "FORCE", i, push[stage], -press[stage], 0)
            e = between(-0.03, 0.03) * press[stage] * length_
            if (space) load(10 * stage, "MOMENT", i, e / 3, e, e / 2)
            else load(10 * stage, "MOMENT", i, 0, 0, e)
         } else {
            e = between(0.2, 0.8)
            if (space) { load(10 * stage, "FORCEM", 10 * top + 2, push[stage], side[stage], -press[stage] * e); load(10 * stage, "PLOADM", 10 * top + 2, press[stage] * (1 - e) / ((right[top] - left[top]) * (back_[top] - front[top])), 0, 0) }
            else {
               load(10 * stage, "FORCEM", 10 * top + 2, push[stage], -press[stage] * e, 0)
               load(10 * stage, "PLOADM", 10 * top + 2, press[stage] * (1 - e) / (axi ? 3.14159265358979324 * (right[top] ^ 2 - left[top] ^ 2) : (right[top] - left[top]) * thick), 0, 0)
            }
         }
      } else {
         d = stage == 1 ? -lambda_ref * between(0.8, 2) : d * between(0.97, 1.3) # a little back at most: what is lifted off may be loose
         if (rbe2) load(10 * stage, "SPCD", rbe2, up, d, 0)
         else for (i = 1; i <= n_top; i++) load(10 * stage, "SPCD", top_node[i], up, d * (1 + 0.1 * (X[top_node[i]] - left[top]) / length_), 0)
         if (!axi) {
            if (rbe2) { if (push[stage] != 0 || side[stage] != 0) load(10 * stage, "FORCE", rbe2, push[stage], side[stage], 0) }
            else load(10 * stage, "FORCEM", 10 * top + 2, push[stage], side[stage], 0)
         }
      }
      total_x[stage] = push[stage]; total_y[stage] = space ? side[stage] : on["moved"] ? 0 : -press[stage]; total_z[stage] = space && !on["moved"] ? -press[stage] : 0
      if (plane && on["moved"]) total_y[stage] = 0
      warm[stage] = on["temp"] && (stage > 1 || random(2) || !on["stages"]) ? between(5, 40) : 0
      parts[stage] = 1 + random(4)
      progression[stage] = chance("ARITH GEOM LIST")
   }
   free = !on["moved"] && !on["bolt"] && holding == "shear" || axi && !on["moved"] && !on["bolt"]
   if (on["temp"]) for (i = 1; i <= nn; i++) if (random(3) == 0) temp_of[i] = between(0.5, 1.5); else temp_of[i] = 1
   expansion = between(8e-6, 2.4e-5)
   density = between(2e-9, 9e-9)
   # gaps
   if (on["gap"]) {
      gap_joint = 1 + random(n_joints)
      if (gap_kind == "TRUE" && side_2[gap_joint] == 0) gap_joint = 2
      if (gap_kind == "TRUE" && n_joints > 1 && on["base"]) gap_joint = 2
      g0 = between(-0.6, 0.6) * lambda_ref
      gsx = between(-0.4, 0.4) * lambda_ref / length_
      gsy = space ? between(-0.4, 0.4) * lambda_ref / length_ : 0
      gcx = between(-1, 2) * lambda_ref / length_ ^ 2
      gcy = space ? between(-1, 2) * lambda_ref / length_ ^ 2 : 0
   }
   # six-node triangles have no elements at their corners, which NODES cannot name
   if (gap_kind == "NODES" && space && on["tri"] && on["order2"]) gap_kind = "TABLE"
   # the pressure of the first increment: where statics does not give it
   p0 = on["back"] || random(2) && free && !on["temp"] && !on["gap"] && n_joints == 1 ? 0 : p_ref * between(0.05, 0.2)
}
