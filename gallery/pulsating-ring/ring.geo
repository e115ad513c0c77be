// A slice of a ring in the plane of radius and axis, to be turned about the axis: blood outside a porous cylinder, and
// the wall's two layers. Lengths in mm.
DefineConstant[ across = 6, media = 2, adventitia = 1, height = 0.4 ];
Point(1) = {0.5, 0, 0};
Point(2) = {1.43, 0, 0};
Point(3) = {1.69, 0, 0};
Point(4) = {1.82, 0, 0};
Line(1) = {1, 2}; Transfinite Curve{1} = across + 1;
Line(2) = {2, 3}; Transfinite Curve{2} = media + 1;
Line(3) = {3, 4}; Transfinite Curve{3} = adventitia + 1;
f[] = Extrude { 0, height, 0 } { Curve{1}; Layers{1}; };
m[] = Extrude { 0, height, 0 } { Curve{2}; Layers{1}; };
a[] = Extrude { 0, height, 0 } { Curve{3}; Layers{1}; };
Physical Surface("fluid") = {f[1]};
Physical Surface("media") = {m[1]};
Physical Surface("adventitia") = {a[1]};
Physical Curve("inlet") = {f[3]};
Physical Curve("outer") = {a[2]};
Physical Curve("symmetry_z") = {1, 2, 3, f[0], m[0], a[0]};
