// The lumen of a vessel that forks: three tubes, whose branches meet in a sharp crotch. Lengths in mm.
SetFactory("OpenCASCADE");
DefineConstant[ parent = 2, daughter = 1.5, length = 8, half_angle = 35, size = 0.9 ];
a = half_angle * Pi / 180;
Cylinder(1) = {0, 0, -length, 0, 0, length, parent};
Cylinder(2) = {0, 0, -1, length * Sin(a), 0, length * Cos(a), daughter};
Cylinder(3) = {0, 0, -1, -length * Sin(a), 0, length * Cos(a), daughter};
v() = BooleanUnion{ Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
Mesh.MeshSizeMax = size; Mesh.MeshSizeMin = 0.3 * size;
Physical Volume("fluid") = {v(0)};
e = 1e-3; p = parent + e;
inlet() = Surface In BoundingBox{-p, -p, -length - e, p, p, -length + e};
x = length * Sin(a); z = length * Cos(a) - 1;
For s In {-1 : 1 : 2}
  r = daughter + e;
  disk() = Surface In BoundingBox{s * x - r * Cos(a) - e, -r, z - r * Sin(a) - e, s * x + r * Cos(a) + e, r, z + r * Sin(a) + e};
  If (s < 0)
    Physical Surface("left") = {disk()};
  Else
    Physical Surface("right") = {disk()};
  EndIf
EndFor
Physical Surface("inlet") = {inlet()};
