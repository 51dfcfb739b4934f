# Whether what must hold of every deck and its variants does.
#
#     awk -v folder=F -v tallies=FILE -f pairs_judge.awk LIST STDERR
#
# LIST is of pairs_write.awk; the results stand in FOLDER. Prints `FAILED: deck N (pair; features): what, with its numbers` and, in TALLIES,
# a line a deck: pair, solved or not, violations.

FILENAME != ARGV[1] {
   name = $1
   sub(/:$/, "", name)
   sub(/.*\//, "", name)
   sub(/\.bdf.*/, "", name)
   if (/errors?, nothing solved/) ended[name] = "refused"
   else if (/; no results$/) ended[name] = "unsolved"
   else if (/; the results end (there|at stage [0-9]+, increment [0-9]+)$/) ended[name] = "unsolved early"
   if (/; no results$|; the results end (there|at stage [0-9]+, increment [0-9]+)$/) why[name] = $0
   next
}
{ line[++lines] = $0 }

END {
   for (l = 1; l <= lines; l++) {
      n_words = split(line[l], w, " ")
      if (w[1] == "DECK") { if (number) judge(); begin() }
      else if (w[1] == "JOINT") { n_joints = w[2]; joint_area[w[2]] = w[3]; c = w[4]; m = w[5]; e_u = w[6]; mu = w[7]; nrean = w[8]; a11 = w[9]; stores = w[10] }
      else if (w[1] == "LOADS") { n_stages = w[2]; for (k = 1; k <= 3; k++) load[w[2], k] = w[2 + k] }
      else if (w[1] == "CARRIES") { carries_n[w[2], w[3]] = w[4]; carries_t[w[2], w[3]] = w[5] }
      else if (w[1] == "CELLS") cells = w[2]
      else if (w[1] == "PUSHED_AWAY") tolerance = 1e-3
      else if (w[1] == "DROPS") drops = 1
      else if (w[1] == "PATH") { path_tol = w[2]; if (tolerance < path_tol) tolerance = path_tol } # where another number of parts is within PATHTOL
      else if (w[1] == "VARIANT") {
         n_variants++
         variant[n_variants] = w[2]
         for (k = 1; k <= 9; k++) turn[n_variants, k] = w[2 + k]
         length_of[n_variants] = w[12]; force_of[n_variants] = w[13]; shift_of[n_variants] = w[14]
      }
   }
   if (number) judge()
   for (name in worst) print "LARGEST", name, worst[name], worst_at[name] > tallies
}

function begin(   k) {
   number = w[2]; pair = w[3]; method = w[4]; kind = w[5]
   split("", on)
   features = ""
   for (k = 6; k <= n_words; k++) { on[w[k]] = 1; features = features " " w[k] }
   n_variants = 0
   cells = drops = 0
   split("", carries_n)
   # What variants may differ by, of the largest of its kind. NEWTON stops at 1E-10 of the load and solutions have 12 digits; BACK stops
   # where pressures change by 1E-6. A body that interference pushes away stands still where its joint bears 1E-5 of p_av, which is up to
   # 1E-2 of the deflection: from there STEP's tangents and friction begin. A joint that slips all over is no hold: what is left of
   # the load moves its body by far more than elsewhere.
   tolerance = method == "BACK" ? 2e-5 : 1e-7
}

function failed(what) {
   violations++
   if (violations <= 4) printf "FAILED: deck %d (%s; %s %s:%s): %s\n", number, pair, method, kind, features, what
}

function abs(x) { return x < 0 ? -x : x }

function judge(   v, n, text) {
   violations = 0
   text = ""
   n = 0
   for (v = 1; v <= n_variants; v++) {
      file = "d" number variant[v]
      if (file in ended) { n++; text = text " " variant[v] ":" ended[file]; if (ended[file] == "refused") failed("deck " file " is refused") }
      else if ((getline ignored < (folder "/" file ".joint.csv")) <= 0) { n++; failed(file " has no results and no message: a crash?") }
      close(folder "/" file ".joint.csv")
   }
   if (n > 0 && n < n_variants) failed("some variants are solved, some not:" text ": " why["d" number substr(text, 2, 1)])
   if (n == 0) {
      read_joints(1)
      laws()
      answers(1)
      balance()
      energies(1)
      if (slips_all_over() && tolerance < 1e-5) tolerance = 1e-5
      if (on["vtu"]) paraview()
      for (v = 2; v <= n_variants; v++) {
         # without MU shear stress drops where an element opens, and the answer is not one (input/README.md, The shear law, opening)
         if (drops && has_opened()) break
         n_rows[v] = 0
         read_joints(v)
         if (variant[v] == "p") { finer_path(v); continue }
         same_joints(v)
         answers(v)
         energies(v)
         if (on["modes"]) same_table(v, "modes", "frequency", 1)
         if (on["bolt"]) same_table(v, "bolt", "force", force_of[v])
      }
   }
   printf "DECK %d %s %s %s %d%s\n", number, method, kind, (n == 0 ? "solved" : n == n_variants ? "unsolved" : "differ"), violations, features > tallies
}

# What a CSV file of variant V holds: value[SLOT, row, name]; answers the number of rows
function read_table(v, ending, slot,   path, n, k, names, text, parts, count) {
   path = folder "/d" number variant[v] "." ending ".csv"
   if ((getline text < path) <= 0) { failed("no " path); close(path); return 0 }
   count = split(text, names, ",")
   n = 0
   while ((getline text < path) > 0) {
      n++
      split(text, parts, ",")
      for (k = 1; k <= count; k++) value[slot, n, names[k]] = parts[k]
   }
   close(path)
   return n
}

function read_joints(v,   r) {
   if (v == 1) split("", value)
   n_rows[v] = read_table(v, "joint", v)
   per[v] = 0
   for (r = 1; r <= n_rows[v]; r++) if (value[v, r, "increment"] == 1 && value[v, r, "stage"] == value[v, 1, "stage"]) per[v]++
}

# On its law every element, alone: p, areas, LOAD, the unloading line through its point A, friction
function laws(   r, k, p, lambda, j, sum, largest_p, q, top, a, area, limit, loose, exact, last, path_dependent) {
   largest_p = largest(1, "pressure")
   path_dependent = method == "STEP"
   loose = method == "BACK" ? 1e-4 : 1e-6
   split("", sum)
   split("", top)
   split("", last)
   split("", opened)
   for (r = 1; r <= n_rows[1]; r++) {
      j = value[1, r, "joint"]
      k = j " " value[1, r, "element"]
      p = value[1, r, "pressure"]; lambda = value[1, r, "lambda"]; area = value[1, r, "area"]
      if (r <= per[1]) sum[j] += area
      if (!(area > 0)) failed(sprintf("row %d: area %s", r, area))
      if (p < 0) failed(sprintf("row %d: p %s", r, p))
      if (value[1, r, "branch"] == "OPEN" && (p != 0 || value[1, r, "force"] != 0 || value[1, r, "tau_x"] != 0 || value[1, r, "tau_y"] != 0))
         failed(sprintf("row %d: open, with p %s, force %s, tau %s", r, p, value[1, r, "force"], value[1, r, "tau_x"]))
      measure("force = p a", abs(p * area - value[1, r, "force"]) / (largest_p * area), 1e-11, r)
      limit = mu * p
      if (mu >= 0) {
         q = sqrt(value[1, r, "tau_x"] ^ 2 + value[1, r, "tau_y"] ^ 2)
         if (method != "STEP" || nrean == -1) measure("friction", (q - limit) / (mu * largest_p), method == "STEP" ? 1e-6 : loose, r)
         if (method != "STEP" && value[1, r, "slip"] == 1) measure("slip at the limit", abs(q - limit) / (mu * largest_p), loose, r)
      }
      if (value[1, r, "branch"] == "OPEN") opened[k] = 1
      if (a11 > 0 && value[1, r, "branch"] != "OPEN" && (method != "STEP" || !on["gap"] && !opened[k]))
         measure("tau = a11 delta", abs(value[1, r, "tau_x"] - a11 * value[1, r, "delta_x"]) / (largest_p + a11 * abs(value[1, r, "delta_x"])), 1e-9, r)
      if (path_dependent) continue
      if (value[1, r, "branch"] == "LOAD") {
         exact = lambda > 0 ? (lambda / c) ^ (1 / m) : 0
         measure("LOAD", abs(p - exact) / largest_p, loose, r)
         if (lambda > top[k]) top[k] = lambda
         last[k] = ""
      } else if (value[1, r, "branch"] != "OPEN" && method == "NEWTON") {
         a = point_a(p, lambda)
         measure("point A falls", (top[k] - a) / largest_lambda, 1e-6, r)
         if (last[k] != "") measure("the line through A", abs(a - last[k]) / largest_lambda, 1e-6, r)
         if (a > top[k]) top[k] = a
         last[k] = a
      } else last[k] = ""
   }
   for (j = 1; j <= n_joints; j++) measure("area of joint " j, abs(sum[j] / joint_area[j] - 1), 1e-9, 1)
}

# Whether an element has opened that was closed, in the model
function has_opened(   r, k, closed) {
   split("", closed)
   for (r = 1; r <= n_rows[1]; r++) {
      k = value[1, r, "element"]
      if (value[1, r, "branch"] != "OPEN") closed[k] = 1
      else if (k in closed) return 1
   }
   return 0
}

# Whether a joint slips at all its elements after any increment, in the model
function slips_all_over(   r, k, j, all) {
   if (mu < 0) return 0
   for (k = 0; k * per[1] < n_rows[1]; k++) {
      split("", all)
      for (r = k * per[1] + 1; r <= (k + 1) * per[1]; r++) {
         j = value[1, r, "joint"]
         if (!(j in all)) all[j] = 1
         if (value[1, r, "slip"] == 0 && value[1, r, "branch"] != "OPEN") all[j] = 0
      }
      for (j in all) if (all[j]) return 1
   }
   return 0
}

# lambda of the point A from which the line of slope e_u leads to (lambda, p)
function point_a(p, lambda,   low, high, i, a) {
   largest_lambda = largest(1, "lambda")
   low = p; high = p + 10 * largest(1, "pressure")
   if (m < 1 && (e_u * m * c) ^ (1 / (1 - m)) < high) high = (e_u * m * c) ^ (1 / (1 - m)) # where the curve is as steep as the line
   for (i = 1; i <= 80; i++) { a = (low + high) / 2; if (a - e_u * (c * a ^ m - lambda) > p) low = a; else high = a }
   return c * a ^ m
}

function largest(v, name,   r, x) {
   if (v == 1 && (number, name) in largest_of) return largest_of[number, name]
   x = 0
   for (r = 1; r <= n_rows[v]; r++) if (abs(value[v, r, name]) > x) x = abs(value[v, r, name])
   if (v == 1) largest_of[number, name] = x
   return x
}

# The largest closing of an element that is closed
function largest_closing(   r, x) {
   if (number in closing_of) return closing_of[number]
   x = 0
   for (r = 1; r <= n_rows[1]; r++) if (value[1, r, "branch"] != "OPEN" && abs(value[1, r, "lambda"]) > x) x = abs(value[1, r, "lambda"])
   return closing_of[number] = x
}

# WHAT is off by X, which must not exceed BOUND
function measure(what, x, bound, row,   where) {
   where = row ? ", row " row " (stage " value[1, row, "stage"] ", increment " value[1, row, "increment"] ", joint " value[1, row, "joint"] ", element " value[1, row, "element"] ")" : ""
   if (x > worst[what]) { worst[what] = x; worst_at[what] = number }
   if (x <= bound) return 0
   failed(sprintf("%s is off by %.3g, bound %.1g%s", what, x, bound, where))
   return 1
}

# The row of the model for each row of variant V: by joint and place
function match_rows(v,   r, b, x, y, z, d, best, s) {
   split("", used)
   size_ = 0
   for (b = 1; b <= per[1]; b++) if (abs(value[1, b, "x"] - value[1, 1, "x"]) > size_) size_ = abs(value[1, b, "x"] - value[1, 1, "x"])
   for (r = 1; r <= per[v]; r++) {
      s = length_of[v]
      x = value[v, r, "x"] / s; y = (value[v, r, "y"] - shift_of[v]) / s; z = value[v, r, "z"] / s
      mx = turn[v, 1] * x + turn[v, 4] * y + turn[v, 7] * z
      my = turn[v, 2] * x + turn[v, 5] * y + turn[v, 8] * z
      mz = turn[v, 3] * x + turn[v, 6] * y + turn[v, 9] * z
      best = 1e30
      for (b = 1; b <= per[1]; b++) if (value[1, b, "joint"] == value[v, r, "joint"] && !(b in used)) {
         d = (mx - value[1, b, "x"]) ^ 2 + (my - value[1, b, "y"]) ^ 2 + (mz - value[1, b, "z"]) ^ 2
         if (d < best) { best = d; row_of[r] = b }
      }
      used[row_of[r]] = 1
      measure("place of an element, " variant[v], sqrt(best) / (size_ + 1e-30), 1e-6, 0)
   }
}

function same_joints(v,   r, b, k, names, n, stress, s, f, spinning, q, scale) {
   if (n_rows[v] != n_rows[1] || per[v] != per[1]) { failed("variant " variant[v] " has " n_rows[v] " rows, the model " n_rows[1]); return }
   match_rows(v)
   tied = 0
   s = length_of[v]; f = force_of[v]; stress = f / s ^ 2
   spinning = variant[v] == "q" && kind == "space"
   n = split("area:" s * s " lambda:" s " pressure:" stress " force:" f " k_n:" f / s \
             (spinning ? "" : " delta_x:" s " delta_y:" s " tau_x:" stress " tau_y:" stress " k_sx:" f / s " k_sy:" f / s) \
             ((1, 1, "gap") in value ? " gap:" s : ""), names, " ")
   for (k = 1; k <= n; k++) {
      split(names[k], q, ":")
      scale = largest(1, q[1])
      if (q[1] ~ /^delta/ && scale < 1e-5 * largest_closing()) scale = 1e-5 * largest_closing() # below, a movement is rounding of the closing
      if (q[1] ~ /^tau/ && scale < 1e-8 * largest(1, "pressure")) scale = 1e-8 * largest(1, "pressure") # a rigid top that nothing pushes aside
      if (q[1] == "delta_y" && scale < largest(1, "delta_x")) scale = largest(1, "delta_x")
      if (q[1] == "tau_y" && scale < largest(1, "tau_x")) scale = largest(1, "tau_x")
      if (q[1] == "delta_x" && scale < largest(1, "delta_y")) scale = largest(1, "delta_y")
      if (q[1] == "tau_x" && scale < largest(1, "tau_y")) scale = largest(1, "tau_y")
      compare(v, q[1], q[2], scale)
   }
   if (spinning) { compare_resultant(v, "delta", s); compare_resultant(v, "tau", stress) }
   for (r = 1; r <= n_rows[v]; r++) {
      b = row_of[1 + (r - 1) % per[v]] + int((r - 1) / per[v]) * per[v]
      if (value[v, r, "branch"] != value[1, b, "branch"]) { failed(sprintf("%s: branch %s for %s, row %d", variant[v], value[v, r, "branch"], value[1, b, "branch"], b)); break }
      # BACK stops where pressures change by 1E-6: an element so near to the limit slips or not
      if (value[v, r, "slip"] != value[1, b, "slip"] && method == "BACK" && \
          abs(sqrt(value[1, b, "tau_x"] ^ 2 + value[1, b, "tau_y"] ^ 2) - mu * value[1, b, "pressure"]) < 1e-5 * mu * largest(1, "pressure")) tied = 1
      else if (value[v, r, "slip"] != value[1, b, "slip"]) { failed(sprintf("%s: slip %s for %s, row %d", variant[v], value[v, r, "slip"], value[1, b, "slip"], b)); break }
      if (!spinning && value[v, r, "branch_x"] != value[1, b, "branch_x"]) { failed(sprintf("%s: branch_x %s for %s, row %d", variant[v], value[v, r, "branch_x"], value[1, b, "branch_x"], b)); break }
   }
}

# Both are within their PATHTOL of the path of many increments, as the halves of their parts say: an estimate, twice as far in places
function finer_path(v,   at, b, k, names, r, most, x) {
   if (n_rows[v] != n_rows[1] || per[v] != per[1]) { failed("variant p has " n_rows[v] " rows, the model " n_rows[1]); return }
   match_rows(v)
   for (k = split("lambda pressure", names, " "); k; k--) {
      most = 0
      for (r = 1; r <= n_rows[v]; r++) {
         b = row_of[1 + (r - 1) % per[v]] + int((r - 1) / per[v]) * per[v]
         x = abs(value[v, r, names[k]] - value[1, b, names[k]])
         if (x > most) { most = x; at = b }
      }
      measure(names[k] " on a finer path, of PATHTOL", most / (largest(1, names[k]) * path_tol), 3, at)
   }
}

function compare(v, name, unit, scale,   r, b, x, worst_, at) {
   worst_ = 0
   if (scale == 0) scale = 1
   for (r = 1; r <= n_rows[v]; r++) {
      b = row_of[1 + (r - 1) % per[v]] + int((r - 1) / per[v]) * per[v]
      # along x and y of the joint the sense may be the other one
      x = name ~ /^(delta|tau)/ ? abs(abs(value[v, r, name] / unit) - abs(value[1, b, name])) : abs(value[v, r, name] / unit - value[1, b, name])
      if (x > worst_) { worst_ = x; at = b }
   }
   measure(name ", " variant[v], worst_ / scale, tolerance, at)
}

function compare_resultant(v, name, unit,   r, b, x, y, scale, worst_, at) {
   worst_ = 0
   scale = largest(1, name "_x") + largest(1, name "_y")
   if (name == "delta" && scale < 1e-5 * largest_closing()) scale = 1e-5 * largest_closing()
   if (name == "tau" && scale < 1e-8 * largest(1, "pressure")) scale = 1e-8 * largest(1, "pressure")
   if (scale == 0) return
   for (r = 1; r <= n_rows[v]; r++) {
      b = row_of[1 + (r - 1) % per[v]] + int((r - 1) / per[v]) * per[v]
      x = sqrt(value[v, r, name "_x"] ^ 2 + value[v, r, name "_y"] ^ 2) / unit
      y = sqrt(value[1, b, name "_x"] ^ 2 + value[1, b, name "_y"] ^ 2)
      if (abs(x - y) > worst_) { worst_ = abs(x - y); at = b }
   }
   measure(name ", " variant[v], worst_ / scale, tolerance, at)
}

# NAME.stage.csv: what the joint carries, against statics (of the model) or against the model (of a variant)
function answers(v,   r, n, j, s, k, names, q, unit, x, y, scale, of, f, stress) {
   n = read_table(v, "stage", 100 + v)
   for (r = 1; r <= n; r++) {
      # joints stand in the order of their cards
      of = (value[100 + v, r, "stage"] - 1) * n_joints + value[100 + v, r, "joint"]
      for (k = split("stage joint u_max mises_centre mises_max contact p_max gap_max slipping n t m force_n move_n tangent_n moment_n tangent_twist", names, " "); k; k--)
         answer[v, of, names[k]] = value[100 + v, r, names[k]]
   }
   if (n != n_stages * n_joints) { failed("variant " variant[v] " has " n " rows of answers for " n_stages " stages and " n_joints " joints"); return }
   if (v == 1) {
      n_answers = n
      for (r = 1; r <= n; r++) {
         s = answer[1, r, "stage"]; j = answer[1, r, "joint"]
         if (!((s, j) in carries_n) || method == "STEP") continue
         measure("N of a joint by statics", abs(answer[1, r, "n"] / carries_n[s, j] - 1), method == "BACK" ? 1e-5 : 1e-8, 0)
         if (kind != "axi") measure("T of a joint by statics", abs(answer[1, r, "t"] - carries_t[s, j]) / carries_n[s, j], method == "BACK" ? 1e-5 : 1e-8, 0)
      }
      return
   }
   s = length_of[v]; f = force_of[v]; stress = f / s ^ 2
   for (k = split("u_max:" s " mises_centre:" stress " mises_max:" stress " contact:1 p_max:" stress " gap_max:" s " slipping:1 n:" f " t:" f " m:" f * s " force_n:" f \
                  " move_n:" s " tangent_n:" f / s " moment_n:" f * s " tangent_twist:" f * s, names, " "); k; k--) {
      split(names[k], q, ":")
      if (tied && q[1] ~ /^slipping|^tangent/) continue
      scale = 0
      for (r = 1; r <= n; r++) {
         x = abs(answer[1, r, q[1]])
         if (q[1] == "t") x = answer[1, r, "n"]
         if ((q[1] == "moment_n" || q[1] == "m") && answer[1, r, "n"] * size_ > x) x = answer[1, r, "n"] * size_
         if (q[1] == "tangent_twist" && answer[1, r, "tangent_n"] * size_ ^ 2 > x) x = answer[1, r, "tangent_n"] * size_ ^ 2
         if (q[1] == "gap_max" || q[1] == "move_n") x = answer[1, r, "u_max"]
         if (x > scale) scale = x
      }
      # a body that moves as a rigid one has stresses of rounding; Eq. (1) says what its movement is worth
      if (q[1] ~ /^mises/ && scale < (x = 1e-5 * (largest_closing() / c) ^ (1 / m))) scale = x
      if (scale == 0) scale = 1
      for (r = 1; r <= n; r++) {
         x = answer[v, r, q[1]]; y = answer[1, r, q[1]]
         if ((x == "") != (y == "")) { failed(variant[v] ": " q[1] " of the answer is '" x "' for '" y "'"); break }
         if (q[1] == "moment_n") { x = abs(x); y = abs(y) }
         if (measure(q[1] " of the answer, " variant[v], abs(x / q[2] - y) / scale, tolerance, 0)) break
      }
   }
}

# Another table: column NAME in UNIT, of the largest in it
function same_table(v, ending, name, unit,   n, r, x, y, scale) {
   n = read_table(1, ending, 1000)
   if (read_table(v, ending, 1000 + v) != n) { failed(variant[v] " has another number of rows in ." ending ".csv"); return }
   scale = 0
   for (r = 1; r <= n; r++) if (abs(value[1000, r, name]) > scale) scale = abs(value[1000, r, name])
   if (scale == 0) scale = 1
   for (r = 1; r <= n; r++) {
      x = value[1000 + v, r, name]; y = value[1000, r, name]
      if ((x == "") != (y == "")) { failed(variant[v] ": " name " is '" x "' for '" y "'"); return }
      if (measure(name ", " variant[v], abs(x / unit - y) / scale, tolerance, 0)) return
   }
}

# BALANCE OF FORCES in the listing of the model: loads as given, sum zero
function balance(   path, text, n, part, k, s, in_it, biggest, loads, sum, rows, other, tol) {
   path = folder "/d" number variant[1] ".out"
   s = 0
   while ((getline text < path) > 0) {
      if (text ~ /^ BALANCE OF FORCES/) { in_it = 1; s++; split("", rows); biggest = 0; continue }
      if (!in_it || text !~ /^  [A-Z]/) continue
      n = split(text, part, " ")
      k = kind == "space" ? 3 : 2
      if (kind == "axi") { x_[1] = 0; x_[2] = part[n] } # along the axis alone
      else for (i = 1; i <= k; i++) x_[i] = part[n - k + i]
      if (text ~ /^  SUM/) {
         in_it = 0
         for (i = 1; i <= k; i++) if (kind != "axi" || i == 2) {
            if (method != "STEP") measure("balance of forces", abs(x_[i]) / biggest, 1e-7, 0)
            measure("sum of the balance", abs(rows[i] - x_[i]) / biggest, 2e-5, 0)
         }
         continue
      }
      if (text ~ /^  LOADS/ && !on["bolt"]) for (i = 1; i <= k; i++) if (kind != "axi" || i == 2) measure("loads of the balance", abs(x_[i] - load[s, i]) / (abs(load[s, 1]) + abs(load[s, 2]) + abs(load[s, 3]) + 1e-30), 2e-5, 0)
      for (i = 1; i <= k; i++) { rows[i] += x_[i]; if (abs(x_[i]) > biggest) biggest = abs(x_[i]) }
   }
   close(path)
   if (s != n_stages) failed("the listing has " s " balances for " n_stages " stages")
}

# ENERGY OF JOINTS in the listing of variant V. Of the model: put in = given back + kept + lost; nothing lost is negative, nor what is kept
# since rest where the laws are springs; the work is that of the forces in the history, between those at both ends of each increment.
function energies(v,   path, text, n, part, k, s, j, on_, rows, e, unit, scale, kept) {
   path = folder "/d" number variant[v] ".out"
   split("", kept)
   rows = 0
   while ((getline text < path) > 0) {
      n = split(text, part, " ")
      if (text ~ /^ ENERGY OF JOINTS, STAGE/) { on_ = 1; s = part[n]; continue }
      if (text ~ /^ [A-Z]/) on_ = 0
      if (!on_ || n < 7 || part[1] !~ /^[0-9]+$/) continue
      j = part[1]
      rows++
      for (k = 1; k <= 7; k++) energy[v, s, j, k] = part[k + 1] + 0
   }
   close(path)
   if (rows != n_stages * n_joints) { failed("variant " variant[v] " has " rows " rows of energies for " n_stages " stages and " n_joints " joints"); return }
   if (v == 1) work_of_forces()
   for (j = 1; j <= n_joints; j++) {
      scale = 0
      for (s = 1; s <= n_stages; s++) if (energy[1, s, j, 1] + energy[1, s, j, 4] > scale) scale = energy[1, s, j, 1] + energy[1, s, j, 4]
      if (scale == 0) scale = 1
      if (v > 1) {
         if (tied) continue
         unit = length_of[v] * force_of[v]
         for (s = 1; s <= n_stages; s++) for (k = 1; k <= 7; k++)
            measure("energies of joints, " variant[v], abs(energy[v, s, j, k] / unit - energy[1, s, j, k]) / scale, tolerance + 2e-5, 0)
         continue
      }
      for (s = 1; s <= n_stages; s++) {
         for (k = 1; k <= 7; k++) if (k != 3 && k != 6 && energy[1, s, j, k] < 0) failed(sprintf("stage %d, joint %d: energy %d is %s", s, j, k, energy[1, s, j, k]))
         measure("put in of normal forces", abs(energy[1, s, j, 1] - energy[1, s, j, 2] - energy[1, s, j, 3]) / scale, 2e-5, 0)
         measure("put in of shear", abs(energy[1, s, j, 4] - energy[1, s, j, 5] - energy[1, s, j, 6] - energy[1, s, j, 7]) / scale, 2e-5, 0)
         kept[j, 3] += energy[1, s, j, 3]
         kept[j, 6] += energy[1, s, j, 6]
         measure("kept of normal forces", -kept[j, 3] / scale, 2e-5, 0)
         if (stores) measure("kept of shear", -kept[j, 6] / scale, 2e-5, 0)
         if (on["gap"] && s == 1) continue # interference has done work before the first load
         measure("work of normal forces", (abs(energy[1, s, j, 1] - energy[1, s, j, 2] - work[s, j, 1]) - width[s, j, 1]) / scale, 2e-5, 0)
         if (!((s, j) in opens)) measure("work of shear", (abs(energy[1, s, j, 4] - energy[1, s, j, 5] - work[s, j, 2]) - width[s, j, 2]) / scale, 2e-5, 0)
      }
   }
}

# Work of the forces in the history of the model: by the means of each increment, and how far it may be from them
function work_of_forces(   r, k, s, j, area, now, old, d, i) {
   split("", work)
   split("", width)
   split("", opens)
   split("", old)
   for (r = 1; r <= n_rows[1]; r++) {
      s = value[1, r, "stage"]; j = value[1, r, "joint"]; k = value[1, r, "element"]; area = value[1, r, "area"]
      split("lambda pressure delta_x tau_x delta_y tau_y", now, " ")
      for (i = 1; i <= 6; i++) now[i] = ((1, r, now[i]) in value) ? value[1, r, now[i]] + 0 : 0
      work[s, j, 1] += area * (now[2] + old[k, 2]) / 2 * (now[1] - old[k, 1])
      width[s, j, 1] += area * abs((now[2] - old[k, 2]) * (now[1] - old[k, 1])) / 2
      for (i = 3; i <= 5; i += 2) {
         d = now[i] - old[k, i]
         work[s, j, 2] += area * (now[i + 1] + old[k, i + 1]) / 2 * d
         # where it slips the stress rises to the limit and follows it
         width[s, j, 2] += area * abs(d) * (abs(now[i + 1] - old[k, i + 1]) / 2 + (value[1, r, "slip"] == 1 ? mu * abs(now[2] - old[k, 2]) + rise(k, old) : 0))
      }
      if (value[1, r, "branch"] == "OPEN" || (k in old) && old[k] == "OPEN") opens[s, j] = 1
      for (i = 1; i <= 6; i++) old[k, i] = now[i]
      old[k] = value[1, r, "branch"]
   }
}

# How far the stress of element K is below its limit in OLD
function rise(k, old,   x) { x = mu * old[k, 2] - sqrt(old[k, 4] ^ 2 + old[k, 6] ^ 2); return x > 0 ? x : 0 }

# Files for ParaView: as long as they say, every body element and every interface element is there, with its own values
function paraview(   k, far, path, text, ending, n, r, first, of_element, seen, values, row, i) {
   for (k = 1; k <= n_stages; k++) {
      ending = n_stages > 1 ? "." k : ""
      if (header(folder "/d" number variant[1] ending ".vtu")) {
         if (v_cells != cells) failed("the file for ParaView has " v_cells " cells for " cells " body elements")
         n = numbers_of(folder "/d" number variant[1] ending ".vtu", "displacement", "f8", values)
         if (n != 3 * v_points) failed("the file for ParaView has " n " displacements for " v_points " points")
         far = 0
         for (i = 1; i <= n; i += 3) { r = sqrt(values[i] ^ 2 + values[i + 1] ^ 2 + values[i + 2] ^ 2); if (r > far) far = r }
         # the node that moves farthest may be off the mesh
         for (i = 1; i <= n_answers; i++) if (answer[1, i, "stage"] == k)
            if (far > answer[1, i, "u_max"] * (1 + 1e-6) || !on["rbe2"] && !on["rbe3"] && far < answer[1, i, "u_max"] * (1 - 1e-6))
               failed("the file for ParaView has displacements up to " far ", the answer " answer[1, i, "u_max"])
      }
      path = folder "/d" number variant[1] ending ".joint.vtu"
      if (!header(path)) continue
      if (kind != "space" && v_cells < 1) failed(path " has no cells")
      first = 0
      for (r = 1; r <= n_rows[1]; r++) if (value[1, r, "stage"] == k) first = r # of the last increment: the last element
      first -= per[1]
      numbers_of(path, "element", "d4", of_element)
      n = numbers_of(path, "pressure", "f8", values)
      if (n != v_points) failed(path " has " n " pressures for " v_points " points")
      split("", seen)
      for (i = 1; i <= n; i++) {
         seen[of_element[i]]++
         # corners of faces of second order have means of the elements beside them
         row = first + of_element[i]
         if (!on["order2"] && !on["part"] && row <= n_rows[1] && abs(values[i] - value[1, row, "pressure"]) > 1e-6 * largest(1, "pressure"))
            failed(path ": element " of_element[i] " has the pressure " values[i] ", in the joint history " value[1, row, "pressure"])
         if (values[i] !~ /^[-+0-9.e]+$/ || values[i] > 1.0001 * largest(1, "pressure")) failed(path ": pressure " values[i])
      }
      for (r = first + 1; r <= first + per[1]; r++) if (!(value[1, r, "element"] in seen)) { failed(path ": element " value[1, r, "element"] " is not there"); break }
      for (i in seen) if (i + 0 < 1 || i + 0 > per[1]) failed(path ": there is no element " i)
   }
}

# The head of a file for ParaView: v_points, v_cells, offsets by name; its length
function header(path,   text, part, n, size, last_, at) {
   v_points = v_cells = -1
   split("", offset)
   n = 0
   while ((getline text < path) > 0 && text !~ /<AppendedData/) {
      if (text ~ /<Piece/) { split(text, part, "\""); v_points = part[2]; v_cells = part[4] }
      if (match(text, /Name="[^"]*"/)) { at = substr(text, RSTART + 6, RLENGTH - 7); sub(/ \[.*/, "", at); match(text, /offset="[0-9]*"/); offset[at] = substr(text, RSTART + 8, RLENGTH - 9); if (offset[at] + 0 >= last_ + 0) last_ = offset[at] }
      n++
   }
   close(path)
   if (n == 0) { failed("no " path); return 0 }
   ("wc -c < " path) | getline size
   close("wc -c < " path)
   text = "od -An -v -td8 -N 8 -j " 16384 + last_ " " path " 2> /dev/null"
   text | getline n
   close(text)
   if (size < 16384 + last_ + 8 + n || size > 16384 + last_ + 8 + n + 100) failed(path " is " size " bytes long, its last array ends at " 16384 + last_ + 8 + n)
   return 1
}

# Array NAME of a file, as od prints TYPE; answers how many
function numbers_of(path, name, type, array,   command, n, text, k, part, i, count) {
   split("", array)
   command = "od -An -v -td8 -N 8 -j " 16384 + offset[name] " " path " 2> /dev/null"
   command | getline n
   close(command)
   command = "od -An -v -t" type " -N " n + 0 " -j " 16384 + offset[name] + 8 " " path " 2> /dev/null"
   count = 0
   while ((command | getline text) > 0) { k = split(text, part, " "); for (i = 1; i <= k; i++) array[++count] = part[i] }
   close(command)
   return count
}
