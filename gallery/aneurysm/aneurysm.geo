// Section of a vessel of 2 mm radius with a bulge, its wall of 0.3 mm, in the plane of radius and axis.
DefineConstant[ bulge = 2.0, size = 0.4, wall = 0.3 ];  // mm
n = 30;
Point(1) = {0, 0, 0, size};
Point(2) = {0, 24, 0, size};
For i In {0 : n}
  z = 24 * i / n;
  r = 2;
  If (z > 6 && z < 18)
    r = 2 + bulge / 2 * (1 - Cos(2 * Pi * (z - 6) / 12));
  EndIf
  Point(100 + i) = {r, z, 0, 0.6 * size};
  Point(200 + i) = {r + wall, z, 0, 0.6 * size};
EndFor
Spline(1) = {100 : 100 + n};
Spline(2) = {200 : 200 + n};
Line(3) = {1, 100};
Line(4) = {100, 200};
Line(5) = {200 + n, 100 + n};
Line(6) = {100 + n, 2};
Line(7) = {2, 1};
Curve Loop(1) = {3, 1, 6, 7};
Curve Loop(2) = {4, 2, 5, -1};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Physical Surface("fluid") = {1};
Physical Surface("wall") = {2};
Physical Curve("inlet") = {3};
Physical Curve("outlet") = {6};
Physical Curve("wall_ends") = {4, 5};
Physical Curve("outer") = {2};
