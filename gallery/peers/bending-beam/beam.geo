// A plate of 5 by 2.5 by 0.5 m that is held at one end. Lengths in mm.
DefineConstant[ along = 16, wide = 8, thick = 2 ];
Point(1) = {0, 0, 0};
Point(2) = {0, 2500, 0};
Line(1) = {1, 2};
Transfinite Curve{1} = wide + 1;
up[] = Extrude { 0, 0, 500 } { Curve{1}; Layers{thick}; };
body[] = Extrude { 5000, 0, 0 } { Surface{up[1]}; Layers{along}; };
Physical Volume("beam") = {body[1]};
Physical Surface("wall_ends") = {up[1]};
Physical Surface("tip") = {body[0]};
