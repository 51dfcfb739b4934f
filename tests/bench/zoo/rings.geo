// A shaft pressed into an inner ring, which lies in an outer ring with clearance, which lies in its housing with clearance. Axis along x.
Include "parts.geo";
v = newv; Cylinder(v) = {-70, 0, 0, 140, 0, 0, 30};
shaft() = {v};
v = newv; Cylinder(v) = {-20, 0, 0, 40, 0, 0, 42}; w = newv; Cylinder(w) = {-21, 0, 0, 42, 0, 0, 30};
inner() = BooleanDifference{ Volume{v}; Delete; }{ Volume{w}; Delete; };
v = newv; Cylinder(v) = {-20, 0, 0, 40, 0, 0, 58}; w = newv; Cylinder(w) = {-21, 0, 0, 42, 0, 0, 42};
outer() = BooleanDifference{ Volume{v}; Delete; }{ Volume{w}; Delete; };
v = newv; Box(v) = {-20, -90, -80, 40, 180, 170}; w = newv; Cylinder(w) = {-21, 0, 0, 42, 0, 0, 58};
house() = BooleanDifference{ Volume{v}; Delete; }{ Volume{w}; Delete; };
Mesh.MeshSizeFromCurvature = 16;
solids() = {shaft(), inner(), outer()}; edge = 18; Call Size;
solids() = house(); edge = 34; Call Size;
Physical Volume("housing", 1) = house();
Physical Volume("outer ring", 2) = outer();
Physical Volume("inner ring", 3) = inner();
Physical Volume("shaft", 4) = shaft();
solids() = house();
box() = {-20, -90, -80, 20, 90, -80}; mark = 20; Call Mark;
box() = {-20, -58, -58, 20, 58, 58}; mark = 21; Call Mark;
solids() = outer();
box() = {-20, -42, -42, 20, 42, 42}; mark = 32; Call Mark;
// the outer face alone: of the faces within the box the bore is taken away below
outerface() = {};
faces() = Abs(Boundary{ Volume{outer()}; });
For k In {0:#faces()-1}
  b() = BoundingBox Surface{faces(k)};
  If (b(4) > 57 && b(3) - b(0) > 30)
    outerface() += faces(k);
  EndIf
EndFor
Physical Surface(31) = outerface();
solids() = inner();
box() = {-20, -30, -30, 20, 30, 30}; mark = 42; Call Mark;
innerface() = {};
faces() = Abs(Boundary{ Volume{inner()}; });
For k In {0:#faces()-1}
  b() = BoundingBox Surface{faces(k)};
  If (b(4) > 41 && b(3) - b(0) > 30)
    innerface() += faces(k);
  EndIf
EndFor
Physical Surface(41) = innerface();
shaftface() = {};
faces() = Abs(Boundary{ Volume{shaft()}; });
For k In {0:#faces()-1}
  b() = BoundingBox Surface{faces(k)};
  If (b(3) - b(0) > 30)
    shaftface() += faces(k);
  EndIf
EndFor
Physical Surface(51) = shaftface();
solids() = shaft();
box() = {-70, -30, -30, -70, 30, 30}; mark = 52; Call Mark;
box() = {70, -30, -30, 70, 30, 30}; mark = 53; Call Mark;
