// Isochor, SPDX-License-Identifier: LGPL-2.1-or-later
//
// A quarter of the ground below a square footing of width B = 1 m:
//   gmsh -3 square_footing.geo -setnumber n 8 -o square_footing.msh
// n      cells per width B below the footing
// inset  how far (m) the last nodes of the base lie inside its edge. The velocity
//        falls linearly from them to the next nodes: half a cell makes the width
//        that acts B, see prm/prandtl
// y points upwards, the surface is y = 0.
DefineConstant[
  n     = {8, Min 1, Max 64, Name "n"},
  inset = {0.5 / n, Min 0, Max 0.4, Name "inset"}
];
width = 2.5;
depth = 2;
h     = 1 / n;
h_far = 0.5;
b     = 0.5 - inset;

Point(1) = {0, 0, 0};
Point(2) = {b, 0, 0};
Point(3) = {b, 0, b};
Point(4) = {0, 0, b};
Point(5) = {width, 0, 0};
Point(6) = {width, 0, width};
Point(7) = {0, 0, width};
Point(11) = {0, -depth, 0};
Point(15) = {width, -depth, 0};
Point(16) = {width, -depth, width};
Point(17) = {0, -depth, width};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {2, 5};
Line(6) = {5, 6};
Line(7) = {6, 7};
Line(8) = {7, 4};
Line(11) = {11, 15};
Line(12) = {15, 16};
Line(13) = {16, 17};
Line(14) = {17, 11};
Line(21) = {1, 11};
Line(22) = {5, 15};
Line(23) = {6, 16};
Line(24) = {7, 17};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1}; // footing
Curve Loop(2) = {5, 6, 7, 8, -3, -2};
Plane Surface(2) = {2}; // free surface
Curve Loop(3) = {11, 12, 13, 14};
Plane Surface(3) = {3}; // bottom
Curve Loop(4) = {1, 5, 22, -11, -21};
Plane Surface(4) = {4}; // z = 0
Curve Loop(5) = {-4, -8, 24, 14, -21};
Plane Surface(5) = {5}; // x = 0
Curve Loop(6) = {6, 23, -12, -22};
Plane Surface(6) = {6}; // x = width
Curve Loop(7) = {7, 24, -13, -23};
Plane Surface(7) = {7}; // z = width
Surface Loop(1) = {1, 2, 3, 4, 5, 6, 7};
Volume(1) = {1};

// cells of size h where the ground flows, growing by a quarter per unit length
Field[1] = Box;
Field[1].XMin = 0;
Field[1].XMax = 0.8;
Field[1].YMin = -0.5;
Field[1].YMax = 0;
Field[1].ZMin = 0;
Field[1].ZMax = 0.8;
Field[1].VIn = h;
Field[1].VOut = h_far;
Field[1].Thickness = 4 * (h_far - h);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MshFileVersion = 2.2;

Physical Surface("footing") = {1};
Physical Surface("surface") = {2};
Physical Surface("bottom") = {3};
Physical Surface("front") = {4};
Physical Surface("left") = {5};
Physical Surface("far x") = {6};
Physical Surface("far z") = {7};
Physical Volume("ground") = {1};
