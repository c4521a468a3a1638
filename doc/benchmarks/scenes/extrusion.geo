// Container (x < 0, y in [0, 1]), die (x = 0, y > 0.5) and channel (x > 0); n: cells over the width of the container.
DefineConstant[ n = 16 ];
Point(1)={-2,0,0};Point(2)={0,0,0};Point(3)={2,0,0};Point(4)={2,0.5,0};Point(5)={0,0.5,0};Point(6)={0,1,0};Point(7)={-2,1,0};Point(8)={-2,0.5,0};
Line(1)={1,2};Line(2)={2,3};Line(3)={3,4};Line(4)={4,5};Line(5)={5,6};Line(6)={6,7};Line(7)={7,8};Line(8)={8,1};Line(9)={8,5};Line(10)={2,5};
Curve Loop(1)={1,10,-9,8};Plane Surface(1)={1};
Curve Loop(2)={9,5,6,7};Plane Surface(2)={2};
Curve Loop(3)={2,3,4,-10};Plane Surface(3)={3};
Transfinite Curve{3,5,7,8,10}=n/2+1;
Transfinite Curve{1,9,6,2,4}=2*n+1;
Transfinite Surface{1} Alternated;Transfinite Surface{2} Alternated;Transfinite Surface{3} Alternated;
Physical Curve("axis")={1,2};Physical Curve("die")={5};Physical Curve("wall")={6};Physical Curve("channel")={4};Physical Curve("exit")={3};Physical Curve("ram")={7,8};
Physical Surface("container")={1,2};Physical Surface("out")={3};
Mesh.MshFileVersion = 2.2;
