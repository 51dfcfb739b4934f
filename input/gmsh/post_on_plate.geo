// A hollow post with a flange on a plate, half of it (y >= 0): the plate of wedges, drawn down from the joint in layers, the post
// of tetrahedra. They share the ring between the radii 14 and 32, which the program splits into a joint.
// gmsh -3 -format bdf -setnumber Mesh.SaveElementTagType 2 -o post_on_plate_mesh.bdf post_on_plate.geo
size = 9;
outside = 16;

// in the plane of the joint: half circles with the radii 14 (bore), 22 (post), 32 (flange), and the plate round them
Point(1) = {0, 0, 0, size};
r[] = {14, 22, 32};
For i In {0:2}
  Point(10 + i) = {r[i], 0, 0, size};
  Point(20 + i) = {0, r[i], 0, size};
  Point(30 + i) = {-r[i], 0, 0, size};
  Circle(10 + i) = {10 + i, 1, 20 + i};
  Circle(20 + i) = {20 + i, 1, 30 + i};
EndFor
Point(41) = {60, 0, 0, outside};
Point(42) = {60, 50, 0, outside};
Point(43) = {-60, 50, 0, outside};
Point(44) = {-60, 0, 0, outside};
Line(1) = {1, 10};   Line(2) = {10, 11};  Line(3) = {11, 12};  Line(4) = {12, 41};
Line(5) = {41, 42};  Line(6) = {42, 43};  Line(7) = {43, 44};  Line(8) = {44, 32};
Line(9) = {32, 31};  Line(51) = {31, 30}; Line(52) = {30, 1};
Curve Loop(1) = {1, 10, 20, 52};                         Plane Surface(1) = {1}; // under the bore
Curve Loop(2) = {2, 11, 21, 51, -20, -10};               Plane Surface(2) = {2}; // under the post
Curve Loop(3) = {3, 12, 22, 9, -21, -11};                Plane Surface(3) = {3}; // under the rest of the flange
Curve Loop(4) = {4, 5, 6, 7, 8, -22, -12};               Plane Surface(4) = {4}; // beside it

down_1[] = Extrude {0, 0, -12} { Surface{1}; Layers{2}; Recombine; };
down_2[] = Extrude {0, 0, -12} { Surface{2}; Layers{2}; Recombine; };
down_3[] = Extrude {0, 0, -12} { Surface{3}; Layers{2}; Recombine; };
down_4[] = Extrude {0, 0, -12} { Surface{4}; Layers{2}; Recombine; };
inner[] = Extrude {0, 0, 10} { Surface{2}; };
outer[] = Extrude {0, 0, 10} { Surface{3}; };
post[] = Extrude {0, 0, 25} { Surface{inner[0]}; };

Physical Volume("plate", 1) = {down_1[1], down_2[1], down_3[1], down_4[1]};
Physical Volume("post", 2) = {inner[1], outer[1], post[1]};
Physical Surface("joint", 20) = {2, 3};
Physical Surface("bottom", 21) = {down_1[0], down_2[0], down_3[0], down_4[0]};
Physical Surface("flange", 22) = {outer[0]};
Physical Surface("top", 23) = {post[0]};
Physical Surface("symmetry", 24) = Surface In BoundingBox {-61, -0.1, -13, 61, 0.1, 36};
