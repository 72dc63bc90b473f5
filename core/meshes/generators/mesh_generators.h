#pragma once
// The meshes shared by scenes, tests, validation and benchmarks. Lengths in metres.
//
// Coordinates come from +, -, *, / and sqrt alone, all rounded correctly by IEEE 754, and random numbers from
// whole-number arithmetic: a mesh has the same bits on every platform (as long as nothing fuses a*b+c,
// core/cmake/DartboardOptions.cmake). Volumes are right-handed; surfaces that can be oriented are, and closed ones
// outwards.
//
// Every generator throws InputError for a number below the least that its comment names.

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "core/plain/mesh.h"
#include "core/plain/random.h"

namespace dartboard {

// ---- boxes: nx x ny x nz cubes of edge `spacing`, corner at the origin; nx, ny, nz >= 1, 0 < spacing < infinity

/// Six tetrahedra per cube around its diagonal in direction (1, 1, 1); a cube's are neighbours in `cells`.
///
/// Points inside the box are moved at random by at most jitter * spacing; those of its surface stay. One after another,
/// a move is halved until every tetrahedron around the point has at least a tenth of its first volume, so nothing
/// inverts for any jitter >= 0. Up to 0.3 hardly any move is halved (0 of 6,859 in a probe; 489 at 0.5): two opposite
/// edges of each tetrahedron, the two that are face diagonals, are 1/sqrt(3) spacings apart, and no altitude is
/// shorter, so four moves below half of that, 0.288..., cannot flatten it.
Mesh kuhn_box(int nx, int ny, int nz, double spacing, double jitter = 0, std::uint64_t seed = 0);

/// A Kuhn box with every second cube along x, along y and along z as a mirror image of its neighbours, which share the
/// diagonals of their faces for any counts. For even counts the box is its own mirror image and has no direction.
///
/// Every inner edge has an even number of tetrahedra around it; elements of such a mesh hardly lock.
Mesh mirrored_box(int nx, int ny, int nz, double spacing, double jitter = 0, std::uint64_t seed = 0);

Mesh hexahedron_box(int nx, int ny, int nz, double spacing);

/// Hexahedra, prisms, pyramids and tetrahedra, face to face; all four kinds when nx * ny >= 2 and nz >= 2.
///
/// Where x + y is even the layers alternate between one hexahedron and six pyramids around the centre of the cube.
/// Where it is odd the horizontal faces are cut along a diagonal, and the layers alternate between two prisms and four
/// pyramids with two tetrahedra below and two above.
Mesh mixed_box(int nx, int ny, int nz, double spacing);

// ---- surfaces

/// nx x ny squares in the plane z = 0, each cut into two triangles; nx, ny >= 1.
Mesh triangle_sheet(int nx, int ny, double spacing);
Mesh quad_sheet(int nx, int ny, double spacing);

/// nu x nv quadrilaterals around a torus of radii 2 and 1; nu, nv >= 3.
Mesh torus_surface(int nu, int nv);

/// n quadrilaterals around a circle of radius 2, half a turn in all; n >= 3.
Mesh moebius_strip(int n);

/// nu x nv quadrilaterals, nu around and nv across a figure of eight that makes half a turn; nu, nv >= 3. The surface
/// passes through itself, as it must in space; no two of its points coincide.
Mesh klein_bottle(int nu, int nv);

/// The unit sphere: an octahedron whose triangles are quartered `subdivisions` times, 0 <= subdivisions <= 12.
Mesh octasphere(int subdivisions);

// ---- solids of tetrahedra

Mesh empty_mesh();
Mesh one_tetrahedron();
/// Sharing a face.
Mesh two_tetrahedra();
/// Sharing one edge, or one point, of the mesh and no face: in the map they are two components without a common cell.
Mesh touching_at_edge();
Mesh touching_at_vertex();

/// A ring of n blocks of six tetrahedra; n >= 3.
Mesh solid_torus(int n);

/// Fig. 3b: a drum around point 0, a ring of 2 * sides tetrahedra joined by faces, without the cones above and below;
/// sides >= 3. With three sides it is an octahedron that has lost two opposite octants.
///
/// The other pinch, two solids that meet in a point only, is no pinch for a map: it has two vertices there. Here the
/// tetrahedra around point 0 are connected by faces, so it is one vertex, whose link is a ring (Euler characteristic 0)
/// and neither a sphere (2) nor a disc (1).
Mesh pinched_body(int sides = 3);

/// Component i = 0 .. k-1 is a kuhn_box of 1 x 1 x (i + 1) unit cubes; k >= 0.
Mesh several_components(int k);

/// 8 layers^3 tetrahedra in a ball around the origin, layers >= 1, 0 < radius < infinity.
///
/// The octahedron |x| + |y| + |z| <= layers is cut along the planes of its layers, octant by octant, into tetrahedra
/// and octahedra, these into four tetrahedra around their shortest diagonal; then each layer is projected onto a
/// sphere. No cell has two faces on the surface, which would flatten it. Volumes lie between 0.32 and 1.9 times the
/// mean, and the shape 12 (3 V)^(2/3) / (sum of squared edges), 1 for a regular tetrahedron, above 0.69 (12 layers).
Mesh tetrahedron_ball(int layers, double radius);

// ---- all of them

struct NamedMesh {
  std::string name;  // as in a file name
  std::string what;  // one line for a reader
  std::function<Mesh()> make;
};

/// One or more of each of the above, of 0 to 2,000 cells.
std::span<const NamedMesh> test_meshes();

}  // namespace dartboard
