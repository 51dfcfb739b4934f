// a bed of solids and a sheet upright on it; SHELLS (0, or 1 with -setnumber SHELLS 1) is what is meshed
SetFactory("OpenCASCADE");
DefineConstant[ SHELLS = 0 ];
If (SHELLS == 0)
   Box(1) = {0, 0, -40, 200, 100, 40};
   e = 0.01;
   Physical Volume(1) = {1};
   Physical Surface(20) = Surface In BoundingBox{-e, -e, -40 - e, 200 + e, 100 + e, -40 + e};
   Physical Surface(21) = Surface In BoundingBox{-e, -e, -e, 200 + e, 100 + e, e};
   MeshSize{:} = 30;
Else
   Rectangle(1) = {0, 0, 0, 160, 80};
   Rotate {{1, 0, 0}, {0, 0, 0}, Pi/2} { Surface{1}; }
   Translate {20, 50, 0} { Surface{1}; }
   Physical Surface(2) = {1};
   Physical Curve(30) = Curve In BoundingBox{-1, -1, -0.01, 201, 101, 0.01};
   Mesh.RecombineAll = 1;
   MeshSize{:} = 20;
EndIf
