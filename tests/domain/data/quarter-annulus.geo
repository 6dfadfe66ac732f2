// gmsh -2 -order 2 -format msh22 quarter-annulus.geo -o quarter-annulus-2.2.msh   (and msh41)
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0}; Point(3) = {2, 0, 0}; Point(4) = {0, 2, 0}; Point(5) = {0, 1, 0};
Line(1) = {2, 3}; Circle(2) = {3, 1, 4}; Line(3) = {4, 5}; Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 2, 3, 4} = 3; Transfinite Surface {1}; Recombine Surface {1};
Physical Curve("flat sides") = {1, 3}; Physical Curve("outer") = {2}; Physical Curve("inner") = {4};
Physical Surface("sector") = {1};
