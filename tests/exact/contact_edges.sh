# contact_edges QUERY HISTORY: the inner and the outer edge of the contact after the last increment, radii at which the closing
# deflection changes its sign, or the edges of the flanges where they touch up to there; then the number of open elements and the
# sum of the forces.
contact_edges() {
   local edge='before(x) + (x - before(x))*before(lambda)/(before(lambda) - lambda)'
   "$1" "$2" rows 'increment = max(increment)' print "max(if(lambda > 0 and before(lambda) <= 0, $edge, first(x)))" \
      print "min(if(lambda <= 0 and before(lambda) > 0, $edge, last(x)))" print 'sum(branch = "OPEN")' print 'sum(force)'
}
