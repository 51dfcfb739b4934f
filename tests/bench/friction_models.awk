# Models with friction, made at random, for counting iterations: friction_models.sh. The same SEED gives the same decks.
#
#    awk -v seed=1 -v from=1 -v to=200 -v folder=FOLDER -f tests/random/random.awk -f tests/bench/friction_models.awk
#
# Six kinds in turn: a block on a bed, a lap joint, a bolted flange, each in the plane (flanges also as rings) and in space. Faces match
# or not, elements are of first or second order, shear laws straight, dependent on the pressure, or cubic with unloading, MU is 0.05 to
# 0.6. The first stage presses, the next three to five push to and fro, press more and less; springs hold what slides as a whole.
# Units mm, N.

BEGIN {
   for (k = from; k <= to; k++) {
      start_random(k)
      file = sprintf("%s/f%03d.bdf", folder, k)
      bulk = ""
      laws()
      kind = k % 6
      space = kind >= 3
      order = random(4) == 0 ? 2 : 1
      if      (kind % 3 == 1) what = block()
      else if (kind % 3 == 2) what = lap()
      else                    what = flange()
      write_deck(file)
   }
}

# A random number between A and B with a step that no structure has twice
function between(a, b) { return a + (b - a)*(random(1000003) + 0.5)/1000003 }

function card(text) { bulk = bulk text "\n" }
function real(x) { return sprintf("%.6E", x) }

# The laws of the joint: normal, of a mean pressure; shear, stiffness as a part of the normal one at this pressure
function laws(   c, m, stiff, a1, part, d, a2) {
   modulus = chance("120000. 210000. 70000.")
   pressure = between(0.5, 8)
   mu = between(0.05, 0.6)
   m = random(6) == 0 ? 1 : between(0.4, 0.7)
   c = 4.6e-5*exp(between(-0.7, 2))*(m == 1 ? 2 : 1)
   stiff = pressure^(1 - m)/(m*c)
   eu = stiff*exp(between(1.2, 4.5))                       # 3 to 90 times as steep
   shear = stiff*between(0.2, 0.6)
   part = chance("0 0.4 0.8")                     # of the shear stiffness that grows with the pressure
   law = part > 0 ? "PRESSURE" : "STRAIGHT"
   card(sprintf("JNORM,1,%s,%.4f,%s", real(c), m, real(eu)))
   if (random(3) == 0) {
      law = law ", CUBIC"
      d = mu*pressure/shear
      a2 = -between(0.1, 0.4)/d                   # a2/a1; the slope stays positive
      card(sprintf("JSHEAR,1,%s,%s,%s,%s,%s,%s", real(shear*(1 - part)), real(shear*part/pressure), real(shear*(1 - part)*a2), \
           real(shear*part/pressure*a2), real(shear*(1 - part)*0.45*a2^2), real(shear*part/pressure*0.45*a2^2)))
      card(sprintf("+,%s,%s,0.0,0.0,0.0,0.0", real(shear*(1 - part)), real(shear*part/pressure)))
      card(sprintf("+,%s,%s,0.0,0.0,0.0,0.0", real(shear*(1 - part)), real(shear*part/pressure)))
   } else
      card(sprintf("JSHEAR,1,%s,%s", real(shear*(1 - part)), real(shear*part/pressure)))
   card(sprintf("PJOINT,1,1,1,%s,%.4f,,%s", kind_in_space(), mu, real(pressure/10)))
   card("MAT1,1," modulus ",,0.3")
}
function kind_in_space() { return k % 6 >= 3 ? "1" : "" }

# A block of elements between two corners; MARKS in the order of the card's fields S1, S2, ...
function box(id, nx, ny, nz, x0, y0, z0, x1, y1, z1, marks, weld,   s) {
   first[id] = 100000*id
   across[id] = space ? nz + 1 : ny + 1
   deep[id] = ny + 1
   columns[id] = nx
   layers[id] = space ? nz : ny
   rows[id] = ny
   split(marks, s, ",")
   if (space) {
      card(sprintf("BLOCK3,%d,1,%d,%d,%d,%.4f,%.4f,%.4f", id, nx, ny, nz, x0, y0, z0))
      card(sprintf("+,%.4f,%.4f,%.4f,,,,%d,%d", x1, y1, z1, first[id], first[id]))
      card(sprintf("+,%s,%s,%s,%s,%s,%s,%s,%d", s[1], s[2], s[3], s[4], s[5], s[6], weld, order))
   } else {
      card(sprintf("BLOCK2,%d,1,%d,%d,%.4f,%.4f", id, nx, ny, x0, y0))
      card(sprintf("+,%.4f,%.4f,,,,,%d,%d", x1, y1, first[id], first[id]))
      card(sprintf("+,%s,%s,%s,%s,%s,%d", s[1], s[2], s[3], s[4], weld, order))
   }
}
# Its corner node number (I, J, L), counted from 0; in the plane (I, L)
function node(id, i, j, l) { return first[id] + (space ? (i*deep[id] + j)*across[id] + l : i*across[id] + l) }

function marks(list,   m, n, i) { n = split(list, m, " "); for (i = 1; i <= n; i++) card("PMARK," m[i]) }
# Loads: a set of its own for each part; combine() adds them for a stage.
function force(set, f, x, y, z, pid) { card(sprintf("FORCEM,%d,%s,%.5f,%.5f,%.5f,%d", set, real(f), x, y, z, pid)) }
function spring(id, n, c, stiffness) { card(sprintf("CELAS2,%d,%s,%d,%d", id, real(stiffness), n, c)) }

# A block on a rigid base or on a bed, pressed from above and pushed at its top.
function block(   l, h, w, t, n, q, on_bed, nx, ny, nz) {
   l = between(60, 150); h = l*between(0.3, 0.8); w = space ? l*between(0.5, 1) : between(10, 40)
   nx = space ? 5 + random(order == 2 ? 3 : 8) : 14 + random(order == 2 ? 20 : 60)
   ny = space ? 4 + random(order == 2 ? 1 : 4) : 4 + random(6)
   nz = 2 + random(3)
   on_bed = random(3) > 0
   if (space) box(1, nx, ny, nz, 0, 0, 0, l, w, h, ",,,,11,12")
   else       box(1, nx, ny, 0, 0, 0, 0, l, h, 0, "11,,12,")
   marks("11 12")
   if (on_bed) {
      if (random(2)) { nx += 2 + random(3); ny += 1 }           # faces that do not match
      t = between(0.05, 0.3)*l
      if (space) box(2, nx, ny, 2, -t, -t, -between(0.3, 0.6)*l, l + t, w + t, 0, ",,,,13,14")
      else       box(2, nx, ny, 0, -t, -between(0.3, 0.6)*l, 0, l + t, 0, 0, "13,,14,")
      marks("13 14")
      card("SPCM,1," (space ? "123" : "12") ",13")
   }
   if (!space) card("PSHELL,1,1," real(w)); else card("PSOLID,1,1")
   card("JOINT,1,1,11" (on_bed ? ",14" : ""))
   area = l*w
   n = pressure*area
   q = n*l/h/between(2.5, 5)                                # it may open behind, it does not tip
   slides = random(2)
   if (slides) springs(1, 1, shear*area*between(0.02, 0.2)) # it may slide as a whole
   limit = mu*n*(slides ? between(0.9, 1.5) : between(0.5, 0.85))
   if (limit > q) limit = q
   force(11, n, 0, space ? 0 : -1, space ? -1 : 0, 12)
   force(12, limit, 1, 0, 0, 12)
   if (space) force(13, limit*0.4, 0, 1, 0, 12)
   press_free = 1
   return "BLOCK" (on_bed ? " ON A BED" : "")
}

# Springs to the ground along the joint, K in all, at the nodes on top of block ID, row by row
function springs(id, number, k0,   i, j, n, count) {
   count = space ? (columns[id] + 1)*(rows[id] + 1) : columns[id] + 1
   for (i = 0; i <= columns[id]; i++) for (j = 0; j <= (space ? rows[id] : 0); j++) {
      n = node(id, i, j, layers[id])
      spring(500000 + 2*number, n, 1, k0/count); number++
      if (space) { spring(500001 + 2*number, n, 2, k0/count); number++ }
   }
}

# Two plates that overlap, pressed together over the lap, one clamped at its end, one pulled and pushed at its end, where springs hold it.
function lap(   a, b, t, w, n, nx, ny, i, k0) {
   a = between(30, 60); b = between(40, 80); t = between(8, 20); w = space ? between(20, 50) : between(10, 40)
   nx = space ? 6 + random(order == 2 ? 3 : 8) : 14 + random(order == 2 ? 8 : 30)
   ny = space ? 3 + random(order == 2 ? 1 : 3) : 2 + random(3)
   i = random(2)*(2 + random(2))                            # faces that match, or not
   if (space) {
      box(1, 3, ny, 2, 0, 0, 0, a, w, t, "21,,,,,")
      box(2, nx, ny, 2, a, 0, 0, a + b, w, t, ",,,,22,11", 1)
      box(3, nx + i, ny + (i > 0), 2, a, 0, t, a + b, w, 2*t, ",,,,12,23")
      box(4, 3, ny + (i > 0), 2, a + b, 0, t, 2*a + b, w, 2*t, ",24,,,,", 3)
      card("PSOLID,1,1")
   } else {
      box(1, 5, ny, 0, 0, 0, 0, a, t, 0, ",,,21")
      box(2, nx, ny, 0, a, 0, 0, a + b, t, 0, "22,,11,", 1)
      box(3, nx + i, ny, 0, a, t, 0, a + b, 2*t, 0, "12,,23,")
      box(4, 5, ny, 0, a + b, t, 0, 2*a + b, 2*t, 0, ",24,,", 3)
      card("PSHELL,1,1," real(w))
   }
   marks("11 12 21 22 23 24")
   card(i > 0 ? "JOINT,1,1,12,11" : "JOINT,1,1,11,12")
   card("SPCM,1," (space ? "123" : "12") ",21")
   card("SPCM,1," (space ? "3" : "2") ",24")
   area = b*w
   n = pressure*area
   k0 = shear*area*between(0.02, 0.2)
   for (i = 0; i <= (space ? rows[4] : layers[4]); i++)
      spring(500000 + i, space ? node(4, columns[4], i, 1) : node(4, columns[4], 0, i), 1, k0/(space ? rows[4] + 1 : layers[4] + 1))
   if (space) spring(500100, node(4, columns[4], 0, 2), 2, k0)
   limit = mu*n*between(0.5, 1.5)
   force(11, n, 0, space ? 0 : -1, space ? -1 : 0, 23)
   force(11, n, 0, space ? 0 : 1, space ? 1 : 0, 22)
   force(12, limit, 1, 0, 0, 24)
   if (space) force(13, limit*0.1, 0, 1, 0, 24)
   press_free = 1
   return "LAP JOINT"
}

# Two plates tied by bolts: rings or one half of a plane clamp, pulled at the bore or the middle; in space three or four bolts, pushed aside.
function flange(   r, l, t, w, n, nx, ny, nz, i, at, preload, count, ring, bolts, u, v, d) {
   t = between(10, 25)
   bolt_id = 0
   if (!space) {
      ring = random(2)
      r = ring ? between(15, 60) : 0
      l = between(30, 60)
      w = between(15, 40)
      nx = 14 + random(order == 2 ? 10 : 40); ny = 4 + random(6)
      d = 1 + random(2)                                     # faces that match, or twice as many elements above; the bolt is upright
      box(1, nx, ny, 0, r, 0, 0, r + l, t, 0, "21,,11,")
      box(2, d*nx, ny, 0, r, t, 0, r + l, 2*t, 0, "12,,23,24")
      card(ring ? "PAXIS,1,1" : "PSHELL,1,1," real(w))
      marks("11 12 21 23 24")
      if (!ring) { card("SPC1,1,1," node(1, 0, 0, 0)); card("SPCM,1,1,24") }
      card("SPC1,1,2," node(1, 0, 0, 0))
      area = ring ? 3.14159*((r + l)^2 - r^2) : l*w
      preload = pressure*area
      at = 0.4 + 0.3*random(1000)/1000
      bolt(node(1, int(at*nx), 0, 0), node(2, d*int(at*nx), 0, layers[2]), preload)
      card("PROD,90,1," real(preload/between(300, 600)))
      force(12, preload*between(0.1, 0.4), 0, 1, 0, 24)
      force(13, preload*between(0.02, 0.1), ring ? 1 : 0, ring ? 0 : -1, 0, ring ? 24 : 23)
      press_free = 0
      card(d > 1 ? "JOINT,1,1,12,11" : "JOINT,1,1,11,12")
      return ring ? "FLANGED RINGS" : "HALF A CLAMP"
   }
   l = between(80, 160); w = l*between(0.4, 0.9)
   nx = 6 + 2*random(order == 2 ? 2 : 4); ny = 4 + 2*random(order == 2 ? 1 : 3); nz = 2 + random(order == 2 ? 1 : 2)
   d = 1 + random(2)                                        # likewise
   box(1, nx/d, ny/d, nz, 0, 0, 0, l, w, t, ",,,,21,11")
   box(2, nx, ny, nz, 0, 0, t, l, w, t + t*between(0.7, 1.3), ",,,,12,23")
   marks("11 12 21 23")
   card("PSOLID,1,1")
   card("SPCM,1,123,21")
   card(d > 1 ? "JOINT,1,1,12,11" : "JOINT,1,1,11,12")
   area = l*w
   bolts = 3 + random(2)
   preload = pressure*area/bolts
   for (i = 0; i < bolts; i++) {
      u = i % 2 ? nx/d - 1 : 1; v = i < 2 ? 1 : ny/d - 1
      bolt(node(1, u, v, 0), node(2, d*u, d*v, layers[2]), preload)
   }
   card("PROD,90,1," real(preload/between(300, 600)))
   springs(2, 1, shear*area*between(0.02, 0.2))             # it may slide as a whole: the push also pulls the bolts
   limit = mu*preload*bolts*between(0.5, 1.3)
   force(12, limit, 1, between(-0.3, 0.3), between(-0.3, 0.2), 23)
   card(sprintf("FORCE,13,%d,,%s,0.3,1.0,-0.3", node(2, columns[2], 0, layers[2]), real(limit*between(0.1, 0.4))))
   press_free = 0
   return "FLANGE, " bolts " BOLTS"
}

function bolt(low, high, preload) {
   bolt_id++
   card(sprintf("CROD,%d,90,%d,%d", 600000 + bolt_id, low, high))
   card(sprintf("BOLT,%d,%d,%s,1", bolt_id, 600000 + bolt_id, real(preload)))
}

# The stages: press, then push to and fro with changing pressure; LOAD cards combine the sets 11 (press), 12 and 13 (push).
function write_deck(file,   stage, stages, side, share, pressed, other) {
   stages = 4 + random(3)
   printf "TITLE = FRICTION MODEL %d OF SEED %d: %s%s, LAW %s, ORDER %d\nUNITS = MM, N\nMETHOD = NEWTON\nSOLVER = TREE\n%sOUTPUT = NONE\n", \
      k, seed, what, space ? " IN SPACE" : "", law, order, bulk ~ /SPC/ ? "SPC = 1\n" : "" > file
   side = 1
   for (stage = 1; stage <= stages; stage++) {
      printf "SUBCASE %d\n  INCR = %d\n", stage, stage > file
      card(sprintf("JINCR,%d,%d,ARITH,%.6f", stage, share = 1 + random(stage == 1 ? 3 : 6), 1/share))
      if (stage == 1 && !press_free) continue
      printf "  LOAD = %d\n", 100 + stage > file
      pressed = stage == 1 ? 1 : between(0.85, 1.3)
      share = stage == 1 ? 0 : side*between(stage == 2 ? 0.7 : 0.3, 1)*(pressed < 1 ? pressed : 1)
      other = stage == 1 ? 0 : between(-1, 1)*(pressed < 1 ? pressed : 1)
      if (stage > 1 && random(4) > 0) side = -side         # back, or on in the same sense
      card(sprintf("LOAD,%d,1.0%s%s%s", 100 + stage, press_free ? sprintf(",%.5f,11", pressed) : "", \
           share != 0 ? sprintf(",%.5f,12", share) : "", (space || !press_free) && other != 0 ? sprintf(",%.5f,13", other) : ""))
   }
   printf "BEGIN BULK\n%sENDDATA\n", bulk > file
   close(file)
}
