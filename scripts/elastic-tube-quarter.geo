// Quarter of the gallery's elastic tube between planes of symmetry: 5 mm radius, 1 mm wall, 50 mm length along z.
SetFactory("OpenCASCADE");
DefineConstant[ size = 1.25 ];
Cylinder(1) = {0, 0, 0, 0, 0, 50, 5, Pi / 2};
Cylinder(2) = {0, 0, 0, 0, 0, 50, 6, Pi / 2};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
Mesh.MeshSizeMax = size;
e = 1e-3;
inlet() = Surface In BoundingBox{-e, -e, -e, 5 + e, 5 + e, e};
outlet() = Surface In BoundingBox{-e, -e, 50 - e, 5 + e, 5 + e, 50 + e};
ends() = Surface In BoundingBox{-e, -e, -e, 6 + e, 6 + e, e};
ends() += Surface In BoundingBox{-e, -e, 50 - e, 6 + e, 6 + e, 50 + e};
ends() -= inlet();
ends() -= outlet();
x() = Surface In BoundingBox{-e, -e, -e, e, 6 + e, 50 + e};
y() = Surface In BoundingBox{-e, -e, -e, 6 + e, e, 50 + e};
fluid() = Volume In BoundingBox{-e, -e, -e, 5 + e, 5 + e, 50 + e};
wall() = Volume{:};
wall() -= fluid();
Physical Volume("fluid") = fluid();
Physical Volume("wall") = wall();
Physical Surface("inlet") = inlet();
Physical Surface("outlet") = outlet();
Physical Surface("wall_ends") = ends();
Physical Surface("symmetry_x") = x();
Physical Surface("symmetry_y") = y();
