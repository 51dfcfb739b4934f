# A problem of joints in one of many systems of units: every number of the deck times the powers of ten of its unit.
#
#     awk -v problem=block -v method=STEP -v length_power=-3 -v force_power=2 -f units_scaled.awk
#
# block: pressed, pushed until it slips and tilts, released, relieved; shear law, friction.
# beams: two bodies across a crowned gap with a little interference, bent together, pushed, relieved.
#
# The powers of force are even, so that c, whose unit has a root of the pressure, is scaled by a power of ten too.

BEGIN {
   print "METHOD = " method
   if (problem == "block") block()
   else beams()
   print "ENDDATA"
}

# VALUE [force^F length^L] as the deck in these units has it
function of(value, f, l) {
   return value == 0 ? "0.0" : with_exponent(sprintf("%.8E", value), f * force_power + l * length_power)
}

# The digits stay as they are, only the exponent changes
function with_exponent(text, power,   parts) {
   split(text, parts, "E")
   return parts[1] "E" (parts[2] + power)
}

# c [length/pressure^m]
function compliance(value, m) {
   return with_exponent(sprintf("%.8E", value), length_power - m * (force_power - 2 * length_power))
}

# BACK knows loading alone
function stages(n,   i) {
   if (method == "BACK") n = 1
   for (i = 1; i <= n; i++) print "SUBCASE " i "\n  LOAD = " i "0\n  INCR = 1\n  OUTPUT = JOINT"
}

function block() {
   stages(4)
   print "BEGIN BULK"
   print "BLOCK2,1,1,8,4,0.0,0.0\n+," of(40, 0, 1) "," of(20, 0, 1) "\n+,20,21,22,23"
   print "PMARK,20\nPMARK,21\nPMARK,22\nPMARK,23\nPSHELL,1,1," of(10, 0, 1)
   print "MAT1,1," of(21000, 1, -2) ",,0.3"
   print "JOINT,1,1,20\nPJOINT,1,1,1,,0.4,-1"
   print "JNORM,1," compliance(0.008, 0.5) ",0.5," of(9000, 1, -3)
   print "JSHEAR,1," of(40, 1, -3) "," of(200, 0, -1) "," of(-800, 1, -4) "," of(-3000, 0, -2) ",0.0,0.0"
   # a spring beside the block holds it where the joint slips
   print "CELAS2,900," of(2000, 1, -1) ",41,1"
   print "PLOADM,1," of(0.5, 1, -2) ",22\nFORCEM,2," of(150, 1, 0) ",1.0,0.0,0.0,23"
   print "LOAD,10,1.0,1.0,1\nLOAD,20,1.0,1.0,1,1.0,2\nLOAD,30,1.0,1.0,1,-0.5,2\nLOAD,40,1.0,0.3,1"
   print "JINCR,1,8"
}

function beams() {
   print "SPC = 1"
   stages(3)
   print "BEGIN BULK"
   print "BLOCK2,1,1,10,3,0.0,0.0\n+," of(100, 0, 1) "," of(12, 0, 1) "\n+,20,21,22,23"
   print "BLOCK2,2,1,10,3,0.0," of(12, 0, 1) "\n+," of(100, 0, 1) "," of(24, 0, 1) ",,,,,1001,1001\n+,30,31,32,33"
   for (i = 20; i <= 23; i++) print "PMARK," i "\nPMARK," i + 10
   print "PSHELL,1,1," of(15, 0, 1) "\nMAT1,1," of(110000, 1, -2) ",,0.25"
   print "JOINT,1,1,22,30\nPJOINT,1,1,1,,0.3,-1," of(0.2, 1, -2)
   print "JNORM,1," compliance(0.002, 0.5) ",0.5," of(60000, 1, -3)
   print "JSHEAR,1," of(300, 1, -3) "," of(900, 0, -1) ",0.0,0.0,0.0,0.0"
   print "JGAP,1,PLANE," of(-0.001, 0, 1) ",0.0,0.0," of(0.000002, 0, -1) ",0.0"
   # a soft spring holds the upper body where interference would leave it loose
   print "CELAS2,900," of(100, 1, -1) ",1004,1"
   print "FORCEM,1," of(4000, 1, 0) ",0.0,-1.0,0.0,32\nFORCEM,2," of(500, 1, 0) ",1.0,0.0,0.0,33"
   print "LOAD,10,1.0,1.0,1\nLOAD,20,1.0,1.0,1,1.0,2\nLOAD,30,1.0,0.4,1"
   print "SPCM,1,12,20"
   print "JINCR,1,6"
}
