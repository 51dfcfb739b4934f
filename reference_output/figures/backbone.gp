deck = 'bolted_lap'
stage = '2'
length_unit = 'mm'
load includes . 'backbone.inc'
