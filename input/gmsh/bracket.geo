// A bracket on a bed plate, half of it (y >= 0), with two of its four bolts. Two bodies meshed apart: the bracket, and the plate with
// its bolts, whose shanks go through the holes of the bracket into the plate, one body with it. They touch on the foot of the bracket
// and under the heads, and have no point, line or face in common, for only volumes of one body are united or fragmented.
// gmsh -3 -format bdf -setnumber Mesh.SaveElementTagType 2 -setnumber Mesh.BdfFieldFormat 0 -o bracket_mesh.bdf bracket.geo
SetFactory("OpenCASCADE");

// the bracket: foot 90 x 50 x 12, wall 12 thick and 80 high, rib 8 thick (half of it here), two holes of diameter 9
Box(1) = {0, 0, 0, 90, 50, 12};
Box(2) = {0, 0, 0, 12, 50, 80};
p = newp;
Point(p) = {12, 0, 12};
Point(p + 1) = {60, 0, 12};
Point(p + 2) = {12, 0, 60};
l = newl;
Line(l) = {p, p + 1};
Line(l + 1) = {p + 1, p + 2};
Line(l + 2) = {p + 2, p};
Curve Loop(l) = {l, l + 1, l + 2};
s = news;
Plane Surface(s) = {l};
rib[] = Extrude {0, 4, 0} { Surface{s}; };
Cylinder(11) = {30, 30, -1, 0, 0, 14, 4.5};
Cylinder(12) = {72, 30, -1, 0, 0, 14, 4.5};
bracket() = BooleanUnion{ Volume{1}; Delete; }{ Volume{2, rib[1]}; Delete; };
bracket() = BooleanDifference{ Volume{bracket()}; Delete; }{ Volume{11, 12}; Delete; };

// plate 130 x 70 x 20; bolts M8: 16 deep in the plate, shank through the hole in two parts, so that there is a section to tighten,
// head of diameter 14
v = newv;
Box(v) = {-20, 0, -20, 130, 70, 20};
parts() = {};
For i In {0:1}
  x = 30 + 42*i;
  w = newv; Cylinder(w) = {x, 30, -16, 0, 0, 16, 4}; parts() += w;
  w = newv; Cylinder(w) = {x, 30, 0, 0, 0, 6, 4};    parts() += w;
  w = newv; Cylinder(w) = {x, 30, 6, 0, 0, 6, 4};    parts() += w;
  w = newv; Cylinder(w) = {x, 30, 12, 0, 0, 5, 7};   parts() += w;
EndFor
bed() = BooleanFragments{ Volume{v}; Delete; }{ Volume{parts()}; Delete; };

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
Mesh.HighOrderOptimize = 2;     // else curved sides turn some elements at the holes inside out
Mesh.MeshSizeFromCurvature = 7; // elements round a full circle
MeshSize { PointsOf{ Volume{bed()}; } } = 40;
MeshSize { PointsOf{ Volume{bracket()}; } } = 20;

// faces by the body that they belong to and by where they lie: foot and plate lie in one plane
e = 0.01;
foot() = {}; around() = {}; top() = {}; plate() = {}; heads() = {}; sections() = {}; below() = {}; symmetry() = {};
faces() = Abs(Boundary{ Volume{bracket()}; });
For k In {0:#faces()-1}
  b() = BoundingBox Surface{faces(k)};
  If (b(5) < e) foot() += faces(k); EndIf
  If (b(2) > 12 - e && b(5) < 12 + e) around() += faces(k); EndIf
  If (b(2) > 80 - e) top() += faces(k); EndIf
  If (b(4) < e) symmetry() += faces(k); EndIf
EndFor
For j In {0:#bed()-1}
  faces() = Abs(Boundary{ Volume{bed(j)}; });
  For k In {0:#faces()-1}
    b() = BoundingBox Surface{faces(k)};
    wide = b(3) - b(0);
    If (b(2) > -e && b(5) < e && wide > 100) plate() += faces(k); EndIf
    If (b(2) > 12 - e && b(5) < 12 + e && wide > 10) heads() += faces(k); EndIf
    If (b(2) > 6 - e && b(5) < 6 + e && Find(sections(), {faces(k)}) == 0) sections() += faces(k); EndIf
    If (b(5) < -20 + e) below() += faces(k); EndIf
    If (b(4) < e) symmetry() += faces(k); EndIf
  EndFor
EndFor
Physical Volume("bracket", 1) = {bracket()};
Physical Volume("plate and bolts", 2) = {bed()};
Physical Surface("foot", 20) = {foot()};
Physical Surface("plate under it", 21) = {plate()};
Physical Surface("under the heads", 22) = {heads()};
Physical Surface("foot, above", 23) = {around()};
Physical Surface("plate, below", 24) = {below()};
Physical Surface("symmetry", 25) = {symmetry()};
Physical Surface("top of the wall", 26) = {top()};
Physical Surface("section of bolt 1", 41) = {sections(0)};
Physical Surface("section of bolt 2", 42) = {sections(1)};
