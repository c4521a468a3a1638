// Isochor, SPDX-License-Identifier: LGPL-2.1-or-later
//
// A quarter of the section through a billet of radius 10 mm and height 30 mm, x the
// distance from the axis, and beside it the room that it bulges into:
//   gmsh -2 section.geo -setnumber n 16 -o section.msh
// n     cells per radius
// room  radius of the grid (m)
DefineConstant[
  n    = {16, Min 1, Max 200, Name "n"},
  room = {0.018, Min 0.011, Max 0.1, Name "room"}
];
radius      = 0.01;
half_height = 0.015;
h           = radius / n;

Point(1) = {0, 0, 0, h};
Point(2) = {radius, 0, 0, h};
Point(3) = {room, 0, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Transfinite Curve {1} = n + 1;
Transfinite Curve {2} = Ceil((room - radius) / h) + 1;
body[] = Extrude {0, half_height, 0} { Line{1}; };
air[]  = Extrude {0, half_height, 0} { Line{2}; };
Transfinite Curve {body[2], body[3], air[2]} = Ceil(half_height / h) + 1;
Transfinite Surface {body[1], air[1]} Alternate;
Mesh.MshFileVersion = 2.2;

Physical Curve("bottom") = {1, 2};
Physical Curve("plate") = {body[0], air[0]};
Physical Curve("axis") = {body[3]};
Physical Curve("far") = {air[2]};
Physical Surface("billet") = {body[1]};
Physical Surface("room") = {air[1]};
