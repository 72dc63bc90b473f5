#include "core/meshes/gmsh/gmsh_elements.h"

namespace dartboard {

const GmshElement* gmsh_element(std::uint64_t type) {
  using enum CellKind;
  static const GmshElement table[] = {
      {1, 1, 2, "edge", {}},
      {2, 2, 3, "triangle", triangle},
      {3, 2, 4, "quadrilateral", quadrilateral},
      {4, 3, 4, "tetrahedron", tetrahedron},
      {5, 3, 8, "hexahedron", hexahedron},
      {6, 3, 6, "prism", prism},
      {7, 3, 5, "pyramid", pyramid},
      {8, 1, 3, "3-node edge", {}},
      {9, 2, 6, "6-node triangle", triangle},
      {10, 2, 9, "9-node quadrilateral", quadrilateral},
      {11, 3, 10, "10-node tetrahedron", tetrahedron},
      {12, 3, 27, "27-node hexahedron", hexahedron},
      {13, 3, 18, "18-node prism", prism},
      {14, 3, 14, "14-node pyramid", pyramid},
      {15, 0, 1, "point", {}},
      {16, 2, 8, "8-node quadrilateral", quadrilateral},
      {17, 3, 20, "20-node hexahedron", hexahedron},
      {18, 3, 15, "15-node prism", prism},
      {19, 3, 13, "13-node pyramid", pyramid},
      {20, 2, 9, "9-node triangle", triangle},
      {21, 2, 10, "10-node triangle", triangle},
      {22, 2, 12, "12-node triangle", triangle},
      {23, 2, 15, "15-node triangle", triangle},
      {24, 2, 15, "15-node triangle", triangle},
      {25, 2, 21, "21-node triangle", triangle},
      {26, 1, 4, "4-node edge", {}},
      {27, 1, 5, "5-node edge", {}},
      {28, 1, 6, "6-node edge", {}},
      {29, 3, 20, "20-node tetrahedron", tetrahedron},
      {30, 3, 35, "35-node tetrahedron", tetrahedron},
      {31, 3, 56, "56-node tetrahedron", tetrahedron},
      {92, 3, 64, "64-node hexahedron", hexahedron},
      {93, 3, 125, "125-node hexahedron", hexahedron},
  };
  for (const auto& element : table)
    if (element.type == type) return &element;
  return nullptr;
}

}  // namespace dartboard
