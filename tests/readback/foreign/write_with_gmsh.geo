// Two blocks of two materials, in three partitions:
//   gmsh write_with_gmsh.geo -3 -part 3 -format msh40 -o partitioned_40.msh
//   gmsh write_with_gmsh.geo -3 -part 3 -part_ghosts -format msh41 -o partitioned_41.msh
//   gmsh write_with_gmsh.geo -3 -part 3 -format msh41 -bin -o partitioned_41_binary.msh
Point(1) = {0, 0, 0, 2};
line[] = Extrude {1, 0, 0} { Point{1}; };
face[] = Extrude {0, 1, 0} { Line{line[1]}; };
low[] = Extrude {0, 0, 1} { Surface{face[1]}; };
high[] = Extrude {0, 0, 3} { Surface{low[0]}; };
Physical Volume("low", 10) = {low[1]};
Physical Volume("high", 20) = {high[1]};
Mesh.PartitionCreatePhysicals = 0;
