// Isochor, SPDX-License-Identifier: LGPL-2.1-or-later
//
// A foundation of 12 mm x 4 mm and, 0.2 mm above it, a die with a round bottom.
//   gmsh -2 ironing.geo -setnumber h 0.1 -o ironing.msh
// h  edges of the triangles (mm)
DefineConstant[ h = {0.1, Min 0.02, Max 1, Name "h"} ];
Point(1) = {0, 0, 0, h};
Point(2) = {12, 0, 0, h};
Point(3) = {12, 4, 0, h};
Point(4) = {0, 4, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Point(5) = {0.2, 4.5, 0, h};
Point(6) = {0.8, 4.2, 0, h};
Point(7) = {1.4, 4.5, 0, h};
Point(8) = {1.4, 5.4, 0, h};
Point(9) = {0.2, 5.4, 0, h};
Point(10) = {0.8, 4.95, 0, h};
Circle(5) = {5, 10, 6};
Circle(6) = {6, 10, 7};
Line(7) = {7, 8};
Line(8) = {8, 9};
Line(9) = {9, 5};
Curve Loop(2) = {5, 6, 7, 8, 9};
Plane Surface(2) = {2};
Mesh.MshFileVersion = 2.2;
Physical Surface("bodies") = {1, 2};
