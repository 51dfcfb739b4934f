// A flanged box column bolted to a bed, the half x >= 0: box 300 x 250 x 900 with walls and top of 20, flange 420 x 370 x 25, eight
// bolts M16 in holes of diameter 18. Two bodies meshed apart: the column, and the bed with the bolts in it.
// gmsh -3 -format bdf -setnumber Mesh.SaveElementTagType 2 -setnumber Mesh.BdfFieldFormat 0 -o flanged_column_mesh.bdf flanged_column.geo
SetFactory("OpenCASCADE");

// the column
Box(1) = {0, -125, 0, 150, 250, 900};
Box(2) = {0, -185, 0, 210, 370, 25};
Box(3) = {-1, -105, -1, 131, 210, 881};
holes() = {};
For i In {0:1}
  For j In {-1:1}
    If (i != 0 || j != 0)
      v = newv; Cylinder(v) = {185*i, 160*j, -1, 0, 0, 30, 9}; holes() += v;
    EndIf
  EndFor
EndFor
column() = BooleanUnion{ Volume{1}; Delete; }{ Volume{2}; Delete; };
column() = BooleanDifference{ Volume{column()}; Delete; }{ Volume{3, holes()}; Delete; };

// the bed 270 x 500 x 60 and the bolts: from its surface up, shanks in two parts with a section between them to tighten, heads 27 wide
v = newv; Box(v) = {0, -250, -60, 270, 500, 60};
w = newv; Box(w) = {0, -300, -100, 300, 600, 200};
parts() = {};
For i In {0:1}
  For j In {-1:1}
    If (i != 0 || j != 0)
      c = newv; Cylinder(c) = {185*i, 160*j, 0, 0, 0, 12.5, 8};    parts() += c;
      c = newv; Cylinder(c) = {185*i, 160*j, 12.5, 0, 0, 12.5, 8}; parts() += c;
      c = newv; Cylinder(c) = {185*i, 160*j, 25, 0, 0, 10, 13.5};  parts() += c;
    EndIf
  EndFor
EndFor
parts() = BooleanIntersection{ Volume{parts()}; Delete; }{ Volume{w}; Delete; };
bed() = BooleanFragments{ Volume{v}; Delete; }{ Volume{parts()}; Delete; };

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
Mesh.SecondOrderLinear = 1;       // straight sides: on a mesh as coarse as this, curved ones turn elements at the holes inside out
Mesh.MeshSizeFromCurvature = 6; // elements round a full circle
MeshSize { PointsOf{ Volume{column()}; } } = 120;
MeshSize { PointsOf{ Volume{bed()}; } } = 200;

// faces by the body that they belong to and by where they lie: flange and bed lie in one plane
e = 0.01;
flange() = {}; above() = {}; top() = {}; plate() = {}; heads() = {}; sections() = {}; below() = {}; symmetry() = {};
faces() = Abs(Boundary{ Volume{column()}; });
For k In {0:#faces()-1}
  b() = BoundingBox Surface{faces(k)};
  If (b(5) < e) flange() += faces(k); EndIf
  If (b(2) > 25 - e && b(5) < 25 + e) above() += faces(k); EndIf
  If (b(2) > 900 - e) top() += faces(k); EndIf
  If (b(3) < e) symmetry() += faces(k); EndIf
EndFor
For j In {0:#bed()-1}
  faces() = Abs(Boundary{ Volume{bed(j)}; });
  For k In {0:#faces()-1}
    b() = BoundingBox Surface{faces(k)};
    wide = b(4) - b(1);
    If (b(2) > -e && b(5) < e && wide > 100) plate() += faces(k); EndIf
    If (b(2) > 25 - e && b(5) < 25 + e && wide > 20) heads() += faces(k); EndIf
    If (b(2) > 12.5 - e && b(5) < 12.5 + e && Find(sections(), {faces(k)}) == 0) sections() += faces(k); EndIf
    If (b(5) < -60 + e) below() += faces(k); EndIf
    If (b(3) < e) symmetry() += faces(k); EndIf
  EndFor
EndFor
Physical Volume("column", 1) = {column()};
Physical Volume("bed and bolts", 2) = {bed()};
Physical Surface("flange", 20) = {flange()};
Physical Surface("bed under it", 21) = {plate()};
Physical Surface("under the heads", 22) = {heads()};
Physical Surface("flange, above", 23) = {above()};
Physical Surface("bed, below", 24) = {below()};
Physical Surface("symmetry", 25) = {symmetry()};
Physical Surface("top", 26) = {top()};
For k In {0:#sections()-1}
  b() = BoundingBox Surface{sections(k)};
  Physical Surface(41 + k) = {sections(k)}; // sections of the bolts
  Printf("section %g: x %g to %g, y %g to %g", 41 + k, b(0), b(3), b(1), b(4));
EndFor
