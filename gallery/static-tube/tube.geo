// A slice of a wall of two layers in the plane of radius and axis, to be turned about the axis. Lengths in mm.
DefineConstant[ media = 4, adventitia = 2, height = 0.4 ];
Point(1) = {1.43, 0, 0};
Point(2) = {1.69, 0, 0};
Point(3) = {1.82, 0, 0};
Line(1) = {1, 2}; Transfinite Curve{1} = media + 1;
Line(2) = {2, 3}; Transfinite Curve{2} = adventitia + 1;
m[] = Extrude { 0, height, 0 } { Curve{1}; Layers{1}; };
a[] = Extrude { 0, height, 0 } { Curve{2}; Layers{1}; };
Physical Surface("media") = {m[1]};
Physical Surface("adventitia") = {a[1]};
Physical Curve("inner") = {m[3]};
Physical Curve("outer") = {a[2]};
Physical Curve("symmetry_z") = {1, 2, m[0], a[0]};
