// A knee-type milling machine: column with a T-shaped vertical way, knee on its screw with gibs and keepers, table on the knee.
// x along the table, y to the column, z up.
Include "parts.geo";
v = newv; Box(v) = {-120, 0, 0, 240, 200, 560};
w = newv; Box(w) = {-160, -300, -40, 320, 540, 40}; more() = {w};
w = newv; Box(w) = {-25, -215, 0, 50, 50, 20}; more() += w;                          // foot of the screw
w = newv; Box(w) = {-50, -20, 150, 100, 20, 400}; more() += w;
w = newv; Box(w) = {-80, -50, 150, 160, 30, 400}; more() += w;
column() = BooleanUnion{ Volume{v}; Delete; }{ Volume{more()}; Delete; };
v = newv; Box(v) = {-110, -80, 200, 220, 30, 200};
w = newv; Box(w) = {-110, -300, 260, 220, 220, 70}; more() = {w};
w = newv; Box(w) = {-110, -205, 330, 220, 20, 15}; more() += w;                    // rib that guides the table
For i In {-1:1:2}
  w = newv; Box(w) = {95*i - 15, -50, 200, 30, 46, 200}; more() += w;              // cheeks: gibs
  w = newv; Box(w) = {81*i - 29, -20, 200, 58, 16, 200}; more() += w;              // keepers
EndFor
knee() = BooleanUnion{ Volume{v}; Delete; }{ Volume{more()}; Delete; };
v = newv; Box(v) = {-300, -270, 330, 600, 150, 50};
w = newv; Box(w) = {-300, -205, 330, 600, 20, 20};
table() = BooleanDifference{ Volume{v}; Delete; }{ Volume{w}; Delete; };
w = newv; Box(w) = {-30, -225, 380, 60, 60, 30};
table() = BooleanUnion{ Volume{table()}; Delete; }{ Volume{w}; Delete; };
solids() = column(); edge = 80; Call Size;
solids() = knee(); edge = 40; Call Size;
solids() = table(); edge = 50; Call Size;
Physical Volume("column", 1) = column();
Physical Volume("knee", 2) = knee();
Physical Volume("table", 3) = table();
solids() = column();
box() = {-160, -300, -40, 160, 240, -40}; mark = 20; Call Mark;
box() = {-80, -50, 150, 80, -50, 550}; mark = 21; Call Mark;       // front of the way
box() = {-80, -20, 150, -50, -20, 550}; mark = 22; Call Mark;      // behind
box() = {50, -20, 150, 80, -20, 550}; mark = 23; Call Mark;
box() = {-80, -50, 150, -80, -20, 550}; mark = 24; Call Mark;      // beside
box() = {80, -50, 150, 80, -20, 550}; mark = 25; Call Mark;
box() = {-25, -215, 20, 25, -165, 20}; mark = 26; Call Mark;       // foot of the screw
solids() = knee();
box() = {-80, -50, 200, 80, -50, 400}; mark = 31; Call Mark;
box() = {-110, -20, 200, -52, -20, 400}; mark = 32; Call Mark;
box() = {52, -20, 200, 110, -20, 400}; mark = 33; Call Mark;
box() = {-80, -50, 200, -80, -4, 400}; mark = 34; Call Mark;
box() = {80, -50, 200, 80, -4, 400}; mark = 35; Call Mark;
box() = {-110, -300, 260, 110, -80, 260}; mark = 36; Call Mark;
box() = {-110, -300, 330, 110, -205, 330}; mark = 41; Call Mark;
box() = {-110, -185, 330, 110, -50, 330}; mark = 42; Call Mark;
box() = {-110, -205, 330, 110, -205, 345}; mark = 43; Call Mark;
box() = {-110, -185, 330, 110, -185, 345}; mark = 44; Call Mark;
box() = {-110, -300, 260, -110, -80, 330}; mark = 45; Call Mark;
solids() = table();
box() = {-300, -270, 330, 300, -205, 330}; mark = 51; Call Mark;
box() = {-300, -185, 330, 300, -120, 330}; mark = 52; Call Mark;
box() = {-300, -205, 330, 300, -205, 350}; mark = 53; Call Mark;
box() = {-300, -185, 330, 300, -185, 350}; mark = 54; Call Mark;
box() = {-300, -270, 330, -300, -120, 380}; mark = 55; Call Mark;
box() = {-30, -225, 410, 30, -165, 410}; mark = 56; Call Mark;
