// Half of a silicone flap, 11 by 2 by 65 mm, cut along its middle. Lengths in mm; z along it from where it is held, y across its
// thickness, x across its width from the plane of symmetry.
DefineConstant[ wide = 3, thick = 2, along = 26 ];
Point(1) = {0, -1, 0};
Point(2) = {5.5, -1, 0};
Point(3) = {5.5, 1, 0};
Point(4) = {0, 1, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1, 3} = wide + 1;
Transfinite Curve{2, 4} = thick + 1;
Transfinite Surface{1} Alternated;
v[] = Extrude { 0, 0, 65 } { Surface{1}; Layers{along}; };
Physical Volume("flap") = {v[1]};
Physical Surface("wall_ends") = {1};
Physical Surface("symmetry_x") = {v[5]};
