// Half of a channel, 1500 by 400 by 800 mm, with an elastic block of 100 by 200 by 400 mm on its floor (Richter 2012), cells finer
// towards the block. Lengths in mm; x along the flow, y upwards, z from the plane of symmetry to the side.
DefineConstant[ before = 8, block = 4, behind = 10, up = 6, above = 4, wide = 4, edge = 2, beside = 2, far = 2 ];
Point(1) = {0, 0, 0};
Point(2) = {400, 0, 0};
Point(3) = {500, 0, 0};
Point(4) = {1500, 0, 0};
Point(5) = {0, 200, 0};
Point(6) = {400, 200, 0};
Point(7) = {500, 200, 0};
Point(8) = {1500, 200, 0};
Point(9) = {0, 400, 0};
Point(10) = {400, 400, 0};
Point(11) = {500, 400, 0};
Point(12) = {1500, 400, 0};
For row In {0 : 2}
  For column In {1 : 3}
    Line(10 * row + column) = {4 * row + column, 4 * row + column + 1};
  EndFor
EndFor
For row In {0 : 1}
  For column In {1 : 4}
    Line(100 + 10 * row + column) = {4 * row + column, 4 * row + column + 4};
  EndFor
  For column In {1 : 3}
    Curve Loop(10 * row + column) = {10 * row + column, 100 + 10 * row + column + 1, -(10 * row + 10 + column), -(100 + 10 * row + column)};
    Plane Surface(10 * row + column) = {10 * row + column};
  EndFor
EndFor
Transfinite Curve{1, 11, 21} = before + 1 Using Progression 0.7;
Transfinite Curve{2, 12, 22} = block + 1;
Transfinite Curve{3, 13, 23} = behind + 1 Using Progression 1.4;
Transfinite Curve{101 : 104} = up + 1 Using Progression 0.85;
Transfinite Curve{111 : 114} = above + 1 Using Progression 1.4;
// Diagonals that start from the inlet's corners: a cell with all of its nodes on walls would leave a pressure that nothing determines.
Transfinite Surface{1 : 3} Right;
Transfinite Surface{11 : 13} Left;
// Across: over the block's half width, and from there to the side.
inner[] = Extrude { 0, 0, 200 } { Surface{1, 2, 3, 11, 12, 13}; Layers{ {wide, edge}, {0.7, 1} }; };
e = 1e-3;
side() = Surface In BoundingBox{-e, -e, 200 - e, 1500 + e, 400 + e, 200 + e};
outer[] = Extrude { 0, 0, 200 } { Surface{side()}; Layers{ {beside, far}, {0.4, 1} }; };
wall() = Volume In BoundingBox{400 - e, -e, -e, 500 + e, 200 + e, 200 + e};
fluid() = Volume{:};
fluid() -= wall();
Physical Volume("fluid") = {fluid()};
Physical Volume("block") = {wall()};
inlet() = Surface In BoundingBox{-e, -e, -e, e, 400 + e, 400 + e};
outlet() = Surface In BoundingBox{1500 - e, -e, -e, 1500 + e, 400 + e, 400 + e};
middle() = Surface In BoundingBox{-e, -e, -e, 1500 + e, 400 + e, e};
foot() = Surface In BoundingBox{400 - e, -e, -e, 500 + e, e, 200 + e};
Physical Surface("inlet") = {inlet()};
Physical Surface("outlet") = {outlet()};
Physical Surface("symmetry_z") = {middle()};
Physical Surface("wall_ends") = {foot()};
