// A bar 2 x 1 x 1, in the plane 2 x 1, its ends and planes of symmetry physical groups, to be meshed with every kind of element:
// -setnumber kind 1 triangles, 2 quadrilaterals, 3 tetrahedra, 4 wedges, 5 hexahedra
DefineConstant[ kind = 3 ];
Point(1) = {0, 0, 0, 1};
Point(2) = {2, 0, 0, 1};
Point(3) = {2, 1, 0, 1};
Point(4) = {0, 1, 0, 1};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
If (kind == 2 || kind == 5)
  Transfinite Surface {1};
  Recombine Surface {1};
EndIf
If (kind <= 2)
  Physical Surface(1) = {1};
  Physical Curve(21) = {4};
  Physical Curve(22) = {2};
  Physical Curve(23) = {1};
Else
  If (kind == 3)
    body[] = Extrude {0, 0, 1} { Surface{1}; };
  Else
    body[] = Extrude {0, 0, 1} { Surface{1}; Layers{1}; Recombine; };
  EndIf
  Physical Volume(1) = {body[1]};
  Physical Surface(21) = Surface In BoundingBox {-0.1, -0.1, -0.1, 0.1, 1.1, 1.1};
  Physical Surface(22) = Surface In BoundingBox {1.9, -0.1, -0.1, 2.1, 1.1, 1.1};
  Physical Surface(23) = Surface In BoundingBox {-0.1, -0.1, -0.1, 2.1, 0.1, 1.1};
  Physical Surface(25) = Surface In BoundingBox {-0.1, -0.1, -0.1, 2.1, 1.1, 0.1};
EndIf
