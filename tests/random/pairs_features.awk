# What a deck of a pair of features is made of: the pair, the other features by chance, what cannot stand together.

BEGIN {
   n_features = split("order2 fit part gap rbe2 rbe3 mpc temp cd stages carry friction restart modes vtu bolt moved two axi space newton back cubic base tri split", feature, " ")
   excludes("axi", "space rbe2 rbe3 part cubic")
   excludes("back", "stages carry newton bolt")
   excludes("carry", "newton")
   excludes("rbe2", "rbe3")
   excludes("two", "moved")
   excludes("split", "fit part")
   for (i = 1; i <= n_features; i++) for (j = 1; j < i; j++) if (!((feature[i], feature[j]) in not_with)) {
      n_pairs++
      pair_1[n_pairs] = feature[j]
      pair_2[n_pairs] = feature[i]
   }
}

function excludes(one, others,   words, n, k) {
   n = split(others, words, " ")
   for (k = 1; k <= n; k++) not_with[one, words[k]] = not_with[words[k], one] = 1
}

# FEATURE is on, unless one that is on already does not stand it
function take(name,   k) {
   for (k = 1; k <= n_features; k++) if (on[feature[k]] && (name, feature[k]) in not_with) return
   on[name] = 1
}

# The features of deck COPY: a pair by its number, others with one chance in four, NEWTON with one in two
function choose_features(copy,   k, p, first) {
   for (k = 1; k <= n_features; k++) on[feature[k]] = 0
   p = 1 + (copy - 1) % n_pairs
   on[pair_1[p]] = on[pair_2[p]] = 1
   first = random(n_features)
   if (random(2)) take("newton")
   for (k = 1; k <= n_features; k++) if (random(4) == 0) take(feature[1 + (first + k) % n_features])
   on["path"] = path != ""
   if (on["path"]) { on["newton"] = 1; on["back"] = on["carry"] = 0 }
   on["shell"] = shell != "" && copy % 2
   on["wall"] = shell != "" && !on["shell"]
   if (shell) { on["space"] = 1; on["axi"] = on["order2"] = on["split"] = on["mpc"] = 0 }
   if (on["wall"]) on["rbe2"] = 0
   features = (on["path"] ? "path " : "") (on["shell"] ? "shell" : on["wall"] ? "wall" : "")
   for (k = 1; k <= n_features; k++) if (on[feature[k]]) features = features (features == "" || features == "path " ? "" : " ") feature[k]
   return pair_1[p] "+" pair_2[p]
}
