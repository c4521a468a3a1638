// Isochor, SPDX-License-Identifier: LGPL-2.1-or-later
//
// Square plate 0.1 m x 0.1 m, unstructured triangles of edge length h (m):
//   gmsh -2 plate.geo -setnumber h 0.001 -o plate.msh
// With room > 0 the grid goes on above the plate for so many metres, as a plate
// that is pulled on a grid at rest needs it.
DefineConstant[ h = {0.001, Min 1e-4, Max 0.1, Name "h"} ];
DefineConstant[ room = {0, Min 0, Max 0.1, Name "room"} ];
width  = 0.1;
height = 0.1;

Point(1) = {0, 0, 0};
Point(2) = {width, 0, 0};
Point(3) = {width, height, 0};
Point(4) = {0, height, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

// The size is the same everywhere, whatever the points or options say.
Field[1] = MathEval;
Field[1].F = Sprintf("%g", h);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm = 6; // frontal Delaunay: nearly equilateral triangles
Mesh.MshFileVersion = 2.2;

Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("left") = {4};
Physical Surface("plate") = {1};
If (room > 0)
  Point(5) = {width, height + room, 0};
  Point(6) = {0, height + room, 0};
  Line(5) = {3, 5};
  Line(6) = {5, 6};
  Line(7) = {6, 4};
  Curve Loop(2) = {-3, 5, 6, 7};
  Plane Surface(2) = {2};
  Physical Surface("room") = {2};
Else
  Physical Curve("top") = {3};
EndIf
