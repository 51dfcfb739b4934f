// The flange of a spindle on its housing, eight screws.
Include "parts.geo";
v = newv; Box(v) = {-160, -160, -50, 320, 320, 50};
w = newv; Cylinder(w) = {0, 0, -51, 0, 0, 52, 60};
house() = BooleanDifference{ Volume{v}; Delete; }{ Volume{w}; Delete; };
v = newv; Cylinder(v) = {0, 0, 0, 0, 0, 25, 115};
w = newv; Cylinder(w) = {0, 0, 25, 0, 0, 75, 65}; more() = {w};
below() = {};
For i In {0:7}
  w = newv; Box(w) = {82, -8, 25, 16, 16, 4};
  Rotate {{0, 0, 1}, {0, 0, 0}, i*Pi/4} { Volume{w}; }
  more() += w;
  w = newv; Box(w) = {82, -8, -54, 16, 16, 4};
  Rotate {{0, 0, 1}, {0, 0, 0}, i*Pi/4} { Volume{w}; }
  below() += w;
EndFor
house() = BooleanUnion{ Volume{house()}; Delete; }{ Volume{below()}; Delete; };
flange() = BooleanUnion{ Volume{v}; Delete; }{ Volume{more()}; Delete; };
w = newv; Cylinder(w) = {0, 0, -1, 0, 0, 102, 35};
flange() = BooleanDifference{ Volume{flange()}; Delete; }{ Volume{w}; Delete; };
solids() = house(); edge = 50; Call Size;
solids() = flange(); edge = 30; Call Size;
Physical Volume("housing", 1) = house();
Physical Volume("flange", 2) = flange();
solids() = house();
box() = {-160, -160, 0, 160, 160, 0}; mark = 20; Call Mark;
box() = {-160, -160, -50, -160, 160, 0}; mark = 21; Call Mark;
box() = {160, -160, -50, 160, 160, 0}; mark = 22; Call Mark;
For i In {0:7}
  px = 90*Cos(i*Pi/4); py = 90*Sin(i*Pi/4);
  box() = {px - 12, py - 12, -54, px + 12, py + 12, -54}; mark = 41 + i; Call Mark;
EndFor
solids() = flange();
box() = {-115, -115, 0, 115, 115, 0}; mark = 23; Call Mark;
box() = {-65, -65, 100, 65, 65, 100}; mark = 24; Call Mark;
For i In {0:7}
  px = 90*Cos(i*Pi/4); py = 90*Sin(i*Pi/4);
  box() = {px - 12, py - 12, 29, px + 12, py + 12, 29}; mark = 31 + i; Call Mark;
EndFor
