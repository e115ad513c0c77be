// A piece of a pipe in the plane of radius and axis, to be turned about the axis: blood, finer towards the wall, and the
// wall's two layers. Lengths in mm.
DefineConstant[ across = 10, media = 3, adventitia = 2, along = 8, length = 4 ];
Point(1) = {0, 0, 0};
Point(2) = {1.43, 0, 0};
Point(3) = {1.69, 0, 0};
Point(4) = {1.82, 0, 0};
Line(1) = {1, 2}; Transfinite Curve{1} = across + 1 Using Progression 0.8;
Line(2) = {2, 3}; Transfinite Curve{2} = media + 1;
Line(3) = {3, 4}; Transfinite Curve{3} = adventitia + 1;
f[] = Extrude { 0, length, 0 } { Curve{1}; Layers{along}; };
m[] = Extrude { 0, length, 0 } { Curve{2}; Layers{along}; };
a[] = Extrude { 0, length, 0 } { Curve{3}; Layers{along}; };
Physical Surface("fluid") = {f[1]};
Physical Surface("media") = {m[1]};
Physical Surface("adventitia") = {a[1]};
Physical Curve("inlet") = {1};
Physical Curve("outlet") = {f[0]};
Physical Curve("first_end") = {2, 3};
Physical Curve("last_end") = {m[0], a[0]};
Physical Curve("outer") = {a[2]};
