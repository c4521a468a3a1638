// Isochor, SPDX-License-Identifier: LGPL-2.1-or-later
//
// A quarter of a ring 1 m < r < 2 m, n cells over the thickness:
//   gmsh -2 ring.geo -setnumber n 16 -o ring.msh
DefineConstant[ n = {16, Min 1, Max 1000, Name "cells over the thickness"} ];
a = 1;
b = 2;

Point(1) = {0, 0, 0};
Point(2) = {a, 0, 0};
Point(3) = {b, 0, 0};
Point(4) = {0, b, 0};
Point(5) = {0, a, 0};
Line(1) = {2, 3};
Circle(2) = {3, 1, 4};
Line(3) = {4, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

Transfinite Curve {1, 3} = n + 1;
Transfinite Curve {2, 4} = 2 * n + 1;
Transfinite Surface {1} Alternated;
Mesh.MshFileVersion = 2.2;

Physical Curve("bottom") = {1};
Physical Curve("outer") = {2};
Physical Curve("left") = {3};
Physical Curve("inner") = {4};
Physical Surface("ring") = {1};
