// Half of the flow of Hessenthaler et al. 2017, cut along its middle: two pipes that end in a wide tube, and a silicone flap of 11 by 2 by
// 65 mm that is held between them. Lengths in mm; z along the flow from where the flap is held, y from pipe to pipe.
// Published: flap, pipes, their places, the beginning and the tube's width. Assumed: the tube's section is an ellipse where the pipes end and
// becomes a circle over `widening`; the published tube ends at 89.5, and goes on for 250 there.
SetFactory("OpenCASCADE");
DefineConstant[ near = 6, pipes = 7, jets = 10, far = 20 ];  // sizes of elements
DefineConstant[ start = 20.4, widening = 40, length = 240 ];
Cylinder(1) = {0, 27.15, -29.5, 0, 0, 29.5, 10.95};
Cylinder(2) = {0, -27.15, -29.5, 0, 0, 29.5, 10.95};
Ellipse(101) = {0, 0, 0, 39, start};
Circle(102) = {0, 0, widening, 38.1};
Rotate { {0, 0, 1}, {0, 0, 0}, Pi / 2 } { Curve{101, 102}; }
Curve Loop(101) = {101};
Curve Loop(102) = {102};
ThruSections(3) = {101, 102};
Cylinder(4) = {0, 0, widening, 0, 0, length - widening, 38.1};
whole() = BooleanUnion{ Volume{1}; Delete; }{ Volume{2, 3, 4}; Delete; };
Box(11) = {0, -50, -50, 50, 100, length + 100};
half() = BooleanIntersection{ Volume{whole()}; Delete; }{ Volume{11}; Delete; };
Box(12) = {0, -1, 0, 5.5, 2, 65};
v() = BooleanFragments{ Volume{half()}; Delete; }{ Volume{12}; Delete; };
e = 1e-2;
flap() = Volume In BoundingBox{-e, -1 - e, -e, 5.5 + e, 1 + e, 65 + e};
fluid() = Volume{:};
fluid() -= flap();
Physical Volume("fluid") = {fluid()};
Physical Volume("flap") = {flap()};
upper() = Surface In BoundingBox{-e, 0, -29.5 - e, 11, 50, -29.5 + e};
lower() = Surface In BoundingBox{-e, -50, -29.5 - e, 11, 0, -29.5 + e};
outlet() = Surface In BoundingBox{-e, -50, length - e, 50, 50, length + e};
middle() = Surface In BoundingBox{-e, -50, -50, e, 50, length + e};
foot() = Surface In BoundingBox{-e, -1 - e, -e, 5.5 + e, 1 + e, e};
Physical Surface("upper") = {upper()};
Physical Surface("lower") = {lower()};
Physical Surface("outlet") = {outlet()};
Physical Surface("symmetry_x") = {middle()};
Physical Surface("wall_ends") = {foot()};
// Sizes: the flap and where it moves, pipes and jets, what is behind.
Field[1] = Box;
Field[1].VIn = near; Field[1].VOut = far; Field[1].Thickness = 40;
Field[1].XMin = 0; Field[1].XMax = 9; Field[1].YMin = -4; Field[1].YMax = 26; Field[1].ZMin = 0; Field[1].ZMax = 70;
Field[2] = Box;
Field[2].VIn = jets; Field[2].VOut = far; Field[2].Thickness = 60;
Field[2].XMin = 0; Field[2].XMax = 40; Field[2].YMin = -40; Field[2].YMax = 40; Field[2].ZMin = 0; Field[2].ZMax = 90;
Field[3] = Box;
Field[3].VIn = pipes; Field[3].VOut = far; Field[3].Thickness = 60;
Field[3].XMin = 0; Field[3].XMax = 12; Field[3].YMin = -40; Field[3].YMax = 40; Field[3].ZMin = -30; Field[3].ZMax = 5;
Field[4] = Min;
Field[4].FieldsList = {1, 2, 3};
Background Field = 4;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
