// Isochor, SPDX-License-Identifier: LGPL-2.1-or-later
//
// Half of the ground under a strip footing of width B = 1 m, unstructured
// triangles: n per B under the footing, growing with the distance.
//   gmsh -2 prandtl.geo -setnumber n 16 -o prandtl.msh
DefineConstant[ n = {16, Min 2, Max 512, Name "cells per B"} ];
DefineConstant[ width = {5, Min 2, Max 50, Name "width of the half model"} ];
DefineConstant[ depth = {2.5, Min 1, Max 50, Name "depth"} ];
// Cells by which the last node of the footing lies inside its edge. Where nodes
// carry the footing, the cell beyond the last one is half moved: half a cell is
// the node's share, with 0 the footing is in effect one cell wider than B.
DefineConstant[ inset = {0.5, Min 0, Max 1, Name "inset of the last node"} ];
edge = 0.5 - inset / n;
room = 0.1; // empty grid above the ground, for the heave

Point(1) = {0, -depth, 0};
Point(2) = {width, -depth, 0};
Point(3) = {width, 0, 0};
Point(4) = {edge, 0, 0};
Point(5) = {0, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};

// Constant within B of the footing, then growing by a quarter of the distance.
Field[1] = MathEval;
Field[1].F = Sprintf("1/%g + 0.25 * Max(0, Sqrt(x*x + y*y) - %g)", n, 1.5);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm = 6;
Mesh.MshFileVersion = 2.2;

Physical Curve("bottom") = {1};
Physical Curve("right") = {2, 6};
Physical Curve("footing") = {4};
Physical Curve("left") = {5};
Physical Surface("ground") = {1};

Point(6) = {width, room, 0};
Point(7) = {edge, room, 0};
Line(6) = {3, 6};
Line(7) = {6, 7};
Line(8) = {7, 4};
Curve Loop(2) = {-3, 6, 7, 8};
Plane Surface(2) = {2};
Physical Surface("room") = {2};
