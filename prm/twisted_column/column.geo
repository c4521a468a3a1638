// Isochor, SPDX-License-Identifier: LGPL-2.1-or-later
//
// A round column, radius 0.5 m, height 3 m, axis y:
//   gmsh -3 column.geo -setnumber n 6 -o twisted_column.msh
// n   cells per radius
DefineConstant[ n = {6, Min 1, Max 50, Name "n"} ];
radius = 0.5;
height = 3;
h      = radius / n;
Point(1) = {0, 0, 0, h};
Point(2) = {radius, 0, 0, h};
Point(3) = {0, 0, radius, h};
Point(4) = {-radius, 0, 0, h};
Point(5) = {0, 0, -radius, h};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
body[] = Extrude {0, height, 0} { Surface{1}; Layers{height / h}; };
Mesh.MshFileVersion = 2.2;

Physical Surface("bottom") = {1};
Physical Surface("top") = {body[0]};
Physical Surface("side") = {body[2], body[3], body[4], body[5]};
Physical Volume("column") = {body[1]};
