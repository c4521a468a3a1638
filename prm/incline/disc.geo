// Isochor, SPDX-License-Identifier: LGPL-2.1-or-later
//
// A disc of radius 0.5 m, its lowest point in the origin, edges of length h:
//   gmsh -2 disc.geo -setnumber h 0.05 -o disc.msh
DefineConstant[ h = {0.05, Min 0.001, Max 0.5, Name "length of edges"} ];
R = 0.5;

Point(1) = {0, R, 0, h};
Point(2) = {R, R, 0, h};
Point(3) = {0, 2 * R, 0, h};
Point(4) = {-R, R, 0, h};
Point(5) = {0, 0, 0, h};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Mesh.MshFileVersion = 2.2;

Physical Surface("disc") = {1};
