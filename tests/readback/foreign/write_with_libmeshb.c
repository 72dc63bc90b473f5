/* Write solid_1.meshb to solid_4.meshb with libMeshb: cc -w write_with_libmeshb.c libmeshb7.c, with its header. Those that
   are committed are of its commit 88095d5. The solid is that of mesh_variants.py, with a step of 1/4. */
#include <stdint.h>
#include <stdio.h>

#include "libmeshb7.h"

/* Version 4 wants numbers of 64 bits, the others of 32. */
#define LINE(keyword, ...) \
  (version == 4 ? GmfSetLin(file, keyword, MAP_WIDE(__VA_ARGS__)) : GmfSetLin(file, keyword, __VA_ARGS__))
#define W(x) ((int64_t)(x))
#define PICK(_1, _2, _3, _4, _5, _6, _7, _8, _9, NAME, ...) NAME
#define MAP_WIDE(...) PICK(__VA_ARGS__, W9, W8, W7, W6, W5, W4, W3, W2, W1)(__VA_ARGS__)
#define W1(a) W(a)
#define W2(a, ...) W(a), W1(__VA_ARGS__)
#define W3(a, ...) W(a), W2(__VA_ARGS__)
#define W4(a, ...) W(a), W3(__VA_ARGS__)
#define W5(a, ...) W(a), W4(__VA_ARGS__)
#define W6(a, ...) W(a), W5(__VA_ARGS__)
#define W7(a, ...) W(a), W6(__VA_ARGS__)
#define W8(a, ...) W(a), W7(__VA_ARGS__)
#define W9(a, ...) W(a), W8(__VA_ARGS__)

int main(void) {
  static const double x[13][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1},   {1, 0, 1},   {1, 1, 1},
                                  {0, 1, 1}, {2, 0, 0}, {2, 0, 1}, {.5, .5, 2}, {.5, -1, 2}, {.5, -2, 1}};
  for (int version = 1; version <= 4; ++version) {
    char name[32];
    snprintf(name, sizeof name, "solid_%d.meshb", version);
    const int64_t file = GmfOpenMesh(name, GmfWrite, version, 3);
    GmfSetKwd(file, GmfVertices, (int64_t)13);
    for (int p = 0; p < 13; ++p) {
      const double a = x[p][0] / 4 + .125, b = x[p][1] / 4 - .5, c = x[p][2] / 4 + 1000;
      version == 4 ? GmfSetLin(file, GmfVertices, a, b, c, W(0)) : GmfSetLin(file, GmfVertices, a, b, c, 0);
    }
    GmfSetKwd(file, GmfHexahedra, (int64_t)1);
    LINE(GmfHexahedra, 1, 2, 3, 4, 5, 6, 7, 8, 7);
    GmfSetKwd(file, GmfPrisms, (int64_t)1);
    LINE(GmfPrisms, 2, 9, 3, 6, 10, 7, -3);
    GmfSetKwd(file, GmfPyramids, (int64_t)1);
    LINE(GmfPyramids, 5, 6, 7, 8, 11, 7);
    GmfSetKwd(file, GmfTetrahedra, (int64_t)2);
    LINE(GmfTetrahedra, 5, 6, 11, 12, 7);
    LINE(GmfTetrahedra, 5, 6, 12, 13, 8);
    GmfSetKwd(file, GmfCorners, (int64_t)1);
    LINE(GmfCorners, 1);
    GmfCloseMesh(file);
  }
  return 0;
}
