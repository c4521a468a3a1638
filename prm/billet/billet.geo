// Isochor, SPDX-License-Identifier: LGPL-2.1-or-later
//
// An eighth of a billet, radius 10 mm, height 30 mm, axis y, and beside it the room
// that it bulges into:
//   gmsh -3 billet.geo -setnumber n 6 -o billet.msh
// n     cells per radius
// room  radius of the grid (m)
DefineConstant[
  n    = {6, Min 1, Max 64, Name "n"},
  room = {0.018, Min 0.011, Max 0.1, Name "room"}
];
radius      = 0.01;
half_height = 0.015;
h           = radius / n;
// The section is a polygon: corners on a circle such that its area is the circle's.
sides  = Ceil(Pi / 2 * n);
angle  = Pi / 2 / sides;
corner = radius * Sqrt(angle / Sin(angle));

Point(1) = {0, 0, 0, h};
Point(2) = {corner, 0, 0, h};
Point(3) = {0, 0, corner, h};
Point(4) = {room, 0, 0, 1.5 * h};
Point(5) = {0, 0, room, 1.5 * h};
Line(1) = {1, 2};
Line(2) = {3, 1};
Circle(3) = {2, 1, 3};
Line(4) = {2, 4};
Line(5) = {5, 3};
Circle(6) = {4, 1, 5};
Transfinite Curve {3} = sides + 1;
Curve Loop(1) = {1, 3, 2};
Plane Surface(1) = {1};
Curve Loop(2) = {4, 6, 5, -3};
Plane Surface(2) = {2};
body[] = Extrude {0, half_height, 0} { Surface{1}; Layers{Ceil(half_height / h)}; };
air[]  = Extrude {0, half_height, 0} { Surface{2}; Layers{Ceil(half_height / h)}; };
Mesh.MshFileVersion = 2.2;

// names as of a box: planes of symmetry are y = 0, x = 0, z = 0
Physical Surface("bottom") = {1, 2};
Physical Surface("plate") = {body[0], air[0]};
Physical Surface("front") = {body[2], air[2]};
Physical Surface("left") = {body[4], air[4]};
Physical Surface("far") = {air[3]};
Physical Volume("billet") = {body[1]};
Physical Volume("room") = {air[1]};
