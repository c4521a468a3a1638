// Isochor, SPDX-License-Identifier: LGPL-2.1-or-later
//
// Half of a block of clay, 5 m x 15 m, with a round hole of radius 1 m.
//   gmsh -2 pipe.geo -setnumber n 8 -o pipe.msh
// n  edges over the radius
DefineConstant[ n = {8, Min 2, Max 100, Name "n"} ];
Point(1) = {0, 0, 0, 1 / n};
Point(2) = {0, -1, 0, 1 / n};
Point(3) = {1, 0, 0, 1 / n};
Point(4) = {0, 1, 0, 1 / n};
Point(5) = {0, 10, 0, 1 / n};
Point(6) = {5, 10, 0, 1 / n};
Point(7) = {5, -5, 0, 1 / n};
Point(8) = {0, -5, 0, 1 / n};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Line(3) = {4, 5};
Line(4) = {5, 6};
Line(5) = {6, 7};
Line(6) = {7, 8};
Line(7) = {8, 2};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7};
Plane Surface(1) = {-1};
Mesh.MshFileVersion = 2.2;
Physical Surface("clay") = {1};
