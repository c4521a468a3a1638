// Isochor, SPDX-License-Identifier: LGPL-2.1-or-later
//
// A quarter of each of two discs of radius 1 m with a gap of 0.01 m between them.
//   gmsh -2 discs.geo -setnumber n 16 -o discs.msh
// n  cells over the radius
DefineConstant[ n = {16, Min 2, Max 200, Name "n"} ];
Point(1) = {0, 0, 0, 1 / n};
Point(2) = {1, 0, 0, 1 / n};
Point(3) = {0, 1, 0, 1 / n};
Line(1) = {1, 2};
Circle(2) = {2, 1, 3};
Line(3) = {3, 1};
Curve Loop(1) = {1, 2, 3};
Plane Surface(1) = {1};
Point(4) = {0, 2.01, 0, 1 / n};
Point(5) = {1, 2.01, 0, 1 / n};
Point(6) = {0, 1.01, 0, 1 / n};
Line(4) = {4, 6};
Circle(5) = {6, 4, 5};
Line(6) = {5, 4};
Curve Loop(2) = {4, 5, 6};
Plane Surface(2) = {2};
Mesh.MshFileVersion = 2.2;
Physical Surface("discs") = {1, 2};
