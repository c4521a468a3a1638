// Isochor, SPDX-License-Identifier: LGPL-2.1-or-later
//
// The grid around a cone penetrometer of radius 1 m: fine where it goes, growing
// outwards to 30 radii.
//   gmsh -2 cone.geo -setnumber n 6 -o cone.msh
// n  cells over the radius
DefineConstant[ n = {6, Min 2, Max 30, Name "n"} ];
r0 = 2; r1 = 30; top = 2; z0 = -11; z1 = -30;
nr = Round(r0*n); nz = Round((top - z0)*n);
grow = 1.15;
// cells of a geometric row that begins with 1/n and covers a length L
mr = Ceil(Log(1 + (r1 - r0)*n*(grow - 1))/Log(grow));
mz = Ceil(Log(1 + (z0 - z1)*n*(grow - 1))/Log(grow));
Point(1) = {0, z1, 0};  Point(2) = {r0, z1, 0};  Point(3) = {r1, z1, 0};
Point(4) = {0, z0, 0};  Point(5) = {r0, z0, 0};  Point(6) = {r1, z0, 0};
Point(7) = {0, top, 0}; Point(8) = {r0, top, 0}; Point(9) = {r1, top, 0};
Line(1) = {1, 2}; Line(2) = {2, 3};
Line(3) = {4, 5}; Line(4) = {5, 6};
Line(5) = {7, 8}; Line(6) = {8, 9};
Line(7) = {4, 1}; Line(8) = {5, 2}; Line(9) = {6, 3};
Line(10) = {7, 4}; Line(11) = {8, 5}; Line(12) = {9, 6};
Transfinite Curve{1, 3, 5} = nr + 1;
Transfinite Curve{2, 4, 6} = mr + 1 Using Progression grow;
Transfinite Curve{7, 8, 9} = mz + 1 Using Progression grow;
Transfinite Curve{10, 11, 12} = nz + 1;
Curve Loop(1) = {1, -8, -3, 7};  Curve Loop(2) = {2, -9, -4, 8};
Curve Loop(3) = {3, -11, -5, 10}; Curve Loop(4) = {4, -12, -6, 11};
For i In {1:4}
  Plane Surface(i) = {i};
  Transfinite Surface{i} Alternate;
EndFor
Physical Curve("left") = {7, 10};
Physical Curve("right") = {9, 12};
Physical Curve("bottom") = {1, 2};
Physical Curve("top") = {5, 6};
Physical Surface("all") = {1:4};
