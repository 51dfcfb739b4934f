# From a joint history, into FOLDER: `joints`, a line for each with its shape (point, line, face) and the pictures that it gives;
# J.along, a block for every stage with the state at its end; J.peaks, the largest pressure that every element ever had.
BEGIN { FS = "," }
FNR == 1 {
   for (i = 1; i <= NF; i++) column[$i] = i
   next
}
{
   joint = $column["joint"]
   key = joint SUBSEP $column["element"]
   if (!(joint in size)) joints[++n_joints] = joint
   if (!(key in number)) {
      number[key] = ++size[joint]
      element[joint, size[joint]] = $column["element"]
      for (k = 1; k <= 3; k++) place[joint, size[joint], k] = $column[substr("xyz", k, 1)] + 0
   }
   i = number[key]
   stage = $column["stage"]
   if (stage > last_stage) last_stage = stage
   p = $column["pressure"] + 0
   pressure[joint, i, stage] = p
   lambda[joint, i, stage] = $column["lambda"] + 0
   if (p > peak[joint, i]) peak[joint, i] = p
   if (p > largest[joint]) largest[joint] = p
   for (k = 1; k <= 2; k++) {
      axis = substr("xy", k, 1)
      tau = $column["tau_" axis] + 0
      if (tau < 0) tau = -tau
      if ($column["branch_" axis] != "" && tau > shear[joint, k]) shear[joint, k] = tau
   }
}

function distance(j, a, b) {
   return sqrt((place[j, a, 1] - place[j, b, 1])^2 + (place[j, a, 2] - place[j, b, 2])^2 + (place[j, a, 3] - place[j, b, 3])^2)
}
function farthest(j, from,    i, best) {
   best = from
   for (i = 1; i <= size[j]; i++) if (distance(j, from, i) > distance(j, from, best)) best = i
   return best
}
# the ends of a straight row of points, the one with the lesser coordinates first; bent: it is none
function find_ends(j,    a, b, i, k) {
   a = farthest(j, 1)
   b = farthest(j, a)
   for (k = 3; k >= 1; k--) {
      if (place[j, b, k] < place[j, a, k] - 1e-6*distance(j, a, b)) { first = b; second = a }
      if (place[j, b, k] > place[j, a, k] + 1e-6*distance(j, a, b)) { first = a; second = b }
   }
   bent = 0
   for (i = 1; i <= size[j]; i++)
      if (distance(j, a, i) + distance(j, i, b) > distance(j, a, b)*(1 + 1e-5)) bent = 1
}
function by_range(j,    k, i, low, high) { # the axes of the two largest ranges: across, up
   for (k = 1; k <= 3; k++) {
      low = high = place[j, 1, k]
      for (i = 2; i <= size[j]; i++) {
         if (place[j, i, k] < low) low = place[j, i, k]
         if (place[j, i, k] > high) high = place[j, i, k]
      }
      range[k] = high - low
   }
   k = 1
   if (range[2] < range[k]) k = 2
   if (range[3] <= range[k]) k = 3
   across = k == 1 ? 2 : 1
   up = k == 3 ? 2 : 3
}
END {
   for (n = 1; n <= n_joints; n++) {
      j = joints[n]
      by_range(j)
      shape = "point"
      if (size[j] > 1) {
         find_ends(j)
         shape = bent ? "face" : "line"
      }
      along = folder "/" j ".along"
      if (shape == "line")
         label = sprintf("distance along the joint from (%g, %g, %g)", place[j, first, 1], place[j, first, 2], place[j, first, 3])
      else label = substr("xyz", across, 1)
      printf "%s\n%s\n", label, substr("xyz", up, 1) > (folder "/" j ".axes")
      for (stage = 1; stage <= last_stage; stage++) {
         if (stage > 1) print "\n" > along
         for (i = 1; i <= size[j]; i++)
            printf "%.9g,%.9g,%.9g,%.9g\n", shape == "line" ? distance(j, first, i) : place[j, i, across], \
               place[j, i, up], pressure[j, i, stage], lambda[j, i, stage] > along
      }
      printf "" > (folder "/" j ".peaks")
      for (i = 1; i <= size[j]; i++) if (peak[j, i] > 0) print peak[j, i] "," element[j, i] > (folder "/" j ".peaks")
      line = j " " shape
      if (shape != "point") line = line " pressure deflection"
      if (largest[j] > 0) {
         line = line " normal"
         for (k = 1; k <= 2; k++) if (shear[j, k] > 1e-9*largest[j]) line = line " shear_" substr("xy", k, 1)
      }
      print line > (folder "/joints")
   }
}
