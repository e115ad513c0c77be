// A vessel that forks: three tubes with a wall of one layer around. Lengths in mm.
SetFactory("OpenCASCADE");
DefineConstant[ parent = 2, daughter = 1.5, wall = 0.4, length = 8, half_angle = 35, size = 0.9 ];
a = half_angle * Pi / 180;
Cylinder(1) = {0, 0, -length, 0, 0, length, parent};
Cylinder(2) = {0, 0, -1, length * Sin(a), 0, length * Cos(a), daughter};
Cylinder(3) = {0, 0, -1, -length * Sin(a), 0, length * Cos(a), daughter};
lumen() = BooleanUnion{ Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
Cylinder(11) = {0, 0, -length, 0, 0, length + wall, parent + wall};
Cylinder(12) = {0, 0, -1, length * Sin(a), 0, length * Cos(a), daughter + wall};
Cylinder(13) = {0, 0, -1, -length * Sin(a), 0, length * Cos(a), daughter + wall};
whole() = BooleanUnion{ Volume{11}; Delete; }{ Volume{12, 13}; Delete; };
v() = BooleanFragments{ Volume{lumen()}; Delete; }{ Volume{whole()}; Delete; };
Mesh.MeshSizeMax = size;
Mesh.MeshSizeMin = 0.3 * size;
Printf("%g volumes", #v());
Physical Volume("fluid") = {v(0)};
Physical Volume("media") = {v(1)};
e = 1e-3;
p = parent + e;
q = parent + wall + e;
inlet() = Surface In BoundingBox{-p, -p, -length - e, p, p, -length + e};
ends() = Surface In BoundingBox{-q, -q, -length - e, q, q, -length + e};
ends() -= inlet();
// The daughters' ends: boxes around tilted disks.
x = length * Sin(a);
z = length * Cos(a) - 1;
For s In {-1 : 1 : 2}
  r = daughter + e;
  disk() = Surface In BoundingBox{s * x - r * Cos(a) - e, -r, z - r * Sin(a) - e, s * x + r * Cos(a) + e, r, z + r * Sin(a) + e};
  r = daughter + wall + e;
  both() = Surface In BoundingBox{s * x - r * Cos(a) - e, -r, z - r * Sin(a) - e, s * x + r * Cos(a) + e, r, z + r * Sin(a) + e};
  both() -= disk();
  ends() += both();
  If (s < 0)
    Physical Surface("left") = {disk()};
  Else
    Physical Surface("right") = {disk()};
  EndIf
EndFor
Physical Surface("inlet") = {inlet()};
Physical Surface("wall_ends") = {ends()};
