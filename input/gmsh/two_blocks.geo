// Two blocks 60 x 40 x 20 mm, one on the other, meshed through: the program splits the face between them into a joint.
// gmsh -3 -format bdf -setnumber Mesh.SaveElementTagType 2 -o two_blocks_mesh.bdf two_blocks.geo
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 60, 40, 20};
Box(2) = {0, 0, 20, 60, 40, 20};
Coherence;
MeshSize {:} = 14;
Physical Volume("lower", 1) = {1};
Physical Volume("upper", 2) = {2};
Physical Surface("joint", 20) = Surface In BoundingBox {-1, -1, 19, 61, 41, 21};
Physical Surface("bottom", 21) = Surface In BoundingBox {-1, -1, -1, 61, 41, 1};
Physical Surface("top", 22) = Surface In BoundingBox {-1, -1, 39, 61, 41, 41};
