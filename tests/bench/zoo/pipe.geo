// Two flanged pipes with raised faces, eight bolts, pressure inside; a lid closes the upper pipe.
Include "parts.geo";
low() = {}; up() = {};
For i In {-1:1:2}
  v = newv; Cylinder(v) = {0, 0, 0, 0, 0, 2*i, 75};
  w = newv; Cylinder(w) = {0, 0, 2*i, 0, 0, 20*i, 110}; more() = {w};
  w = newv; Cylinder(w) = {0, 0, 22*i, 0, 0, 78*i, 60}; more() += w;
  For j In {0:7}
    w = newv; Box(w) = {82, -8, (i > 0 ? 22 : -26), 16, 16, 4};
    Rotate {{0, 0, 1}, {0, 0, 0}, (j + 0.5)*Pi/4} { Volume{w}; }
    more() += w;
  EndFor
  c() = BooleanUnion{ Volume{v}; Delete; }{ Volume{more()}; Delete; };
  w = newv; Cylinder(w) = {0, 0, -i, 0, 0, (i > 0 ? 86 : -102), 50};
  c() = BooleanDifference{ Volume{c()}; Delete; }{ Volume{w}; Delete; };
  If (i > 0)
    up() = c();
  Else
    low() = c();
  EndIf
EndFor
Mesh.MeshSizeFromCurvature = 12;
solids() = {low(), up()}; edge = 40; Call Size;
solids() = up(); edge = 30; Call Size;
Physical Volume("lower pipe", 1) = low();
Physical Volume("upper pipe", 2) = up();
solids() = low();
box() = {-60, -60, -100, 60, 60, -100}; mark = 20; Call Mark;
box() = {-75, -75, 0, 75, 75, 0}; mark = 21; Call Mark;
box() = {-50, -50, -100, 50, 50, 0}; mark = 22; Call Mark;
solids() = up();
box() = {-75, -75, 0, 75, 75, 0}; mark = 23; Call Mark;
box() = {-50, -50, 0, 50, 50, 85}; mark = 24; Call Mark;
box() = {-60, -60, 100, 60, 60, 100}; mark = 25; Call Mark;
For j In {0:7}
  px = 90*Cos((j + 0.5)*Pi/4); py = 90*Sin((j + 0.5)*Pi/4);
  solids() = up();
  box() = {px - 12, py - 12, 26, px + 12, py + 12, 26}; mark = 31 + j; Call Mark;
  solids() = low();
  box() = {px - 12, py - 12, -26, px + 12, py + 12, -26}; mark = 41 + j; Call Mark;
EndFor
