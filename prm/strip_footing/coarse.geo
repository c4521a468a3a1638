// Isochor, SPDX-License-Identifier: LGPL-2.1-or-later
//
// Coarse quadrilaterals for the strip footing on an adaptive grid: the names and
// places of footing.geo.
//   gmsh -2 coarse.geo -o footing_coarse.msh
// h      size (m) of the coarse cells
// inset  see footing.geo: half a cell of the finest level at the edge
DefineConstant[
  h     = {0.5, Min 1e-2, Max 2, Name "h"},
  inset = {h / 64, Min 0, Max 0.4, Name "inset"}
];
width      = 12;
depth      = 10;
head_room  = 2.5;
half_width = 0.5 - inset;
Point(1) = {0, 0, 0};
Point(2) = {half_width, 0, 0};
Point(3) = {width, 0, 0};
Point(4) = {width, depth, 0};
Point(5) = {width, depth + head_room, 0};
Point(6) = {half_width, depth + head_room, 0};
Point(7) = {half_width, depth, 0};
Point(8) = {0, depth, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {8, 1};
Line(9) = {2, 7};
Line(10) = {4, 7};
Curve Loop(1) = {1, 9, 7, 8};
Plane Surface(1) = {1};
Curve Loop(2) = {2, 3, 10, -9};
Plane Surface(2) = {2};
Curve Loop(3) = {4, 5, 6, -10};
Plane Surface(3) = {3};
Transfinite Curve{1, 7} = Ceil(half_width / h - 1e-6) + 1;
Transfinite Curve{2, 5, 10} = Round((width - half_width) / h) + 1;
Transfinite Curve{3, 8, 9} = Round(depth / h) + 1;
Transfinite Curve{4, 6} = Round(head_room / h) + 1;
Transfinite Surface{1, 2, 3};
Recombine Surface{1, 2, 3};
Mesh.MshFileVersion = 2.2;

Physical Curve("bottom") = {1, 2};
Physical Curve("far") = {3, 4};
Physical Curve("lid") = {5};
Physical Curve("shaft") = {6};
Physical Curve("footing") = {7};
Physical Curve("axis") = {8};
Physical Surface("soil") = {1, 2};
Physical Surface("air") = {3};
