// Section of a wall, 20 mm inner radius, 2 mm thick, 300 mm long, in the plane of radius and axis. Lengths in mm.
DefineConstant[ through = 4, along = 120 ];
Point(1) = {20, 0, 0};
Point(2) = {22, 0, 0};
Point(3) = {22, 300, 0};
Point(4) = {20, 300, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1, 3} = through + 1;
Transfinite Curve{2, 4} = along + 1;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface{1};
Physical Surface("wall") = {1};
Physical Curve("inner") = {4};
Physical Curve("outer") = {2};
Physical Curve("wall_ends") = {1, 3};
