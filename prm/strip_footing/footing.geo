// Isochor, SPDX-License-Identifier: LGPL-2.1-or-later
//
// Half model of a strip footing: soil 12 m x 10 m, and room for the heave
// beside the footing, which itself is a hole in the grid: its base is the
// boundary 'footing', its side the boundary 'shaft'.
//   gmsh -2 footing.geo -setnumber h 0.05 -setnumber h_far 0.3 -o footing.msh
// h       edge length (m) in the zone the mechanism reaches
// h_far   edge length (m) far from it
// h_edge  edge length (m) at the edge of the footing, where the velocity jumps
// inset   how far (m) the last node of the base lies inside the edge. The velocity
//         falls linearly from it to the next node, so that half of that cell acts
//         like footing: half an edge length makes the effective half width B/2
// uniform 1: edge length h in all of the soil, for comparison
DefineConstant[
  h       = {0.05, Min 1e-3, Max 1, Name "h"},
  h_far   = {0.3, Min 1e-3, Max 5, Name "h_far"},
  h_edge  = {h, Min 1e-4, Max 1, Name "h_edge"},
  inset   = {h_edge / 2, Min 0, Max 0.4, Name "inset"},
  uniform = {0, Choices {0, 1}, Name "uniform"}
];
width      = 12;   // of the soil
depth      = 10;   // of the soil
head_room  = 2.5;  // above the initial surface
half_width = 0.5 - inset; // of the base; that of the footing is 0.5 = B/2
fine_width = 6;    // the zone of edge length h: from the axis,
fine_depth = 2;    // from the initial surface down,
fine_heave = 1.25; // and from the initial surface up
// Over this distance the edge length grows from h to h_far; a growth of one
// fifth per unit length keeps the angles good.
transition = 5 * (h_far - h);

Point(1) = {0, 0, 0};
Point(2) = {width, 0, 0};
Point(3) = {width, depth, 0};
Point(4) = {width, depth + head_room, 0};
Point(5) = {half_width, depth + head_room, 0};
Point(6) = {half_width, depth, 0};
Point(7) = {0, depth, 0};
Line(1) = {1, 2}; // bottom
Line(2) = {2, 3}; // far, soil
Line(3) = {3, 4}; // far, air
Line(4) = {4, 5}; // lid
Line(5) = {5, 6}; // shaft
Line(6) = {6, 7}; // base of the footing
Line(7) = {7, 1}; // axis
// The initial soil surface: cells do not cross it, so the soil fills its cells
// completely at the start. Not a physical curve, as it is no boundary.
Line(8) = {3, 6};
Curve Loop(1) = {1, 2, 8, 6, 7};
Plane Surface(1) = {1};
Curve Loop(2) = {3, 4, 5, -8};
Plane Surface(2) = {2};

Field[1] = Box;
Field[1].XMin = 0;
Field[1].XMax = fine_width;
Field[1].YMin = depth - fine_depth;
Field[1].YMax = depth + fine_heave;
Field[1].ZMin = -1;
Field[1].ZMax = 1;
Field[1].VIn = h;
Field[1].VOut = h_far;
Field[1].Thickness = transition;
Field[2] = Distance;
Field[2].PointsList = {6};
Field[3] = Threshold;
Field[3].InField = 2;
Field[3].SizeMin = h_edge;
Field[3].SizeMax = h_far;
Field[3].DistMin = 2 * h_edge;
Field[3].DistMax = 2 * h_edge + 5 * (h_far - h_edge);
Field[4] = Min;
Field[4].FieldsList = {1, 3};
Background Field = 4;
If (uniform)
  Field[5] = Box;
  Field[5].XMin = 0;
  Field[5].XMax = width;
  Field[5].YMin = 0;
  Field[5].YMax = depth;
  Field[5].ZMin = -1;
  Field[5].ZMax = 1;
  Field[5].VIn = h;
  Field[5].VOut = h_far;
  Field[5].Thickness = transition;
  Field[6] = Min;
  Field[6].FieldsList = {4, 5};
  Background Field = 6;
EndIf
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm = 6; // frontal Delaunay: nearly equilateral triangles
Mesh.MshFileVersion = 2.2;

Physical Curve("bottom") = {1};
Physical Curve("far") = {2, 3};
Physical Curve("lid") = {4};
Physical Curve("shaft") = {5};
Physical Curve("footing") = {6};
Physical Curve("axis") = {7};
Physical Surface("soil") = {1};
Physical Surface("air") = {2};
