deck = 'bolted_loops'
stage = '2'
length_unit = 'mm'
load includes . 'loops.inc'
