# Random structures with known laws: a block, of space or a ring, on a rigid base, under three preloads and a push.
#    awk -v seed=N -v form=deck  -f random.awk -f structures.awk     the deck with ${NAME} for what is sought
#                  form=truth                                        lines NAME VALUE
#                  form=data -v modes=F -v watch=F                   the measured file: answers of jointfem at the truth, with noise of 1 %
function log_between(low, high) { return low * exp(log(high / low) * random(100001) / 100000) }
function gauss(   i, sum) { for (i = 0; i < 12; i++) sum += random(1000001) / 1000000; return sum - 6 }
function sought(name, value) { n_sought++; names[n_sought] = name; truth[name] = value; return "${" name "}" }
function either(name, value) { return index(" " list " ", " " name " ") ? sought(name, value) : value }
function unless_ring(text) { return kind == "ring" ? "" : text }

BEGIN {
   start_random(7)
   kind = chance("plane space ring")
   list = chance(kind == "ring" ? "C,M C,M,E C,E" : kind == "space" ? "C,M,K0 C,M,K0,K1 M,K0,K1,E C,K0,K1,E C,M,K0,K1,E" : \
                 "C,M C,M,K0 C,M,K0,K1 C,M,MU,KS C,M,K0,MU C,M,K0,K1,MU,KS K0,MU C,KS M,K0,K1")
   gsub(",", " ", list)
   width = 40 + random(60); height = 40 + random(100); nx = 4 + random(4); ny = 3 + random(3)
   c = sprintf("%.6f", log_between(2e-3, 1e-2)); m = sprintf("%.3f", 0.35 + random(30) / 100)
   k0 = sprintf("%.2f", log_between(30, 200)); k1 = sprintf("%.2f", log_between(30, 200)); mu = sprintf("%.3f", 0.1 + random(20) / 100)
   if (mu > 0.2 * width / height) mu = sprintf("%.3f", 0.2 * width / height) # else a push at the top tips the block over
   ks = sprintf("%.1f", log_between(5000, 50000)); e = sprintf("%.1f", log_between(7e4, 2.1e5))
   depth = 20 + random(30)
   area = kind == "ring" ? 3.14159265 * ((20 + width)^2 - 400) : width * depth
   load = 8 * area                      # the largest preload: 8 N/mm2, and a part of it
   laws = "JNORM,1," either("C", c) "," either("M", m) ",3.+4\n" \
      unless_ring("JSHEAR,1," either("K0", k0) "," either("K1", k1) "\n")
   friction = unless_ring(either("MU", mu)); spring = unless_ring(either("KS", ks)); elastic = either("E", e)
   if (form == "deck") write_deck()
   for (i = 1; i <= n_sought && form == "truth"; i++) print names[i], truth[names[i]]
   if (form == "data") write_data()
}

function write_deck() {
   print "TITLE = " kind " " seed; print "METHOD = NEWTON\nOUTPUT = NONE\nSTIFFNESS = LOAD\nINCR = 3" (kind == "plane" ? "" : "\nSPC = 1")
   print "SUBCASE 1\n  LOAD = 1\n  MODES = 4\nSUBCASE 2\n  LOAD = 2\nSUBCASE 3\n  LOAD = 3\n  MODES = 4"
   for (i = 4; i <= pushes(); i++) print "SUBCASE " i "\n  LOAD = " i
   print "BEGIN BULK"
   if (kind == "space") {
      printf "BLOCK3,1,1,%d,2,%d,0.0,0.0,0.0\n+,%.1f,%.1f,%.1f,,,,1,1\n+,,,,,21,22\n", nx, ny, width, depth, height
      print "PSOLID,1,1,,,,MODES\nPJOINT,1,1,1,1," friction ",-1"
   } else if (kind == "ring") {
      printf "BLOCK2,1,1,%d,%d,20.0,0.0\n+,%.1f,%.1f,,,,,1,1\n+,21,,22\nPAXIS,1,1\nPJOINT,1,1\n", nx, ny, 20 + width, height
   } else
      printf "BLOCK2,1,1,%d,%d,0.0,0.0\n+,%.1f,%.1f,,,,,1,1\n+,21,,22\nPSHELL,1,1,%.1f\n+,YES\nPJOINT,1,1,1,,%s,-1\n", nx, ny, width, height, depth, friction
   printf "MAT1,1,%s,,0.3,7.8-9\nPMARK,21\nPMARK,22\nJOINT,1,1,21\n%s", elastic, laws
   if (kind == "ring") print "SPC1,1,1,1"   # has no effect on the ring
   down = kind == "space" ? "0.,0.,-1." : "0.,-1.,0."
   for (i = 1; i <= pushes(); i++) printf "FORCEM,%d,%.6f,%s,22\n", i, load / (i == 1 ? 16 : i == 2 ? 4 : 1), down
   for (i = 4; i <= pushes(); i++) printf "FORCEM,%d,%.6f,1.,0.,0.,22\n", i, (i == 4 ? 0.3 : i == 5 && kind == "space" ? 0.6 : i == 5 ? 1.2 : 1.8) * mu * load
   if (kind == "plane") print "CELAS2,901," spring ",1,1"
   if (kind == "space") print "SPCM,1,2,21"
   print "JINCR,3,3\nEIGRL,4,,,4\nENDDATA"
}

# The last stage: a push within the limit of friction, in the plane two more beyond it, which a spring bears
function pushes() { return kind == "ring" ? 3 : kind == "space" ? 5 : 6 }

function row(what, value, place,   noise) {
   if (value == 0) return
   noise = gauss()
   printf "%s,%.9g,%.9g,%s\n", what, value * (1 + 0.01 * noise), 0.01 * (value < 0 ? -value : value), place
}

function write_data(   cells, i, line, name) {
   start_random(11)
   for (i = 1; i <= n_sought; i++) {
      name = names[i]
      printf "parameter,%s,%.6g%s\n", name, truth[name] * exp(0.7 * (2 * random(1001) / 1000 - 1) * (name == "M" ? 0.3 : 1)), name == "M" ? "" : ""
   }
   while ((getline line < modes) > 0) {
      split(line, cells, ",")
      if (cells[1] + 0 > 0 && cells[2] <= 3) row("frequency", cells[3], "stage=" cells[1] ",mode=" cells[2])
   }
   getline line < watch
   for (i = split(line, cells, ","); i > 0; i--) at[cells[i]] = i
   while ((getline line < watch) > 0) {
      split(line, cells, ",")
      if (cells[at["stage"]] < 4) row("displacement", cells[at[kind == "space" ? "u_z" : "u_y"]], "stage=" cells[at["stage"]] ",node=" cells[at["node"]] ",direction=" (kind == "space" ? "z" : "y"))
      else row("displacement", cells[at["u_x"]], "stage=" cells[at["stage"]] ",node=" cells[at["node"]] ",direction=x")
   }
}
