// A column 100 x 100 x 600 of tetrahedra of second order, held below, loaded above.
// gmsh -3 -order 2 -format bdf -setnumber Mesh.SecondOrderIncomplete 1 -setnumber Mesh.SaveElementTagType 2 -o column_mesh.bdf column.geo
size = 100;
Point(1) = {0, 0, 0, size};
Point(2) = {100, 0, 0, size};
Point(3) = {100, 100, 0, size};
Point(4) = {0, 100, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
body[] = Extrude {0, 0, 600} { Surface{1}; };
Physical Volume("column", 1) = {body[1]};
Physical Surface("bottom", 20) = {1};
Physical Surface("top", 22) = {body[0]};
