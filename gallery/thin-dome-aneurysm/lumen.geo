// The lumen of a vessel with a spherical aneurysm on its side, its neck rounded. Lengths in mm.
SetFactory("OpenCASCADE");
DefineConstant[ vessel = 1.5, dome = 3.5, centre = 3.2, neck = 0.8, length = 16, size = 0.5 ];
Cylinder(1) = {-length / 2, 0, 0, length, 0, 0, vessel};
Sphere(2) = {0, 0, centre, dome};
both() = BooleanUnion{ Volume{1}; Delete; }{ Volume{2}; Delete; };
e = 1e-3;
r = 1.2 * dome;
rim() = Curve In BoundingBox{-r, -r, -vessel - e, r, r, vessel + e};
lumen() = Fillet{ both() }{ rim() }{ neck };
Mesh.MeshSizeMax = size;
Mesh.MeshSizeMin = 0.5 * size;
Physical Volume("fluid") = {lumen()};
r = vessel + e;
inlet() = Surface In BoundingBox{-length / 2 - e, -r, -r, -length / 2 + e, r, r};
outlet() = Surface In BoundingBox{length / 2 - e, -r, -r, length / 2 + e, r, r};
Physical Surface("inlet") = {inlet()};
Physical Surface("outlet") = {outlet()};
