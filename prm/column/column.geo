// Isochor, SPDX-License-Identifier: LGPL-2.1-or-later
//
// The column 6.25 m x 50 m, n edges over the height:
//   gmsh -2 column.geo -setnumber n 16 -o column.msh
DefineConstant[ n = {16, Min 1, Max 1000, Name "edges over the height"} ];
width = 6.25;
height = 50;
h = height / n;

Point(1) = {0, 0, 0, h};
Point(2) = {width, 0, 0, h};
Point(3) = {width, height, 0, h};
Point(4) = {0, height, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Mesh.MshFileVersion = 2.2;

Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3};
Physical Curve("left") = {4};
Physical Surface("column") = {1};
