// A pin of radius 9.98 at the bottom of a bore of radius 10 in a lug, the half x >= 0. Pin and lug are meshed apart, each to its
// own size: they have no point, line or node in common.
// gmsh -2 -format bdf -setnumber Mesh.SaveElementTagType 2 -setnumber Mesh.BdfFieldFormat 2 -o pin_in_bore_mesh.bdf pin_in_bore.geo
bore = 10;
pin = 9.98;
low = bore - pin; // the pin touches the bore at its bottom

// pin: quadrilaterals, its circle in 20 parts
Point(1) = {0, -low - pin, 0};
Point(2) = {pin, -low, 0};
Point(3) = {0, -low + pin, 0};
Point(4) = {0, -low, 0};
Circle(1) = {1, 4, 2};
Circle(2) = {2, 4, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1, 2} = 11;
Transfinite Curve{3, 4} = 6;
Recombine Surface{1};

// lug 40 wide, 60 high: triangles, its bore in 27 parts, finer below
Point(11) = {0, -bore, 0};
Point(12) = {bore, 0, 0};
Point(13) = {0, bore, 0};
Point(14) = {0, 0, 0};
Point(15) = {0, 25, 0, 6};
Point(16) = {20, 25, 0, 6};
Point(17) = {20, -35, 0, 6};
Point(18) = {0, -35, 0, 6};
Circle(11) = {11, 14, 12};
Circle(12) = {12, 14, 13};
Line(13) = {13, 15};
Line(14) = {15, 16};
Line(15) = {16, 17};
Line(16) = {17, 18};
Line(17) = {18, 11};
Curve Loop(2) = {-11, -17, -16, -15, -14, -13, -12}; // counter-clockwise, as the elements then are
Plane Surface(2) = {2};
Transfinite Curve{11} = 17;
Transfinite Curve{12} = 12;

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1; // without it a node in the middle of quadrilaterals, which no card can hold
Physical Surface("pin", 1) = {1};
Physical Surface("lug", 2) = {2};
Physical Curve("round the pin", 20) = {1, 2};
Physical Curve("bore", 21) = {11, 12};
Physical Curve("held", 22) = {16};
Physical Curve("symmetry of the pin, upper half", 23) = {3};
Physical Curve("symmetry of the pin, lower half", 25) = {4};
Physical Curve("symmetry of the lug", 24) = {13, 17};
