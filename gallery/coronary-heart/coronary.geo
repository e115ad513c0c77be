// Section of a coronary artery of 1.5 mm radius, 0.5 mm wall and 30 mm length in the plane of radius and axis.
DefineConstant[ across = 5, through = 2, along = 24 ];
Point(1) = {0, 0, 0};
Point(2) = {1.5, 0, 0};
Point(3) = {2, 0, 0};
Line(1) = {1, 2}; Transfinite Curve{1} = across + 1 Using Progression 0.8;
Line(2) = {2, 3}; Transfinite Curve{2} = through + 1;
f[] = Extrude { 0, 30, 0 } { Curve{1}; Layers{along}; };
w[] = Extrude { 0, 30, 0 } { Curve{2}; Layers{along}; };
Physical Surface("fluid") = {f[1]};
Physical Surface("wall") = {w[1]};
Physical Curve("inlet") = {1};
Physical Curve("outlet") = {f[0]};
Physical Curve("wall_ends") = {2, w[0]};
Physical Curve("outer") = {w[2]};
