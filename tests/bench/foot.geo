// The foot of a machine column, bolted through an intermediate plate to a bed. Foot: flange 240 x 170 x 25, stump 140 x 110 with walls
// of 15, ribs to the bolts; plate 260 x 190 x 30; bed 320 x 240 x 70. Four bolts M20 in holes of diameter 26. Three bodies meshed apart.
//
//    size  edge of the tetrahedra at the joints
//    around  elements round a full circle
//    bars  1: no bolts, washers on the flange and threaded holes in the bed, for spiders; 0: bolts of solids, one body with bed and
//          flange, in two parts with a section between them to tighten
SetFactory("OpenCASCADE");
DefineConstant[ size = 20, around = 6, bars = 0 ];

// foot, its lower face at z = 30: flange, stump, cavity, four ribs
Box(1) = {-120, -85, 30, 240, 170, 25};
Box(2) = {-70, -55, 55, 140, 110, 225};
Box(3) = {-55, -40, 30, 110, 80, 230};
v = newv; Box(v) = {-120, -7.5, 30, 240, 15, 100};
w = newv; Box(w) = {-7.5, -85, 30, 15, 170, 90};
foot() = BooleanUnion{ Volume{1}; Delete; }{ Volume{2, v, w}; Delete; };
foot() = BooleanDifference{ Volume{foot()}; Delete; }{ Volume{3}; Delete; };
v = newv; Box(v) = {-130, -95, 0, 260, 190, 30};
plate() = {v};
v = newv; Box(v) = {-160, -120, -70, 320, 240, 70};
bed() = {v};

// holes of foot and plate; bolts or washers and threads
holes() = {}; threads() = {}; washers() = {}; bolts() = {}; sections() = {};
For i In {-1:1:2}
  For j In {-1:1:2}
    x = 97*i; y = 60*j;
    v = newv; Cylinder(v) = {x, y, -1, 0, 0, 100, 13}; holes() += v;
    If (bars)
      v = newv; Cylinder(v) = {x, y, -25, 0, 0, 26, 10}; threads() += v;
      v = newv; Cylinder(v) = {x, y, 55, 0, 0, 5, 18}; washers() += v;
    Else
      v = newv; Cylinder(v) = {x, y, -25, 0, 0, 40, 10}; bolts() += v;
      v = newv; Cylinder(v) = {x, y, 15, 0, 0, 40, 10}; bolts() += v;
      v = newv; Cylinder(v) = {x, y, 55, 0, 0, 13, 18}; bolts() += v;
    EndIf
  EndFor
EndFor
If (bars)
  foot() = BooleanUnion{ Volume{foot()}; Delete; }{ Volume{washers()}; Delete; };
  bed() = BooleanDifference{ Volume{bed()}; Delete; }{ Volume{threads()}; Delete; };
EndIf
h() = {};
For k In {0:3}
  c() = Translate {0, 0, 0} { Duplicata { Volume{holes(k)}; } }; h() += c();
EndFor
plate() = BooleanDifference{ Volume{plate()}; Delete; }{ Volume{h()}; Delete; };
foot() = BooleanDifference{ Volume{foot()}; Delete; }{ Volume{holes()}; Delete; };
fixed() = {foot(), bed()};
If (!bars)
  fixed() = BooleanFragments{ Volume{foot(), bed()}; Delete; }{ Volume{bolts()}; Delete; };
EndIf

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
Mesh.SecondOrderLinear = 1;       // straight sides: on coarse meshes curved ones turn elements at the holes inside out
Mesh.MinimumCircleNodes = around;
Mesh.MeshSizeFromCurvature = around;
MeshSize { PointsOf{ Volume{:}; } } = size;
MeshSize { PointsOf{ Volume{plate()}; } } = 1.3*size;

// bodies by their extent, faces by the body that they belong to and by where they lie
e = 0.01;
foot() = {}; bed() = {}; bolts() = {};
For k In {0:#fixed()-1}
  b() = BoundingBox Volume{fixed(k)};
  If (b(5) > 200)
    foot() += fixed(k);
  ElseIf (b(3) - b(0) > 300)
    bed() += fixed(k);
  Else
    bolts() += fixed(k);
  EndIf
EndFor
MeshSize { PointsOf{ Volume{bed()}; } } = 1.5*size;
footFace() = {}; top() = {}; plateUp() = {}; plateDown() = {}; bedFace() = {}; below() = {};
faces() = Abs(Boundary{ Volume{foot()}; });
For k In {0:#faces()-1}
  b() = BoundingBox Surface{faces(k)};
  If (b(5) < 30 + e) footFace() += faces(k); EndIf
  If (b(2) > 280 - e) top() += faces(k); EndIf
  If (bars && b(2) > 60 - e && b(5) < 60 + e) // a washer
    Physical Surface(31 + (b(0) > 0) + 2*(b(1) > 0)) = {faces(k)};
  EndIf
EndFor
faces() = Abs(Boundary{ Volume{plate()}; });
For k In {0:#faces()-1}
  b() = BoundingBox Surface{faces(k)};
  If (b(2) > 30 - e) plateUp() += faces(k); EndIf
  If (b(5) < e) plateDown() += faces(k); EndIf
EndFor
faces() = Abs(Boundary{ Volume{bed()}; });
For k In {0:#faces()-1}
  b() = BoundingBox Surface{faces(k)};
  If (b(2) > -e && b(3) - b(0) > 100) bedFace() += faces(k); EndIf
  If (b(5) < -70 + e) below() += faces(k); EndIf
  If (bars && b(2) < -25 + e && b(2) > -70 + e && b(5) > -e) // the wall of a threaded hole
    Physical Surface(35 + (b(0) > 0) + 2*(b(1) > 0)) = {faces(k)};
  EndIf
EndFor
For k In {0:#bolts()-1}
  faces() = Abs(Boundary{ Volume{bolts(k)}; });
  For n In {0:#faces()-1}
    b() = BoundingBox Surface{faces(n)};
    If (b(2) > 15 - e && b(5) < 15 + e && Find(sections(), {faces(n)}) == 0)
      sections() += faces(n);
      Physical Surface(41 + (b(0) > 0) + 2*(b(1) > 0)) = {faces(n)};
    EndIf
  EndFor
EndFor
MeshSize { PointsOf{ Surface{top()}; } } = 2*size;
MeshSize { PointsOf{ Surface{below()}; } } = 2.5*size;
Physical Volume("foot", 1) = {foot()};
Physical Volume("plate", 2) = {plate()};
Physical Volume("bed", 3) = {bed()};
If (!bars)
  Physical Volume("bolts", 4) = {bolts()};
EndIf
Physical Surface("foot, below", 20) = {footFace()};
Physical Surface("plate, above", 21) = {plateUp()};
Physical Surface("plate, below", 22) = {plateDown()};
Physical Surface("bed, above", 23) = {bedFace()};
Physical Surface("bed, below", 24) = {below()};
Physical Surface("top", 25) = {top()};
