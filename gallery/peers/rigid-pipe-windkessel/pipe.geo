// Section of a pipe of 20 mm radius and 300 mm length in the plane of radius and axis. Lengths in mm.
DefineConstant[ across = 6, along = 30 ];
Point(1) = {0, 0, 0};
Point(2) = {20, 0, 0};
Point(3) = {20, 300, 0};
Point(4) = {0, 300, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve{1} = across + 1 Using Progression 0.8;
Transfinite Curve{3} = across + 1 Using Progression 1 / 0.8;
Transfinite Curve{2, 4} = along + 1;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface{1};
Physical Surface("fluid") = {1};
Physical Curve("inlet") = {1};
Physical Curve("outlet") = {3};
