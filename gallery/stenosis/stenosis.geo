// Section of a pipe of 2 mm radius and 50 mm length with a stenosis, in the plane of radius and axis.
DefineConstant[ narrowing = 1.0, size = 0.35 ];  // mm at the throat, mm
n = 40;
Point(1) = {0, 0, 0, size};
Point(2) = {2, 0, 0, size};
For i In {0 : n}
  z = 14 + 12 * i / n;
  Point(10 + i) = {2 - narrowing / 2 * (1 - Cos(2 * Pi * i / n)), z, 0, 0.5 * size};
EndFor
Point(3) = {2, 50, 0, size};
Point(4) = {0, 50, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 10};
Spline(3) = {10 : 10 + n};
Line(4) = {10 + n, 3};
Line(5) = {3, 4};
Line(6) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};
Physical Surface("fluid") = {1};
Physical Curve("inlet") = {1};
Physical Curve("outlet") = {5};
Physical Curve("pipe") = {2, 3, 4};
