// A flanged column: box 300 x 250 x 900 with walls and top of 20, flange 420 x 370 x 25 with eight holes of diameter 18. The rings
// of radius 18 about the holes on the underside are surfaces of their own, on which the column is held.
SetFactory("OpenCASCADE");
If (!Exists(size)) size = 48; EndIf
Box(1) = {-150, -125, 0, 300, 250, 900};
Box(2) = {-210, -185, 0, 420, 370, 25};
Box(3) = {-130, -105, 0, 260, 210, 880};
holes() = {};
disks() = {};
For i In {-1:1}
  For j In {-1:1}
    If (i != 0 || j != 0)
      v = newv; Cylinder(v) = {185*i, 160*j, -1, 0, 0, 30, 9}; holes() += v;
      s = news; Disk(s) = {185*i, 160*j, 0, 18}; disks() += s;
    EndIf
  EndFor
EndFor
solid() = BooleanUnion{ Volume{1}; Delete; }{ Volume{2}; Delete; };
rings() = BooleanDifference{ Surface{disks()}; Delete; }{ Volume{holes()}; };
solid() = BooleanDifference{ Volume{solid()}; Delete; }{ Volume{3, holes()}; Delete; };
all() = BooleanFragments{ Volume{solid()}; Delete; }{ Surface{rings()}; Delete; };
MeshSize {:} = size;
Mesh.MeshSizeFromCurvature = 12; // elements round a full circle
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
Mesh.HighOrderOptimize = 2; // no element turned inside out at the holes
held() = {};
For i In {-1:1}
  For j In {-1:1}
    If (i != 0 || j != 0)
      held() += Surface In BoundingBox {185*i - 19, 160*j - 19, -0.1, 185*i + 19, 160*j + 19, 0.1};
    EndIf
  EndFor
EndFor
Physical Volume("column", 1) = Volume{:};
Physical Surface("held", 21) = held();
Physical Surface("top", 22) = Surface In BoundingBox {-151, -126, 899.9, 151, 126, 900.1};
