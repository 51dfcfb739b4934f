// A rotary table on its ring, centred by a spigot with clearance, held in rotation by the worm.
Include "parts.geo";
v = newv; Cylinder(v) = {0, 0, 0, 0, 0, 60, 150};
w = newv; Cylinder(w) = {0, 0, 20, 0, 0, 41, 100};
base() = BooleanDifference{ Volume{v}; Delete; }{ Volume{w}; Delete; };
w = newv; Cylinder(w) = {0, 0, 20, 0, 0, 75, 40}; more() = {w};
w = newv; Box(w) = {140, -15, 15, 50, 30, 30}; more() += w;        // bracket of the worm
base() = BooleanUnion{ Volume{base()}; Delete; }{ Volume{more()}; Delete; };
v = newv; Cylinder(v) = {0, 0, 60, 0, 0, 40, 180};
w = newv; Cylinder(w) = {0, 0, 59, 0, 0, 42, 40};
table() = BooleanDifference{ Volume{v}; Delete; }{ Volume{w}; Delete; };
w = newv; Box(w) = {70, -30, 100, 60, 60, 50}; more() = {w};
w = newv; Box(w) = {160, -15, 70, 30, 30, 20}; more() += w;
table() = BooleanUnion{ Volume{table()}; Delete; }{ Volume{more()}; Delete; };
Mesh.MeshSizeFromCurvature = 16;
solids() = base(); edge = 45; Call Size;
solids() = table(); edge = 36; Call Size;
Physical Volume("base", 1) = base();
Physical Volume("table", 2) = table();
solids() = base();
box() = {-150, -150, 0, 150, 150, 0}; mark = 20; Call Mark;
box() = {-150, -150, 60, 150, 150, 60}; mark = 21; Call Mark;
box() = {-40, -40, 20, 40, 40, 95}; mark = 22; Call Mark;
box() = {190, -15, 15, 190, 15, 45}; mark = 23; Call Mark;
solids() = table();
box() = {-180, -180, 60, 180, 180, 60}; mark = 31; Call Mark;
box() = {-40, -40, 60, 40, 40, 100}; mark = 32; Call Mark;
box() = {70, -30, 150, 130, 30, 150}; mark = 33; Call Mark;
box() = {190, -15, 70, 190, 15, 90}; mark = 34; Call Mark;
