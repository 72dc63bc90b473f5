// Write surface.off with CGAL; the one that is committed is of CGAL 5.5. The surface is that of mesh_variants.py.
//
//     g++ -std=c++17 write_with_cgal.cpp -lgmp -lmpfr && ./a.out

#include <CGAL/IO/OFF/File_writer_OFF.h>

#include <fstream>
#include <vector>

int main() {
  const double points[6][3] = {{0, 0, 0}, {.25, 0, .0625}, {.25, .25, 0}, {0, .25, 0}, {.5, 0, 0}, {.5, .25, .125}};
  const std::vector<std::vector<std::size_t>> polygons{{0, 1, 2}, {0, 2, 3}, {1, 4, 5, 2}};
  std::ofstream out("surface.off", std::ios::binary);
  CGAL::File_writer_OFF writer(CGAL::File_header_OFF(true, false, false));
  writer.write_header(out, 6, 0, 3);
  for (const auto& x : points) writer.write_vertex(x[0], x[1], x[2]);
  for (const auto& polygon : polygons) {
    writer.write_facet_begin(polygon.size());
    for (const std::size_t p : polygon) writer.write_facet_vertex_index(p);
    writer.write_facet_end();
  }
  writer.write_footer();
}
