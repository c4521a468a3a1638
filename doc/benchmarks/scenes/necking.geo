// One half of Simo's round bar; n: cells over its radius.
DefineConstant[ n = 10 ];

R=6.413;L=26.667;
Point(1)={0,0,0};Point(2)={0.982*R,0,0};Point(3)={R,L,0};Point(4)={0,L,0};
Line(1)={1,2};Line(2)={2,3};Line(3)={3,4};Line(4)={4,1};Curve Loop(1)={1,2,3,4};Plane Surface(1)={1};
Transfinite Curve{1,3}=n+1;Transfinite Curve{2}=4*n+1 Using Progression 1.04^(10/n);Transfinite Curve{4}=4*n+1 Using Progression 1/1.04^(10/n);
Transfinite Surface{1} Alternated;
Physical Curve("bottom")={1};Physical Curve("side")={2};Physical Curve("top")={3};Physical Curve("axis")={4};Physical Surface("bar")={1};
Mesh.MshFileVersion = 2.2;
