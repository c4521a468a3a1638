// Isochor, SPDX-License-Identifier: LGPL-2.1-or-later
//
// Cook's membrane with cells that get small towards the two clamped corners,
// where the stress is singular:
//   gmsh -2 cook_graded.geo -setnumber n 32 -o cook_graded.msh
DefineConstant[ n = {32, Min 1, Max 1000, Name "cells over a side, far from the corners"} ];
Point(1) = {0, 0, 0};
Point(2) = {48, 44, 0};
Point(3) = {48, 60, 0};
Point(4) = {0, 44, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

// h = h_0 (r / R)^0.6 with r the distance to the nearer of the corners (1), (4)
// and of the load's ends (2), (3), not below h_0 / 200.
h = 44 / n;
Field[1] = MathEval;
Field[1].F = Sprintf("%g * Max(0.005, Min(1, (Sqrt(x*x + (y-44)^2) / 25)^0.6))", h);
Field[2] = MathEval;
Field[2].F = Sprintf("%g * Max(0.01, Min(1, (Sqrt(x*x + y*y) / 18)^0.6))", h);
Field[3] = MathEval;
Field[3].F = Sprintf("%g * Max(0.05, Min(1, (Sqrt((x-48)^2 + (y-60)^2) / 8)^0.6))", h);
Field[4] = MathEval;
Field[4].F = Sprintf("%g * Max(0.05, Min(1, (Sqrt((x-48)^2 + (y-44)^2) / 8)^0.6))", h);
Field[5] = Min;
Field[5].FieldsList = {1, 2, 3, 4};
Background Field = 5;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MshFileVersion = 2.2;

Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3};
Physical Curve("left") = {4};
Physical Surface("membrane") = {1};
