// Macros of the machines: prisms, marked surfaces, sizes. Millimetres. A Call is the last word of its line.
SetFactory("OpenCASCADE");
Geometry.OCCUnionUnify = 0;      // faces of one plane stay apart: one way carries several bodies, each on a surface of its own
General.ExpertMode = 1;
Mesh.SecondOrderIncomplete = 1;
Mesh.SecondOrderLinear = 1;      // straight sides: coarse curved ones may turn elements inside out
DefineConstant[ scale = 1 ];     // of all element sizes
margin = 0.05;

// Mark: Physical Surface(mark) of all faces of solids() within the box {x0, y0, z0, x1, y1, z1}
Macro Mark
  found() = {};
  faces() = Abs(Boundary{ Volume{solids()}; });
  For k In {0:#faces()-1}
    b() = BoundingBox Surface{faces(k)};
    If (b(0) > box(0) - margin && b(1) > box(1) - margin && b(2) > box(2) - margin &&
        b(3) < box(3) + margin && b(4) < box(4) + margin && b(5) < box(5) + margin)
      found() += faces(k);
    EndIf
  EndFor
  If (#found() == 0)
    Error("no face for mark %g", mark);
  EndIf
  Physical Surface(mark) = {found()};
Return

// Prism: a polygon of corners ca(), cb(), counter-clockwise, in the plane of y and z at x = from, over a length along x: volume v
Macro Prism
  corners() = {};
  For k In {0:#ca()-1}
    q = newp; Point(q) = {from, ca(k), cb(k)}; corners() += q;
  EndFor
  sides() = {};
  For k In {0:#ca()-1}
    q = newl; Line(q) = {corners(k), corners((k + 1) % #ca())}; sides() += q;
  EndFor
  q = newll; Curve Loop(q) = {sides()};
  f = news; Plane Surface(f) = {q};
  out() = Extrude {length, 0, 0} { Surface{f}; };
  v = out(1);
Return

// Size: the edge of the elements of solids()
Macro Size
  MeshSize { PointsOf{ Volume{solids()}; } } = scale*edge;
Return

// Flanked: between the left flank y = ya - s (z - 40) (left = 1; else the right one) and the right flank y = yb + s (z - 40) plus
// t0 at x0, t1 at x1, from z = low to high: volume v, of plane faces
Macro Flanked
  e() = {};
  For k In {0:1}
    x = (k ? x1 : x0); t = (k ? t1 : t0);
    q = newp; Point(q) = {x, (left ? ya - s*(low - 40) : yb + s*(low - 40)), low}; e() += q;
    q = newp; Point(q) = {x, yb + s*(low - 40) + t, low}; e() += q;
    q = newp; Point(q) = {x, yb + s*(high - 40) + t, high}; e() += q;
    q = newp; Point(q) = {x, (left ? ya - s*(high - 40) : yb + s*(high - 40)), high}; e() += q;
  EndFor
  l = newl;
  For k In {0:3}
    Line(l + k) = {e(k), e((k + 1) % 4)};
    Line(l + 4 + k) = {e(4 + k), e(4 + (k + 1) % 4)};
    Line(l + 8 + k) = {e(k), e(4 + k)};
  EndFor
  r = newll;
  Curve Loop(r) = {l, l + 1, l + 2, l + 3};
  Curve Loop(r + 1) = {l + 4, l + 5, l + 6, l + 7};
  For k In {0:3}
    Curve Loop(r + 2 + k) = {l + k, l + 8 + (k + 1) % 4, -(l + 4 + k), -(l + 8 + k)};
  EndFor
  f = news;
  For k In {0:5}
    Plane Surface(f + k) = {r + k};
  EndFor
  q = newsl; Surface Loop(q) = {f, f + 1, f + 2, f + 3, f + 4, f + 5};
  v = newv; Volume(v) = {q};
Return
