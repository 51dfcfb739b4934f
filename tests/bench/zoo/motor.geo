// A motor on four feet, one of them 0.1 mm short, bolted to a plate. The shaft along x.
Include "parts.geo";
v = newv; Box(v) = {-225, -200, 0, 225, 200, 40};
w = newv; Box(w) = {-225, 0, 0, 225, 200, 40}; pads() = {w};
w = newv; Box(w) = {0, -200, 0, 225, 200, 40}; pads() += w;
w = newv; Box(w) = {0, 0, 0, 225, 200, 40}; pads() += w;
w = newv; Cylinder(w) = {-190, 0, 165, 380, 0, 0, 110}; u = newv; Cylinder(u) = {190, 0, 165, 60, 0, 0, 25};
more() = {u};
For i In {-1:1:2}
  For j In {-1:1:2}
    s = newv; Box(s) = {130*i - 12, 128*j - 12, -5, 24, 24, 5}; pads() += s;
    s = newv; Box(s) = {130*i - 30, 107.5*j - 37.5, 40, 60, 75, 30}; more() += s;
    s = newv; Box(s) = {130*i - 30, 85*j - 15, 70, 60, 30, 70}; more() += s;
    s = newv; Box(s) = {130*i - 12, 128*j - 12, 70, 24, 24, 5}; more() += s;
  EndFor
EndFor
plate() = BooleanUnion{ Volume{v}; Delete; }{ Volume{pads()}; Delete; };
motor() = BooleanUnion{ Volume{w}; Delete; }{ Volume{more()}; Delete; };
w = newv; Cylinder(w) = {-191, 0, 165, 360, 0, 0, 80};
motor() = BooleanDifference{ Volume{motor()}; Delete; }{ Volume{w}; Delete; };
solids() = plate(); edge = 60; Call Size;
solids() = motor(); edge = 40; Call Size;
Physical Volume("plate", 1) = plate();
Physical Volume("motor", 2) = motor();
solids() = plate();
box() = {-225, -200, 0, -225, 200, 40}; mark = 21; Call Mark;
box() = {225, -200, 0, 225, 200, 40}; mark = 22; Call Mark;
solids() = motor();
box() = {250, -30, 130, 250, 30, 200}; mark = 23; Call Mark;
n = 0;
For i In {-1:1:2}
  For j In {-1:1:2}
    solids() = motor();
    box() = {130*i - 30, 107.5*j - 37.5, 40, 130*i + 30, 107.5*j + 37.5, 40}; mark = 31 + n; Call Mark;
    box() = {130*i - 12, 128*j - 12, 75, 130*i + 12, 128*j + 12, 75}; mark = 41 + n; Call Mark;
    solids() = plate();
    box() = {112.5*(i - 1), 100*(j - 1), 40, 112.5*(i + 1), 100*(j + 1), 40}; mark = 61 + n; Call Mark;  // its quarter of the plate
    box() = {130*i - 12, 128*j - 12, -5, 130*i + 12, 128*j + 12, -5}; mark = 51 + n; Call Mark;
    n++;
  EndFor
EndFor
