# What P threads could make of the tasks that a run on one thread has recorded (JOINTFEM_TASKS=FILE jointfem --threads 1): work, span
# and the time of a list schedule for each number of threads, a line for each phase.
#
#    awk -f schedule.awk [-v threads='1 2 4 8 16 32'] FILE
#
# A line is `seconds name keys`, in the order in which one thread ran the tasks: `<key` waits for all tasks that have completed the key
# so far; `>key` completes it alone, forgetting those before; `+key` completes it together with others. `phase name` begins a phase,
# whose tasks wait for all tasks before it; phases of the same name are added. A free processor takes the task, among those that are
# ready, that one thread ran first. Span is the longest chain.
BEGIN { if (threads == "") threads = "1 2 4 8 16 32"; n_threads = split(threads, number, " ") }

$1 == "phase" { finish(); phase = $2; if (!(phase in tasks)) { phases[++n_phases] = phase; tasks[phase] = 0 } next }

{
   if (phase == "") { phase = "all"; phases[++n_phases] = phase }
   time[++n] = $1
   waits[n] = 0
   for (i = 3; i <= NF; i++) {
      mark = substr($i, 1, 1)
      name = substr($i, 2)
      if (mark == "<") {
         m = split(done[name], list, " ")
         for (k = 1; k <= m; k++) if (list[k] != n && !((list[k], n) in follows)) {
            follows[list[k], n] = 1
            next_of[list[k]] = next_of[list[k]] " " n
            waits[n]++
         }
      }
      if (mark == ">") done[name] = n
      if (mark == "+") done[name] = done[name] " " n
   }
}

END {
   finish()
   printf "%-12s %8s %10s %10s", "phase", "tasks", "work s", "span s"
   for (i = 1; i <= n_threads; i++) printf " %9s", "on " number[i]
   print ""
   for (p = 1; p <= n_phases; p++) {
      name = phases[p]
      printf "%-12s %8d %10.4f %10.4f", name, tasks[name], work[name], span[name]
      for (i = 1; i <= n_threads; i++) printf " %9.4f", total[name, i]
      print ""
   }
}

# The phase so far is scheduled, and forgotten.
function finish(    i, k, m, list, ready_at, longest) {
   if (n > 0) {
      tasks[phase] += n
      longest = 0
      for (i = 1; i <= n; i++) { # what a task waits for stands before it
         work[phase] += time[i]
         ready_at[i] += time[i]
         if (ready_at[i] > longest) longest = ready_at[i]
         m = split(next_of[i], list, " ")
         for (k = 1; k <= m; k++) if (ready_at[list[k]] < ready_at[i]) ready_at[list[k]] = ready_at[i]
      }
      span[phase] += longest
      for (i = 1; i <= n_threads; i++) total[phase, i] += schedule(number[i])
   }
   n = 0
   delete done; delete follows; delete next_of; delete time; delete waits
}

# The time of the last task on P processors. READY holds numbers of tasks, RUNNING the tasks by their ends: heaps, the least first.
function schedule(p,    i, k, m, list, left, now, free, t) {
   n_ready = n_running = 0
   for (i = 1; i <= n; i++) { left[i] = waits[i]; if (!left[i]) push_ready(i) }
   now = 0
   free = p
   while (n_ready || n_running) {
      while (free && n_ready) { t = pop_ready(); push_running(now + time[t], t); free-- }
      t = pop_running()
      now = end_of_popped
      free++
      m = split(next_of[t], list, " ")
      for (k = 1; k <= m; k++) if (!--left[list[k]]) push_ready(list[k])
   }
   return now
}

function push_ready(t,    i, j) {
   i = ++n_ready
   while (i > 1 && ready[j = int(i/2)] > t) { ready[i] = ready[j]; i = j }
   ready[i] = t
}

function pop_ready(    first, last, i, j) {
   first = ready[1]
   last = ready[n_ready--]
   i = 1
   while ((j = 2*i) <= n_ready) {
      if (j < n_ready && ready[j + 1] < ready[j]) j++
      if (ready[j] >= last) break
      ready[i] = ready[j]
      i = j
   }
   ready[i] = last
   return first
}

function push_running(end, t,    i, j) {
   i = ++n_running
   while (i > 1 && ends[j = int(i/2)] > end) { ends[i] = ends[j]; running[i] = running[j]; i = j }
   ends[i] = end
   running[i] = t
}

function pop_running(    first, last, end, i, j) {
   first = running[1]
   end_of_popped = ends[1]
   last = running[n_running]
   end = ends[n_running--]
   i = 1
   while ((j = 2*i) <= n_running) {
      if (j < n_running && ends[j + 1] < ends[j]) j++
      if (ends[j] >= end) break
      ends[i] = ends[j]
      running[i] = running[j]
      i = j
   }
   ends[i] = end
   running[i] = last
   return first
}
