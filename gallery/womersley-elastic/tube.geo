// A tube of 1 m radius and 0.1 m wall in the plane of radius and axis, to be turned about the axis: the liquid, finer towards the
// wall, and the wall. Lengths in mm.
DefineConstant[ across = 6, through = 1, along = 60, length = 60000 ];
Point(1) = {0, 0, 0};
Point(2) = {1000, 0, 0};
Point(3) = {1100, 0, 0};
Line(1) = {1, 2}; Transfinite Curve{1} = across + 1 Using Progression 0.8;
Line(2) = {2, 3}; Transfinite Curve{2} = through + 1;
f[] = Extrude { 0, length, 0 } { Curve{1}; Layers{along}; };
w[] = Extrude { 0, length, 0 } { Curve{2}; Layers{along}; };
Physical Surface("fluid") = {f[1]};
Physical Surface("wall") = {w[1]};
Physical Curve("inlet") = {1};
Physical Curve("outlet") = {f[0]};
Physical Curve("wall_ends") = {2, w[0]};
Physical Curve("outer") = {w[2]};
