// A rigid channel that forks into two, in the plane. Lengths in mm.
DefineConstant[ size = 2.0 ];
Point(1) = {0, -2, 0, size};
Point(2) = {8, -2, 0, size};
Point(3) = {14, -8, 0, size};
Point(4) = {16, -6, 0, size};
Point(5) = {11, 0, 0, size};
Point(6) = {16, 5, 0, size};
Point(7) = {13, 8, 0, size};
Point(8) = {7, 2, 0, size};
Point(9) = {0, 2, 0, size};
For i In {1 : 9}
  Line(i) = {i, i % 9 + 1};
EndFor
Curve Loop(1) = {1 : 9};
Plane Surface(1) = {1};
Physical Surface("fluid") = {1};
Physical Curve("inlet") = {9};
Physical Curve("lower") = {3};
Physical Curve("upper") = {6};
