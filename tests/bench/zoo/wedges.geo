// A machine on three pairs of wedges on the floor: slope 1 to 50, each pair in another direction.
Include "parts.geo";
v = newv; Box(v) = {-300, -200, 60, 600, 400, 240};
w = newv; Box(w) = {-50, -40, 300, 100, 80, 40}; more() = {w};  // head, where the forces act
cx() = {-220, -220, 220}; cy() = {-140, 140, 0};
For i In {0:2}
  w = newv; Box(w) = {cx(i) - 50, cy(i) - 50, 40, 100, 100, 20}; more() += w;
EndFor
machine() = BooleanUnion{ Volume{v}; Delete; }{ Volume{more()}; Delete; };
lower() = {}; upper() = {};
For i In {0:2}
  from = cx(i) - 30; length = 60;
  ca() = {cy(i) - 40, cy(i) + 40, cy(i) + 40, cy(i) - 40}; cb() = {0, 0, 20.8, 19.2}; Call Prism;
  Rotate {{0, 0, 1}, {cx(i), cy(i), 0}, 2*i*Pi/3} { Volume{v}; } lower() += v;
  cb() = {19.2, 20.8, 40, 40}; Call Prism;
  Rotate {{0, 0, 1}, {cx(i), cy(i), 0}, 2*i*Pi/3} { Volume{v}; } upper() += v;
EndFor
solids() = machine(); edge = 100; Call Size;
solids() = {lower(), upper()}; edge = 20; Call Size;
Physical Volume("machine", 1) = machine();
Physical Volume("wedges below", 2) = lower();
Physical Volume("wedges above", 3) = upper();
solids() = machine();
box() = {-50, -40, 340, 50, 40, 340}; mark = 20; Call Mark;
For i In {0:2}
  solids() = machine();
  box() = {cx(i) - 50, cy(i) - 50, 40, cx(i) + 50, cy(i) + 50, 40}; mark = 21 + i; Call Mark;
  solids() = {upper(i)};
  box() = {cx(i) - 60, cy(i) - 60, 40, cx(i) + 60, cy(i) + 60, 40}; mark = 31 + i; Call Mark;
  box() = {cx(i) - 60, cy(i) - 60, 19, cx(i) + 60, cy(i) + 60, 21}; mark = 41 + i; Call Mark;
  solids() = {lower(i)};
  box() = {cx(i) - 60, cy(i) - 60, 19, cx(i) + 60, cy(i) + 60, 21}; mark = 51 + i; Call Mark;
  box() = {cx(i) - 60, cy(i) - 60, 0, cx(i) + 60, cy(i) + 60, 0}; mark = 61 + i; Call Mark;
EndFor
