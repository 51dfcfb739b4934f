# Random numbers that are the same with every awk, for a seed and the number of a copy: Park and Miller's generator.

# A whole number from 0 to n - 1
function random(n) {
   state = (16807 * state) % 2147483647
   return int(state / 2147483647 * n)
}

function start_random(copy,   i) {
   state = (48271 * (seed % 2147483647) + 69621 * copy + 12345) % 2147483646 + 1
   for (i = 1; i <= 5; i++) random(2)
}

# One of the words of a list
function chance(list,   words, n) {
   n = split(list, words, " ")
   return words[1 + random(n)]
}

# A long text without line ends
function long_text(part, times,   out) {
   for (out = part; length(out) < times; ) out = out out
   return out
}

# What may stand in the place of a real number: the ends of what reals can be, and texts that are none
function extreme_real() {
   return chance("0.0 -0.0 1.0 -1.0 0.5 2.0 1E308 -1E308 1.7E308 1E-308 1E-320 1E309 1E40 1E-40 1E19 -1E19 1E-19 1E155 1E-155 1E160 1E-160 " \
                 "1E100 1E-100 1E16 1E-16 1.-3 1.+3 .5 5. . - + E E5 1.0.0 1..0 1E 1E+ 1+308 1.+308 1D308 1.+999 1E99999999999 0.1E-5 1000. " \
                 "123456789012345678901234567890. .000000000000000000000000000001 NAN INF nan +inf 0X10 1,5 0.4999999 0.5000001 -0.99")
}
