// The foot of a machine column on its bed: box 140 x 120 with walls of 20, 400 high, open above; foot plate 220 x 200 x 30; four bolts
// M16 at 85 and 75 from the middle, holes of diameter 18, washers of diameter 34; tapped holes in the bed, 24 deep.
// gmsh -3 -format bdf -setnumber Mesh.SaveElementTagType 2 -setnumber Mesh.BdfFieldFormat 0 -o column_foot_mesh.bdf column_foot.geo
SetFactory("OpenCASCADE");

// 1. The bodies, apart: the column with its foot, and the bed. The rings under the washers become faces of their own.
Box(1) = {-70, -60, 0, 140, 120, 400};
Box(2) = {-110, -100, 0, 220, 200, 30};
Box(3) = {-50, -40, 30, 100, 80, 400};
Box(4) = {-140, -130, -60, 280, 260, 60};
holes() = {}; threads() = {}; washers() = {};
For i In {-1:1:2}
  For j In {-1:1:2}
    v = newv; Cylinder(v) = {85*i, 75*j, -1, 0, 0, 40, 9};  holes() += v;
    v = newv; Cylinder(v) = {85*i, 75*j, -24, 0, 0, 30, 7}; threads() += v;
    s = news; Disk(s) = {85*i, 75*j, 30, 17};               washers() += s;
  EndFor
EndFor
column() = BooleanUnion{ Volume{1}; Delete; }{ Volume{2}; Delete; };
BooleanFragments{ Volume{column()}; Delete; }{ Surface{washers()}; Delete; }
column() = BooleanDifference{ Volume{column()}; Delete; }{ Volume{3, holes()}; Delete; };
bed() = BooleanDifference{ Volume{4}; Delete; }{ Volume{threads()}; Delete; };

// 2. Sizes: a body each, and six elements round a hole. Coarse, to run quickly.
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
Mesh.SecondOrderLinear = 1;     // straight sides: curved ones turn elements as coarse as these inside out
Mesh.MeshSizeFromCurvature = 6;
Mesh.MeshSizeExtendFromBoundary = 0; // small elements stay at the holes
MeshSize { PointsOf{ Volume{column()}; } } = 100;
MeshSize { PointsOf{ Volume{bed()}; } } = 140;

// 3. Groups: faces by their body and their place.
e = 0.01;
foot() = {}; above() = {}; heads() = {}; top() = {}; tops() = {}; below() = {}; tapped() = {};
faces() = Abs(Boundary{ Volume{column()}; });
For k In {0:#faces()-1}
  b() = BoundingBox Surface{faces(k)};
  If (b(5) < e) foot() += faces(k); EndIf
  If (b(2) > 400 - e) top() += faces(k); EndIf
  If (b(2) > 30 - e && b(5) < 30 + e && b(3) - b(0) < 40) heads() += faces(k); EndIf
EndFor
faces() = Abs(Boundary{ Volume{bed()}; });
For k In {0:#faces()-1}
  b() = BoundingBox Surface{faces(k)};
  If (b(2) > -e) tops() += faces(k); EndIf
  If (b(5) < -60 + e) below() += faces(k); EndIf
  If (b(2) < -24 + e && b(2) > -25 && b(5) > -e) tapped() += faces(k); EndIf
EndFor
Physical Volume("column", 1) = {column()};
Physical Volume("bed", 2) = {bed()};
Physical Surface("foot", 20) = {foot()};
Physical Surface("bed under the foot", 21) = {tops()};
Physical Surface("bed, below", 22) = {below()};
Physical Surface("top", 23) = {top()};
// washers 31 to 34 and threads 41 to 44: at -x -y, x -y, -x y, x y
For k In {0:3}
  b() = BoundingBox Surface{heads(k)};
  Physical Surface(31 + (b(0) > 0) + 2*(b(1) > 0)) = {heads(k)};
  b() = BoundingBox Surface{tapped(k)};
  Physical Surface(41 + (b(0) > 0) + 2*(b(1) > 0)) = {tapped(k)};
EndFor
