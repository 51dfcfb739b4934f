// A gantry: two columns bolted to the floor, a beam bolted on both.
Include "parts.geo";
columns() = {}; pads() = {};
For i In {-1:1:2}
  v = newv; Box(v) = {350*i - 55, -55, 25, 110, 110, 450};
  w = newv; Box(w) = {350*i - 100, -100, 0, 200, 200, 25}; more() = {w};
  w = newv; Box(w) = {350*i - 100, -100, 475, 200, 200, 25}; more() += w;
  For j In {-1:1:2}
    For n In {-1:1:2}
      w = newv; Box(w) = {350*i + 80*j - 12, 80*n - 12, 25, 24, 24, 5}; more() += w;
      w = newv; Box(w) = {350*i + 80*j - 12, 80*n - 12, 470, 24, 24, 5}; more() += w;
      w = newv; Box(w) = {350*i + 80*j - 12, 80*n - 12, 525, 24, 24, 5}; pads() += w;
    EndFor
  EndFor
  c() = BooleanUnion{ Volume{v}; Delete; }{ Volume{more()}; Delete; };
  columns() += c();
  w = newv; Box(w) = {350*i - 100, -100, 500, 200, 200, 25}; pads() += w;
EndFor
v = newv; Box(v) = {-450, -60, 525, 900, 120, 140};
w = newv; Box(w) = {-250, -60, 500, 500, 120, 25}; pads() += w;
w = newv; Box(w) = {-40, -100, 560, 80, 40, 80}; pads() += w;
beam() = BooleanUnion{ Volume{v}; Delete; }{ Volume{pads()}; Delete; };
solids() = columns(); edge = 60; Call Size;
solids() = beam(); edge = 60; Call Size;
Physical Volume("columns", 1) = columns();
Physical Volume("beam", 2) = beam();
For i In {0:1}
  x = 700*i - 350;
  solids() = {columns(i)};
  box() = {x - 100, -100, 0, x + 100, 100, 0}; mark = 21 + i; Call Mark;
  box() = {x - 100, -100, 500, x + 100, 100, 500}; mark = 23 + i; Call Mark;
  solids() = beam();
  box() = {x - 100, -100, 500, x + 100, 100, 500}; mark = 25 + i; Call Mark;
  For j In {0:3}
    px = x + 160*(j % 2) - 80; py = (j > 1 ? 80 : -80);
    solids() = {columns(i)};
    box() = {px - 12, py - 12, 30, px + 12, py + 12, 30}; mark = 31 + 4*i + j; Call Mark;
    box() = {px - 12, py - 12, 470, px + 12, py + 12, 470}; mark = 41 + 4*i + j; Call Mark;
    solids() = beam();
    box() = {px - 12, py - 12, 530, px + 12, py + 12, 530}; mark = 51 + 4*i + j; Call Mark;
  EndFor
EndFor
box() = {-40, -100, 560, 40, -100, 640}; mark = 20; Call Mark;
