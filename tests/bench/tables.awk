# The tables of the benchmark, aligned and in Markdown, from the figures that bench.sh has measured, `table row name value` a
# line.

{
   if (!(($1, $2) in met)) { met[$1, $2] = 1; row[$1, ++rows[$1]] = $2 }
   words = $0
   sub(/^[^ ]+ [^ ]+ [^ ]+ /, "", words)
   if (NF == 4) v[$1, $2, $3] = $4; else v[$1, $2, $3] = words # a field compares as a number, words do not
}

END {
   increments = 20
   dgemm = v["machine", "before", "rate"]
   if (v["machine", "after", "rate"] + 0 > dgemm + 0) dgemm = v["machine", "after", "rate"]
   split_factor("ours")
   split_factor("gmsh")
   machine()
   phases()
   growth()
   beside()
   kernel()
   rates()
   gmsh()
   friction()
   threads()
   crossing()
   lists()
   modes()
   identify()
   foot()
   zoo()
   mpi()
   plan()
}

# The seconds of the element matrices, which are a part of the phase factor, become a phase of their own. On one thread only:
# with more they are those of all threads together.
function split_factor(table,    i, m) {
   for (i = 1; i <= rows[table]; i++) {
      m = row[table, i]
      v[table, m, "assemble"] = v[table, m, "elements"]
      if (v[table, m, "elements"] != "") v[table, m, "factor"] -= v[table, m, "elements"]
   }
}

function machine() {
   print v["machine", "-", "processor"] ", " v["machine", "-", "cores"] " cores, " v["machine", "-", "memory"] ", " \
      v["machine", "-", "date"] "; load at the start " v["machine", "-", "load"]
   print v["machine", "before", "library"]
   printf "DGEMM, one thread, kernel %s: %.1f GFlop/s before, %.1f after; shares are of the greater\n", \
      v["machine", "before", "kernel"], v["machine", "before", "rate"], v["machine", "after", "rate"]
}

function phases(    i, m, d) {
   if (!rows["ours"]) return
   title("Seconds of the phases, " increments " increments, one thread")
   head("model;unknowns;left;read;build;order;assemble;factor;increments;recover;write;all;peak MiB")
   for (i = 1; i <= rows["ours"]; i++) {
      m = row["ours", i]
      cells(label(m) ";" of(m, "unknowns") ";" left(m) ";" seconds(of(m, "read")) ";" seconds(of(m, "build")) ";" \
         seconds(of(m, "order")) ";" seconds(of(m, "assemble")) ";" seconds(of(m, "factor")) ";" \
         seconds(of(m, "increments")) ";" seconds(of(m, "recover")) ";" seconds(of(m, "write")) ";" seconds(of(m, "all")) ";" \
         of(m, "memory"))
   }
   put()
}

# The exponent of the unknowns with which a figure grows from one model to the next of the same proportions.
function growth(    i, j, k, m, last, names, n, line, shown) {
   n = split("build order assemble factor increments recover write all memory", names, " ")
   line = "from;to"
   for (k = 1; k <= n; k++) line = line ";" names[k]
   head(line)
   for (i = 1; i <= rows["ours"]; i++) {
      m = row["ours", i]
      last = ""
      for (j = 1; j < i; j++) if (proportions(row["ours", j]) == proportions(m)) last = row["ours", j]
      if (last == "" || of(last, "unknowns") == of(m, "unknowns")) continue
      line = label(last) ";" label(m)
      for (k = 1; k <= n; k++)
         line = line ";" exponent(of(last, names[k]), of(m, names[k]), of(last, "unknowns"), of(m, "unknowns"))
      cells(line)
      shown = 1
   }
   if (!shown) return
   title("Growth: exponent in the number of unknowns")
   put()
}

function beside(    i, m) {
   if (!rows["ours"]) return
   title("The solution, beside CHOLMOD, which analyses, factorises and solves the equations of the first increment once")
   head("model;joints;order to factor s;an increment ms;run s;METIS: once s;METIS: run/once;own choice;own: once s;own: run/once")
   for (i = 1; i <= rows["ours"]; i++) {
      m = row["ours", i]
      cells(label(m) ";" ordering(m) ";" seconds(of(m, "order") + of(m, "assemble") + of(m, "factor")) ";" \
         milliseconds(of(m, "increments")/increments) ";" seconds(of(m, "solution")) ";" seconds(their(m, "solution")) ";" \
         ratio(of(m, "solution"), their(m, "solution")) ";" choice(m) ";" seconds(own(m, "solution")) ";" \
         ratio(of(m, "solution"), own(m, "solution")))
   }
   put()
}

# The share of the solution in the user or system seconds of the whole program: as in the seconds of the phases.
function of_solution(m, name) {
   return of(m, name) == "" || of(m, "all") + 0 <= 0 ? "" : of(m, name)*of(m, "solution")/of(m, "all")
}

# The kernel counts in steps of some milliseconds: short solutions have no user and system seconds.
function kernel(    i, m, short) {
   if (!rows["ours"]) return
   title("The same run and CHOLMOD with METIS: seconds of their own (user) and the kernel's (system)")
   head("model;turns;run s;of that user s;of that system s;analyse s;factorise s;solve s;once s;of that user s;" \
      "of that system s;run/once, user")
   for (i = 1; i <= rows["ours"]; i++) {
      m = row["ours", i]
      short = of(m, "solution") < 0.1
      cells(label(m) ";" either(of(m, "turns")) ";" seconds(of(m, "solution")) ";" \
         (short ? "-;-" : seconds(of_solution(m, "user")) ";" seconds(of_solution(m, "system"))) ";" \
         seconds(their(m, "analyse")) ";" seconds(their(m, "factor")) ";" seconds(their(m, "solve")) ";" \
         seconds(their(m, "solution")) ";" \
         (short ? "-;-;-" : seconds(their(m, "user")) ";" seconds(their(m, "system")) ";" \
                            ratio(of_solution(m, "user"), their(m, "user"))))
   }
   put()
}

function rates(    i, m) {
   if (!rows["ours"]) return
   title("Operations [1E9], rates as shares of DGEMM, memory [MiB], residual; CHOLMOD with METIS")
   head("model;factor;rate;an increment;rate;CHOLMOD;rate;MiB;CHOLMOD MiB;residual")
   for (i = 1; i <= rows["ours"]; i++) {
      m = row["ours", i]
      cells(label(m) ";" billions(of(m, "operations_static")) ";" share(of(m, "operations_static"), of(m, "factor")) ";" \
         billions(of(m, "operations_refactored")) ";" share(of(m, "operations_refactored")*increments, of(m, "increments")) ";" \
         billions(their(m, "operations")) ";" share(their(m, "operations"), their(m, "factor")) ";" \
         of(m, "memory") ";" either(their(m, "memory")) ";" either(their(m, "residual")))
   }
   put()
}

function gmsh(    i, k, m, n, names, line) {
   if (!rows["gmsh"]) return
   title("From Gmsh: two blocks of linear tetrahedra, 2 increments; a column of second-order ones: seconds of the phases, one thread")
   n = split("read build order assemble factor increments recover write all", names, " ")
   head("mesh;nodes;unknowns;left;joints;read;build;order;assemble;factor;increments;recover;write;all;peak MiB")
   for (i = 1; i <= rows["gmsh"]; i++) {
      m = row["gmsh", i]
      line = m ";" v["gmsh", m, "nodes"] ";" either(v["gmsh", m, "unknowns"]) ";" either(v["gmsh", m, "left"]) ";" \
         words_of(v["gmsh", m, "ordering"])
      for (k = 1; k <= n; k++) line = line ";" seconds(v["gmsh", m, names[k]])
      cells(line ";" either(v["gmsh", m, "memory"]))
   }
   put()
}

function friction(    again, i, m, one, passes) {
   if (!rows["friction_20"]) return
   title("A re-analysis after the Coulomb check")
   head("model;an increment ms;a re-analysis ms;share")
   for (i = 1; i <= rows["friction_20"]; i++) {
      m = row["friction_20", i]
      passes = v["friction_20", m, "passes"]
      one = v["friction_0", m, "increments"]/increments
      again = passes > 0 ? (v["friction_20", m, "increments"] - v["friction_0", m, "increments"])/passes : ""
      cells(label(m) ";" milliseconds(one) ";" milliseconds(again) ";" part(again, one))
   }
   put()
}

function lists(    i, m) {
   if (!rows["lists"]) return
   title("Joints on lists of nodes beside joints of pairs: blocks N x N over M x M, seconds")
   head("model;unknowns;left;build;order;an increment ms;operations of an increment 1E9")
   for (i = 1; i <= rows["lists"]; i++) {
      m = row["lists", i]
      cells(label(m) ";" v["lists", m, "unknowns"] ";" either(v["lists", m, "left"]) ";" seconds(v["lists", m, "build"]) ";" \
         seconds(v["lists", m, "order"]) ";" milliseconds(v["lists", m, "increments"]/increments) ";" \
         sprintf("%.2f", v["lists", m, "operations_refactored"]/1e9))
   }
   put()
}

function modes(    i, m, once) {
   if (!rows["modes"]) return
   title("Twenty natural modes, seconds, beside order and factorisation of the same run")
   head("model;unknowns;order;factor;increment;modes;modes/once")
   for (i = 1; i <= rows["modes"]; i++) {
      m = row["modes", i]
      once = v["modes", m, "order"] + v["modes", m, "factor"] + v["modes", m, "increments"] # fronts that move: factorised there
      cells(label(m) ";" v["modes", m, "unknowns"] ";" seconds(v["modes", m, "order"]) ";" seconds(v["modes", m, "factor"]) ";" \
         seconds(v["modes", m, "increments"]) ";" seconds(v["modes", m, "modes"]) ";" ratio(v["modes", m, "modes"], once))
   }
   put()
}

function identify(    i, m) {
   if (!rows["identify"]) return
   title("Four parameters of a joint from twelve frequencies, user seconds, beside one factorisation")
   head("model;unknowns;once;jointfit;jointfit/once;C;M;A11;A12")
   for (i = 1; i <= rows["identify"]; i++) {
      m = row["identify", i]
      cells(label(m) ";" v["identify", m, "unknowns"] ";" seconds(v["identify", m, "once"]) ";" seconds(v["identify", m, "all"]) ";" \
         ratio(v["identify", m, "all"], v["identify", m, "once"]) ";" v["identify", m, "C"] ";" v["identify", m, "M"] ";" \
         v["identify", m, "A11"] ";" v["identify", m, "A12"])
   }
   put()
}

# A model that ran to its end has yes in `ends`.
function foot(    i, m) {
   if (!rows["foot"]) return
   title("The foot of a column, threads: " v["foot", row["foot", 1], "threads"])
   head("model;nodes;unknowns;increments;iterations;most;divided;factorisations;factor;increments s;an iteration ms;all;peak MiB;to its end")
   for (i = 1; i <= rows["foot"]; i++) {
      m = row["foot", i]
      cells(words_of(m) ";" v["foot", m, "nodes"] ";" either(v["foot", m, "unknowns"]) ";" either(v["foot", m, "increments_done"]) ";" \
         either(v["foot", m, "iterations"]) ";" either(v["foot", m, "most"]) ";" either(v["foot", m, "divided"]) ";" \
         either(v["foot", m, "factorisations"]) ";" seconds(v["foot", m, "factor"]) ";" seconds(v["foot", m, "increments"]) ";" \
         (v["foot", m, "iterations"] + 0 > 0 ? milliseconds(v["foot", m, "increments"]/v["foot", m, "iterations"]) : "-") ";" \
         seconds(v["foot", m, "all"]) ";" either(v["foot", m, "memory"]) ";" v["foot", m, "ends"])
   }
   put()
   if (!rows["foot_ccx"]) return
   title("The same by CalculiX, contact surface to surface")
   head("model;increments;iterations;all;to its end;CalculiX/ours")
   for (i = 1; i <= rows["foot_ccx"]; i++) {
      m = row["foot_ccx", i]
      cells(words_of(m) ";" either(v["foot_ccx", m, "increments_done"]) ";" either(v["foot_ccx", m, "iterations"]) ";" \
         seconds(v["foot_ccx", m, "seconds"]) ";" either(v["foot_ccx", m, "ends"]) ";" ratio(v["foot_ccx", m, "seconds"], v["foot", m, "all"]))
   }
   put()
}

# Machines: iterations with those of attempts given up. A model that ran to its end has yes in `ends`.
function zoo(    i, m) {
   if (!rows["zoo"]) return
   title("A zoo of machines by NEWTON, one thread")
   head("model;nodes;increments;iterations;on average;most;stage.increment;above 25;divided;all;to its end")
   for (i = 1; i <= rows["zoo"]; i++) {
      m = row["zoo", i]
      cells(words_of(m) ";" v["zoo", m, "nodes"] ";" v["zoo", m, "increments"] ";" v["zoo", m, "iterations"] ";" v["zoo", m, "average"] ";" \
         v["zoo", m, "most"] ";" v["zoo", m, "at"] ";" v["zoo", m, "over"] ";" v["zoo", m, "divided"] ";" seconds(v["zoo", m, "all"]) ";" \
         v["zoo", m, "ends"])
   }
   put()
}

# PETSC on one process and on two, beside TREE on as many threads.
function mpi(    i, j, m, last, n, table, shown) {
   if (!rows["mpi_1"]) return
   title("By PETSC on one process and on two, " increments " increments; TREE on as many threads")
   head("model;unknowns;processes;steps, first;steps, mean;factor;increments;all;user and system;MiB, all of them;TREE: all;" \
      "TREE: user and system;TREE: MiB")
   for (i = 1; i <= rows["mpi_1"]; i++) {
      m = row["mpi_1", i]
      for (n = 1; n <= 2; n++) {
         table = "mpi_" n
         cells(label(m) ";" v[table, m, "unknowns"] ";" n ";" v[table, m, "first_steps"] ";" v[table, m, "steps"] ";" \
            seconds(v[table, m, "factor"]) ";" seconds(v[table, m, "increments"]) ";" seconds(v[table, m, "all"]) ";" \
            seconds(v[table, m, "user"] + v[table, m, "system"]) ";" v[table, m, "memory"] ";" seconds(v["tree_" n, m, "all"]) ";" \
            (("tree_" n, m, "user") in v ? seconds(v["tree_" n, m, "user"] + v["tree_" n, m, "system"]) : "") ";" \
            v["tree_" n, m, "memory"])
      }
   }
   put()
   head("from;to;processes;all;user and system;memory")
   for (i = 2; i <= rows["mpi_1"]; i++) {
      m = row["mpi_1", i]
      last = ""
      for (j = 1; j < i; j++) if (proportions(row["mpi_1", j]) == proportions(m)) last = row["mpi_1", j]
      if (last == "") continue
      for (n = 1; n <= 2; n++) {
         table = "mpi_" n
         cells(label(last) ";" label(m) ";" n ";" \
            exponent(v[table, last, "all"], v[table, m, "all"], v[table, last, "unknowns"], v[table, m, "unknowns"]) ";" \
            exponent(v[table, last, "user"] + v[table, last, "system"], v[table, m, "user"] + v[table, m, "system"], \
               v[table, last, "unknowns"], v[table, m, "unknowns"]) ";" \
            exponent(v[table, last, "memory"], v[table, m, "memory"], v[table, last, "unknowns"], v[table, m, "unknowns"]))
         shown = 1
      }
   }
   if (!shown) return
   title("Growth by PETSC: exponent in the number of unknowns")
   put()
}

# A run on many processes, counted in its partition.
function plan(    i, k, m, names, n) {
   if (!rows["plan"]) return
   n = split("nodes partners halo_nodes bytes_sent_a_product bytes_of_the_matrix bytes_of_upper_blocks bytes_of_vectors", names, " ")
   for (i = 1; i <= rows["plan"]; i++) {
      m = row["plan", i]
      title("On " v["plan", m, "processes"] " processes, " label(m) ": of a process; links between nodes cut in all: " \
         v["plan", m, "edge_cut"])
      head("quantity;least;mean;most")
      for (k = 1; k <= n; k++) {
         words = v["plan", m, names[k]]
         gsub(/ /, ";", words)
         cells(names[k] ";" words)
      }
      put()
   }
}

# A row for each number of threads; beyond the cores of the machine there are predictions only.
function threads(    i, k, m, names, n, p, line, table) {
   if (!rows["threads_1"]) return
   n = split("order factor increments", names, " ")
   for (i = 1; i <= rows["threads_1"]; i++) {
      m = row["threads_1", i]
      title("Threads, " label(m) "; results with the same digits: " v["threads_1", m, "same"])
      head("threads;order s;gain;predicted;factor s;gain;predicted;increments s;gain;predicted;recover s;all s;gain;PARDISO s;gain")
      for (p = 1; p <= 1024; p++) {
         table = "threads_" p
         if (!((table, m) in met)) continue
         line = p
         for (k = 1; k <= n; k++)
            line = line ";" seconds(v[table, m, names[k]]) ";" gain(m, table, names[k]) ";" either(rounded(v[table, m, "predicted_" names[k]]))
         cells(line ";" seconds(v[table, m, "recover"]) ";" seconds(v[table, m, "all"]) ";" gain(m, table, "all") ";" \
            seconds(v[table, m, "pardiso"]) ";" gain(m, table, "pardiso"))
      }
      put()
   }
}

function gain(m, table, name) { return v[table, m, name] == "" ? "-" : ratio(v["threads_1", m, name], v[table, m, name]) }
function rounded(x) { return x == "" ? "" : sprintf("%.2f", x) }

function crossing(    i, m, s, t) {
   if (!rows["crossing_TREE"]) return
   title("SKYLINE against TREE: order, factor and " increments " increments")
   head("model;unknowns;profile;factor of TREE;SKYLINE ms;TREE ms;SKYLINE/TREE")
   for (i = 1; i <= rows["crossing_TREE"]; i++) {
      m = row["crossing_TREE", i]
      s = v["crossing_SKYLINE", m, "solution"]
      t = v["crossing_TREE", m, "solution"]
      cells(label(m) ";" v["crossing_TREE", m, "unknowns"] ";" either(v["crossing_SKYLINE", m, "entries"]) ";" \
         either(v["crossing_TREE", m, "entries"]) ";" milliseconds(s) ";" milliseconds(t) ";" ratio(s, t))
   }
   put()
}

# ------------------------------------------------------------------ figures
function of(m, name) { return v["ours", m, name] }
function their(m, name) { return v["cholmod", m, name] }
function own(m, name) { return v["own", m, name] }
# The ordering that CHOLMOD chooses; nothing is measured under "own" where that is METIS.
function choice(m) { return own(m, "ordering") != "" ? own(m, "ordering") : their(m, "ordering") != "" ? "METIS" : "-" }
function either(x) { return x == "" ? "-" : x }
function left(m) { return either(of(m, "left")) }
function ordering(m) { return words_of(of(m, "ordering")) }
function words_of(w) { w = tolower(w); gsub(/_/, " ", w); sub(/^joints /, "", w); return either(w) }

function seconds(x) {
   if (x == "") return "-"
   return sprintf(x < 0.0995 ? "%.4f" : x < 9.95 ? "%.2f" : "%.1f", x)
}

function milliseconds(x) {
   if (x == "") return "-"
   x *= 1000
   return sprintf(x < 0.995 ? "%.3f" : x < 99.5 ? "%.1f" : "%.0f", x)
}

function billions(x) { return x + 0 <= 0 ? "-" : sprintf(1e-9*x < 9.95 ? "%.3g" : "%.0f", 1e-9*x) }
function ratio(a, b) { return a == "" || b + 0 <= 0 ? "-" : sprintf("%.2f", a/b) }
function part(a, b)  { return a == "" || b + 0 <= 0 ? "-" : sprintf("%.3f", a/b) }

# The rate of so many operations in S seconds, as a share of DGEMM.
function share(operations, s) {
   return operations + 0 <= 0 || s + 0 <= 0 || dgemm + 0 <= 0 ? "-" : sprintf("%.2f", 1e-9*operations/s/dgemm)
}

# Times below a millisecond are noise.
function exponent(a, b, n, m) {
   return a < 1e-3 || b < 1e-3 ? "-" : sprintf("%.2f", log(b/a)/log(m/n))
}

function label(m,    sizes) {
   sizes = substr(m, index(m, "_") + 1)
   gsub(/x/, " x ", sizes)
   if (m ~ /^over/) sub(/ x /, " over ", sizes)
   return (m ~ /^q4/ ? "Q4 " : m ~ /^bracket/ ? "bracket " : "hex8 ") sizes
}

function proportions(m,    d, n) {
   n = split(substr(m, index(m, "_") + 1), d, "x")
   return n " " sprintf("%.3f %.3f", d[1]/d[2], n > 2 ? d[1]/d[3] : 0)
}

# ------------------------------------------------------------------ a table: head, cells a row, put
function title(words) { print ""; print words; print "" }

function head(line) {
   table_rows = 0
   delete cell
   delete width
   columns = cells(line)
}

function cells(line,    c, n, w) {
   n = split(line, w, ";")
   table_rows++
   for (c = 1; c <= n; c++) {
      cell[table_rows, c] = w[c]
      if (length(w[c]) > width[c]) width[c] = length(w[c])
   }
   return n
}

function put(    c, dashes, i, line, rule) {
   for (i = 1; i <= table_rows; i++) {
      line = "|"
      rule = "|"
      for (c = 1; c <= columns; c++) {
         line = line sprintf(c == 1 ? " %-" width[c] "s |" : " %" width[c] "s |", cell[i, c])
         dashes = sprintf("%" (width[c] + (c == 1 ? 2 : 1)) "s", "")
         gsub(/ /, "-", dashes)
         rule = rule dashes (c == 1 ? "|" : ":|")
      }
      print line
      if (i == 1) print rule
   }
}
