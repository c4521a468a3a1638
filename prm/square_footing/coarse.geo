// Isochor, SPDX-License-Identifier: LGPL-2.1-or-later
//
// Coarse hexahedra for adaptive.prm, a quarter of the ground below a square
// footing of width B = 1 m:
//   gmsh -3 coarse.geo -o square_footing_coarse.msh
// level  how often they are halved where cells are smallest. The last nodes of
//        the base lie half of such a cell inside its edge, see prm/prandtl
// y points upwards, the surface is y = 0.
DefineConstant[ level = {2, Min 0, Max 8, Name "level"} ];
width = 2.5;
depth = 2;
b     = 0.5 / (1 + 0.5 / 2^level); // half the base
n_far = 4;                         // cells beside it, and below
Point(1) = {0, -depth, 0};
x[] = Extrude {b, 0, 0} { Point{1}; Layers{1}; Recombine; };
y[] = Extrude {width - b, 0, 0} { Point{x[0]}; Layers{n_far}; Recombine; };
p[] = Extrude {0, 0, b} { Line{x[1], y[1]}; Layers{1}; Recombine; };
q[] = Extrude {0, 0, width - b} { Line{p[0], p[4]}; Layers{n_far}; Recombine; };
v[] = Extrude {0, depth, 0} { Surface{p[1], p[5], q[1], q[5]}; Layers{n_far}; Recombine; };
Mesh.MshFileVersion = 2.2;

e = 1e-6;
Physical Surface("footing") = Surface In BoundingBox {-e, -e, -e, b + e, e, b + e};
top[] = Surface In BoundingBox {-e, -e, -e, width + e, e, width + e};
top[] -= Surface In BoundingBox {-e, -e, -e, b + e, e, b + e};
Physical Surface("surface") = top[];
Physical Surface("bottom") = Surface In BoundingBox {-e, -depth - e, -e, width + e, -depth + e, width + e};
Physical Surface("front") = Surface In BoundingBox {-e, -depth - e, -e, width + e, e, e};
Physical Surface("left") = Surface In BoundingBox {-e, -depth - e, -e, e, e, width + e};
Physical Surface("far x") = Surface In BoundingBox {width - e, -depth - e, -e, width + e, e, width + e};
Physical Surface("far z") = Surface In BoundingBox {-e, -depth - e, width - e, width + e, e, width + e};
Physical Volume("ground") = {Volume{:}};
