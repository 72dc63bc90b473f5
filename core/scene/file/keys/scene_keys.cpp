#include "core/scene/file/keys/scene_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/plain/material.h"
#include "core/time/integrators.h"

namespace dartboard {
namespace {

constexpr Range positive{.least = 0.0, .above = true};
constexpr Range not_negative{.least = 0.0};
constexpr Range number{.least = 0.0, .most = 4294967294.0};  // of a point, cell or dart; 2^32 - 1 means none
constexpr Range exact_integer{.least = 0.0,
                              .most = 9007199254740991.0};  // 2^53 - 1: every reader of JSON has it exactly
constexpr Range count_from_1{.least = 1.0, .most = 4294967294.0};

template <class Entry>
std::vector<std::string> names_of(std::span<const Entry> entries) {
  std::vector<std::string> names;
  for (const Entry& entry : entries) names.emplace_back(entry.name);
  return names;
}

std::vector<SceneKey> keys_by_hand() {
  using enum Shape;
  using enum ValueType;
  // a row of the table in one or two lines
  // clang-format off
  return {
      // ---- the scene
      {.shape = scene, .name = "name", .type = text, .required = true, .help = "what the scene is called"},
      {.shape = scene, .name = "about", .type = text, .standard = "\"\"", .help = "a sentence for readers"},
      {.shape = scene, .name = "body", .type = object, .of = body, .help = "the body at rest"},
      {.shape = scene, .name = "bodies", .type = objects, .of = one_body,
       .help = "several bodies at rest, in place of one; nothing holds them together, and they pass through each other unless "
               "/contact says otherwise. "
               "What is selected in them is selected by place or by tag, not by number"},
      {.shape = scene, .name = "material", .type = object, .of = material, .standard = "{}",
       .help = "the material of the body"},
      {.shape = scene, .name = "regions", .type = objects, .of = region, .standard = "[]",
       .help = "cells of another material; for a cell in several regions, the last counts"},
      {.shape = scene, .name = "diagonals", .type = choice, .choices = {"none", "faces", "volumes", "all"},
       .standard = "\"none\"",
       .help = "springs between corners of one cell that no edge joins: across faces of four corners, through the volume of "
               "hexahedra, or both. Each cell has its own, of the material's stiffness, undamped. They hold the shape of "
               "hexahedra, prisms, pyramids and quadrilaterals, which edges alone do not (those through the volume alone "
               "do not either); with 'young' in the material, cubes then are an elastic solid of Poisson's ratio 1/4, "
               "squares a sheet of 1/3. Cells made of elements have no diagonals"},
      {.shape = scene, .name = "gravity", .type = point, .unit = "m/s^2", .standard = "[0, 0, -9.81]",
       .help = "acceleration of gravity"},
      {.shape = scene, .name = "initial_velocity", .type = point_or_object, .of = velocity, .unit = "m/s",
       .standard = "[0, 0, 0]", .help = "velocity at the start, one for all vertices or linear in their place; not above "
                                        "that of light"},
      {.shape = scene, .name = "fixed", .type = objects, .of = held, .standard = "[]",
       .help = "vertices held still or along some axes, by where they are at rest: those in any of the selections"},
      {.shape = scene, .name = "driven", .type = objects, .of = driven, .standard = "[]",
       .help = "vertices that are moved along, whatever acts on them"},
      {.shape = scene, .name = "forces", .type = objects, .of = force, .standard = "[]",
       .help = "forces from outside on some of the vertices"},
      {.shape = scene, .name = "contact", .type = object, .of = contact,
       .help = "contact of bodies with obstacles, with each other and with themselves; of chains with obstacles. "
               "Without it bodies pass through each other and through themselves"},
      {.shape = scene, .name = "step", .type = real, .unit = "s", .range = positive, .help = "time step"},
      {.shape = scene, .name = "accuracy", .type = real, .unit = "mean edge lengths", .range = positive,
       .help = "error of the positions that is allowed: the root mean square over the mass, at the time at which it is "
               "largest; single vertices may be several times farther off. The step is chosen for it, and the integrator "
               "if it is not named, by whole runs where there is contact or a load changes in time; events happen at "
               "their exact times, unless loads begin or end. The choice rests on timings: it may differ from machine to "
               "machine and from run to run, and the hash with it; 'simulate' prints the keys that settle it"},
      {.shape = scene, .name = "duration", .type = real, .unit = "s", .range = not_negative, .required = true,
       .help = "time to simulate; the run ends at the first multiple of the step that is not before it"},
      {.shape = scene, .name = "integrator", .type = choice, .choices = names_of(integrators()),
       .help = "how the equations of motion are integrated; left out, 'rk4', or with an accuracy the cheapest that is "
               "expected to meet it"},
      {.shape = scene, .name = "solver", .type = choice, .choices = names_of(linear_solvers()),
       .help = "how an implicit integrator solves its linear systems: with a factor that is kept for as long as it "
               "serves, which is the cheapest as a rule and what it does where this is left out; with a new one for each "
               "system, the most robust; or without, by conjugate gradients, which takes the least memory"},
      {.shape = scene, .name = "unstable_step", .type = choice, .choices = {"warn", "refuse", "substep"},
       .standard = "\"warn\"", .help = "what is done about a step that is too long to be stable, at the start and after "
                                       "each event: say so, refuse the scene (after an event: stop), or divide it"},
      {.shape = scene, .name = "events", .type = objects, .of = event, .standard = "[]",
       .help = "what happens to the body, by time; those due at one time happen in this order"},
      {.shape = scene, .name = "event_times", .type = choice, .choices = {"steps", "exact"}, .standard = "\"steps\"",
       .help = "when events happen: at the first multiple of the step that is not before their time, which is cheap and "
               "leaves an error of the order of the step; or at that very time, up to which a shorter step is taken and "
               "another from there, so that the integrator keeps its order through them. Steps are divided alike where "
               "a force or a drive begins, turns back or ends, or its table has a time; with whole steps it acts as its "
               "mean over the step"},
      {.shape = scene, .name = "sleep", .type = object, .of = sleep,
       .help = "when a component that has come to rest is no longer stepped; not with an accuracy. Without it all "
               "components are stepped to the end"},
      {.shape = sleep, .name = "speed", .type = real, .unit = "m/s", .range = positive, .required = true,
       .help = "the component is at rest while no vertex of it is faster than this; speed^2 / 2 is the largest kinetic "
               "energy per kg that is removed each time"},
      {.shape = sleep, .name = "time", .type = real, .unit = "s", .range = positive, .required = true,
       .help = "the component has to be at rest for this long before it is put to sleep: at least one step, and more "
               "than 2 speed / gravity, since a body that is thrown upwards is slower for that long at the top of its "
               "flight"},
      {.shape = scene, .name = "output", .type = object, .of = output, .standard = "{}", .help = "what is recorded"},
      {.shape = scene, .name = "expect", .type = object, .of = expect, .standard = "{}",
       .help = "what must be true at the end, so that the scene is its own test"},
      {.shape = scene, .name = "$schema", .type = text, .standard = "\"\"",
       .help = "where an editor finds the schema of scenes ('dartboard scene --schema' prints it); nothing reads it here"},

      // ---- the body
      {.shape = body, .name = "mesh", .type = text, .help = "mesh file, relative to the scene file"},
      {.shape = body, .name = "generate", .type = object, .of = generate, .help = "a mesh made on the spot"},
      {.shape = body, .name = "scale", .type = real, .range = positive, .standard = "1",
       .help = "factor on all coordinates, applied first"},
      {.shape = body, .name = "rotate", .type = object, .of = rotation,
       .help = "turned about an axis through the origin, after scaling"},
      {.shape = body, .name = "translate", .type = point, .unit = "m", .standard = "[0, 0, 0]",
       .help = "added to all points, after scaling and turning"},
      {.shape = rotation, .name = "axis", .type = point, .required = true, .help = "of any length but 0"},
      {.shape = rotation, .name = "degrees", .type = real, .required = true,
       .help = "the angle; with the thumb of the right hand along the axis, the fingers show which way"},
      {.shape = body, .name = "touching", .type = choice, .choices = {"split", "refuse"}, .standard = "\"split\"",
       .help = "what is done where cells of a mesh file touch in a point or an edge without sharing a face: nothing holds "
               "them together there, and a point becomes as many vertices as it has groups of cells; or the scene is "
               "refused"},
      {.shape = body, .name = "weld", .type = real, .range = positive,
       .help = "points of a mesh file that are at most this far apart, in its units, before scaling, become one: the seam "
               "between them is closed; each of their numbers stands for it. Refused where two corners of a cell would "
               "be one"},
      {.shape = generate, .name = "box", .type = object, .of = box_mesh, .help = "a box with a corner at the origin"},
      {.shape = generate, .name = "sheet", .type = object, .of = sheet_mesh,
       .help = "a rectangle in the plane z = 0 with a corner at the origin"},
      {.shape = generate, .name = "ball", .type = object, .of = ball_mesh,
       .help = "a ball of tetrahedra around the origin"},
      {.shape = generate, .name = "chain", .type = object, .of = chain_mesh,
       .help = "a row of point masses and springs along x from the origin"},
      {.shape = box_mesh, .name = "cells", .type = integer_triple, .range = {1, 10000}, .required = true,
       .help = "cubes along x, y and z"},
      {.shape = box_mesh, .name = "spacing", .type = real, .unit = "m", .range = positive, .required = true,
       .help = "edge of a cube"},
      {.shape = box_mesh, .name = "kind", .type = choice, .choices = {"tetrahedra", "hexahedra", "mixed"},
       .standard = "\"tetrahedra\"", .help = "six tetrahedra per cube, one hexahedron, or all kinds of cell"},
      {.shape = box_mesh, .name = "pattern", .type = choice, .choices = {"mirrored", "kuhn"},
       .standard = "\"mirrored\"",
       .help = "how cubes are cut into tetrahedra: each as the mirror image of its neighbours, which for even counts gives the body no direction, or all alike, around their diagonals along (1, 1, 1), which gives it that one"},
      {.shape = box_mesh, .name = "jitter", .type = real, .range = {0.0, 0.5}, .standard = "0",
       .help = "random moves of the inner points, in spacings; for tetrahedra only"},
      {.shape = box_mesh, .name = "seed", .type = integer, .range = exact_integer, .standard = "0",
       .help = "seed of the random moves"},
      {.shape = sheet_mesh, .name = "cells", .type = integer_pair, .range = {1, 100000}, .required = true,
       .help = "squares along x and y"},
      {.shape = sheet_mesh, .name = "spacing", .type = real, .unit = "m", .range = positive, .required = true,
       .help = "edge of a square"},
      {.shape = sheet_mesh, .name = "kind", .type = choice, .choices = {"triangles", "quadrilaterals"},
       .standard = "\"triangles\"", .help = "two triangles per square, or one quadrilateral"},
      {.shape = ball_mesh, .name = "layers", .type = integer, .range = {1, 256}, .required = true,
       .help = "layers of tetrahedra from the centre to the surface: 8 layers^3 tetrahedra in all; a map has room for "
               "2^27"},
      {.shape = ball_mesh, .name = "radius", .type = real, .unit = "m", .range = positive, .required = true,
       .help = "radius of the ball; the points of its surface lie on it"},
      {.shape = chain_mesh, .name = "links", .type = integer, .range = {1, 1000000}, .required = true,
       .help = "springs; there is one point mass more"},
      {.shape = chain_mesh, .name = "spacing", .type = real, .unit = "m", .range = positive, .required = true,
       .help = "length of a link at rest"},

      // ---- what it is made of and how it moves
      {.shape = material, .name = "density", .type = real, .unit = "kg/m^3", .range = positive, .standard = "1000",
       .help = "mass per volume; of a surface, per area [kg/m^2]; of a chain, per length [kg/m], half of a link's at each "
               "end"},
      {.shape = material, .name = "stiffness", .type = real, .unit = "N/m", .range = not_negative, .standard = "50",
       .help = "stiffness of the spring that a cell contributes to each of its edges; in a chain, of a link"},
      {.shape = material, .name = "young", .type = real, .unit = "Pa", .range = positive,
       .help = "Young's modulus, in place of a stiffness: a tetrahedron of volume V gives its edge of length l the "
               "stiffness young V / l^2, so that a finer mesh of the same body sags the same. Its springs then have "
               "Poisson's ratio 1/4, where tetrahedra are well shaped, whatever the material has. Of a surface of triangles "
               "[N/m], with their areas and the ratio 1/3; of a chain [N], young / l. Other cells have no such springs. The "
               "damping is then a mean over the edges of all cells, shared out as the stiffness is"},
      {.shape = material, .name = "poisson", .type = real, .range = {.least = -0.99, .most = 0.4999},
       .help = "Poisson's ratio of elements, which resist in place of springs; 'young' is given together with it. "
               "Solid cells of all kinds have them; hexahedra bend four times as truly as tetrahedra of as many nodes. Surfaces are membranes "
               "in plane stress, 'young' being Young's modulus times the thickness [N/m], which resist their bending only "
               "by what /bending says. All solids are too stiff above "
               "some 0.45"},
      {.shape = material, .name = "model", .type = choice,
       .choices = {model_names.begin(), model_names.end()},
       .help = "what resists deformation: springs, or elements of an elastic law: stable neo-Hookean (smooth, also where it "
               "is turned inside out), corotational (linear elasticity that turns with the material) or St. "
               "Venant-Kirchhoff; surfaces have the latter two. Without it, where there is a 'poisson', stvk in a surface and "
               "neo-hookean in a solid, and springs otherwise"},
      {.shape = material, .name = "damping", .type = real_or_object, .of = damping, .unit = "N s/m",
       .range = not_negative, .standard = "0.01",
       .help = "damping that a cell contributes to each of its edges; in a chain, that of a link. Solid elements "
               "take an object, a damping ratio at a frequency, and have no damping without it"},
      {.shape = damping, .name = "ratio", .type = real, .range = not_negative, .required = true,
       .help = "damping ratio zeta of an oscillation of that frequency: its amplitude falls by exp(-2 pi zeta / sqrt(1 - "
               "zeta^2)) in a period. Of others it is in proportion to their frequency"},
      {.shape = damping, .name = "frequency", .type = real, .unit = "Hz", .range = positive, .required = true,
       .help = "where the ratio is that"},
      {.shape = material, .name = "width", .type = real, .unit = "m", .range = positive,
       .help = "of a chain beside /contact/obstacles: its links touch them as strips of this width do"},
      {.shape = material, .name = "viscosity", .type = real, .unit = "1/s", .range = not_negative, .standard = "0.1",
       .help = "ambient drag over mass and velocity"},
      {.shape = region, .name = "cells", .type = object, .of = cell_selection, .required = true,
       .help = "which, at rest; not at random"},
      {.shape = region, .name = "material", .type = object, .of = tissue, .required = true,
       .help = "their material: nothing of it is taken from the body's"},
      {.shape = one_body, .name = "material", .type = object, .of = tissue,
       .help = "its material; left out, what the scene's 'material' says"},
      {.shape = one_body, .name = "initial_velocity", .type = point_or_object, .of = velocity, .unit = "m/s",
       .help = "at the start; left out, what the scene's says"},
      {.shape = velocity, .name = "constant", .type = point, .unit = "m/s", .standard = "[0, 0, 0]",
       .help = "velocity at the centre"},
      {.shape = velocity, .name = "linear", .type = matrix, .unit = "1/s",
       .standard = "[[0, 0, 0], [0, 0, 0], [0, 0, 0]]", .help = "velocity gradient, row by row: a spin, a stretch"},
      {.shape = velocity, .name = "centre", .type = point, .unit = "m", .standard = "[0, 0, 0]",
       .help = "where the linear part is zero"},

      // ---- selections
      {.shape = vertex_selection, .name = "ids", .type = integers, .range = number,
       .help = "these points of the mesh, counted from 0 in the order of the file"},
      {.shape = vertex_selection, .name = "box", .type = object, .of = box, .help = "the vertices in a box at rest"},
      {.shape = vertex_selection, .name = "plane", .type = object, .of = plane,
       .help = "the vertices that at rest are on a plane or on the side that its normal points to"},
      {.shape = vertex_selection, .name = "sphere", .type = object, .of = sphere,
       .help = "the vertices in a sphere at rest"},
      {.shape = vertex_selection, .name = "around", .type = object, .of = around,
       .help = "the vertices that at rest are near a path, or near what a blade sweeps"},
      {.shape = held, .name = "axes", .type = choices, .least_size = 1, .choices = {"x", "y", "z"},
       .standard = "[\"x\", \"y\", \"z\"]",
       .help = "along which they are held; along the others they move freely. [\"x\"] makes a symmetry plane across x, "
               "[\"y\", \"z\"] a rail along x. What several selections hold adds up"},
      {.shape = driven, .name = "velocity", .type = point_or_object, .of = velocity, .unit = "m/s",
       .help = "that they keep, one for all or linear in their place at rest"},
      {.shape = driven, .name = "path", .type = objects, .of = driven_place,
       .help = "or the places that all of them go through together, straight from one to the next, as ascending times; "
               "before and after they are held still"},
      {.shape = driven, .name = "turn", .type = object, .of = driven_turn,
       .help = "or how they are turned about an axis, from where they are at rest"},
      {.shape = driven, .name = "from", .type = real, .unit = "s", .range = not_negative, .standard = "0",
       .help = "time they start at; they are held still before"},
      {.shape = driven, .name = "until", .type = real, .unit = "s", .range = positive,
       .help = "time they stop at, and are held still from; left out, they move to the end"},
      {.shape = driven, .name = "reverse_every", .type = real, .unit = "s", .range = positive,
       .help = "time after which they turn round, again and again; left out, never"},
      {.shape = driven_place, .name = "at", .type = real, .unit = "s", .range = not_negative, .required = true,
       .help = "when"},
      {.shape = driven_place, .name = "place", .type = point, .unit = "m", .required = true,
       .help = "where; only the way from the first place counts, where they are at rest"},
      {.shape = driven_turn, .name = "axis", .type = point, .required = true,
       .help = "direction of the axis; its length does not count"},
      {.shape = driven_turn, .name = "centre", .type = point, .unit = "m", .required = true,
       .help = "a place on the axis"},
      {.shape = driven_turn, .name = "angles", .type = objects, .of = driven_angle, .required = true,
       .help = "linear in time between one and the next, with ascending times; only the turn from the first angle counts"},
      {.shape = driven_angle, .name = "at", .type = real, .unit = "s", .range = not_negative, .required = true,
       .help = "when"},
      {.shape = driven_angle, .name = "degrees", .type = real, .required = true,
       .help = "anticlockwise seen from where the axis points to"},
      {.shape = force, .name = "force", .type = point, .unit = "N", .help = "on all of them together"},
      {.shape = force, .name = "traction", .type = point, .unit = "Pa",
       .help = "in this direction, on faces whose corners are all selected: of solids those of the boundary, as the mesh "
               "has them; 'on' edges [N/m]"},
      {.shape = force, .name = "on", .type = choice, .choices = {"vertices", "faces", "edges"},
       .help = "what shares a 'force': vertices, in proportion to their masses, as with weight; or the faces of the "
               "boundary whose corners are all selected, in proportion to their areas, or likewise the edges on the "
               "border of a surface, to their lengths, and the corners of each as its shape functions do, so that a "
               "plane end is loaded evenly. Left out, vertices; of a 'traction', faces"},
      {.shape = force, .name = "pressure", .type = real, .unit = "Pa",
       .help = "on the faces of the boundary whose corners are all selected, inwards along their 'normals'; "
               "of a surface [N/m^2] on all such faces, against the normal that their order of corners gives them"},
      {.shape = force, .name = "normals", .type = choice, .choices = {"at rest", "current"}, .standard = "\"at rest\"",
       .help = "those that a 'pressure' acts along: as the mesh has them; or those of the faces as they move, on their "
               "current areas: exact at every time for every integrator. Faces stay under it whatever is cut around them, and go with "
               "their cells; faces that a cut exposes are not under it"},
      {.shape = force, .name = "acceleration", .type = point, .unit = "m/s^2",
       .help = "of each of them, as gravity has it: gravity that changes in time, or a frame that is accelerated"},
      {.shape = force, .name = "torque", .type = point, .unit = "N m",
       .help = "on all of them together: forces that add up to nothing, as of a turn about their centre of mass at rest. "
               "Their directions stay while the body turns, so the moment is this one for small turns"},
      {.shape = force, .name = "over_time", .type = objects, .of = force_factor,
       .help = "factors by which it is multiplied, linear between one and the next, with ascending times; constant before "
               "the first and after the last. In each step a force is constant, its mean over the step: motions under it "
               "are of second order in the step at most, with 'bdf2' of first. Left out, 1"},
      {.shape = force_factor, .name = "at", .type = real, .unit = "s", .range = not_negative, .required = true,
       .help = "when"},
      {.shape = force_factor, .name = "factor", .type = real, .required = true, .help = "of the force then"},
      {.shape = force, .name = "from", .type = real, .unit = "s", .range = not_negative, .standard = "0",
       .help = "time it begins at"},
      {.shape = force, .name = "until", .type = real, .unit = "s", .range = positive,
       .help = "time it ends at; left out, it lasts to the end"},
      {.shape = contact, .name = "pressure", .type = real, .unit = "Pa", .range = positive, .required = true,
       .help = "that a contact carries at the depth; it grows with the depth to the power exponent - 1"},
      {.shape = contact, .name = "depth", .type = real, .unit = "m", .range = positive, .required = true,
       .help = "how far surfaces may come into obstacles and bodies under that pressure: a run is warned where one is "
               "deeper"},
      {.shape = contact, .name = "exponent", .type = integer, .range = {2, 4}, .standard = "3",
       .help = "exponent of the depth in the energy of a contact: integrators are of no higher order than it"},
      {.shape = contact, .name = "restitution", .type = real, .range = {.least = 0.0, .most = 1.0, .above = true},
       .standard = "1", .help = "share of the normal speed of each place left after a bounce, at any speed and for any mass; a body that "
               "is soft against its contact vibrates, and may be left more or less"},
      {.shape = contact, .name = "friction", .type = real, .range = not_negative, .standard = "0",
       .help = "Coulomb's coefficient, of sticking and of sliding"},
      {.shape = contact, .name = "obstacles", .type = objects, .of = obstacle, .standard = "[]",
       .help = "the obstacles of bodies"},
      {.shape = contact, .name = "bodies", .type = choice, .choices = {"none", "others", "themselves", "all"},
       .standard = "\"none\"",
       .help = "which bodies each of them touches: none, the others, itself (where it folds, and what a cut or a tear "
               "leaves of it), or all of these. Solids alone do, surfaces touch obstacles only; not with the integrator "
               "'energy-momentum'"},
      {.shape = contact, .name = "pairs", .type = objects, .of = contact_pair, .standard = "[]",
       .help = "pairs of bodies for which something else holds than 'bodies' says, or another law"},
      {.shape = contact_pair, .name = "of", .type = integer_pair, .range = number, .required = true,
       .help = "two of /bodies, counted from 0; one twice is that body with itself"},
      {.shape = contact_pair, .name = "touch", .type = choice, .choices = {"yes", "no"}, .standard = "\"yes\"",
       .help = "whether they do"},
      {.shape = obstacle, .name = "plane", .type = object, .of = plane,
       .help = "all that is behind a plane: its normal points out of the obstacle"},
      {.shape = obstacle, .name = "sphere", .type = object, .of = sphere, .help = "a ball, of a radius above 0"},
      {.shape = obstacle, .name = "box", .type = object, .of = box,
       .help = "a box with faces across the axes; what is inside is driven out through the nearest face. Boxes that touch "
               "or overlap are one solid, and what stands on a plane has no face there"},
      {.shape = obstacle, .name = "velocity", .type = point, .unit = "m/s", .standard = "[0, 0, 0]",
       .help = "that it moves at, whatever it runs into; it never turns"},
      {.shape = obstacle, .name = "from", .type = real, .unit = "s", .range = not_negative, .standard = "0",
       .help = "time it starts to move at, from the place that is given"},
      {.shape = obstacle, .name = "until", .type = real, .unit = "s", .range = positive,
       .help = "time it stops at; left out, it moves to the end"},
      {.shape = obstacle, .name = "pressure", .type = real, .unit = "Pa", .range = positive,
       .help = "here; left out, that of /contact"},
      {.shape = obstacle, .name = "depth", .type = real, .unit = "m", .range = positive,
       .help = "here; left out, that of /contact"},
      {.shape = obstacle, .name = "restitution", .type = real, .range = {.least = 0.0, .most = 1.0, .above = true},
       .help = "here; left out, that of /contact"},
      {.shape = obstacle, .name = "friction", .type = real, .range = not_negative,
       .help = "here; left out, that of /contact"},
      {.shape = cell_selection, .name = "ids", .type = integers, .range = number,
       .help = "these cells of the mesh, counted from 0 in the order of the file, as far as they are still there"},
      {.shape = cell_selection, .name = "box", .type = object, .of = box,
       .help = "the cells with their centroid in a box, where they are at that time"},
      {.shape = cell_selection, .name = "plane", .type = object, .of = plane,
       .help = "the cells with their centroid on a plane or on the side that its normal points to"},
      {.shape = cell_selection, .name = "sphere", .type = object, .of = sphere,
       .help = "the cells with their centroid in a sphere"},
      {.shape = cell_selection, .name = "around", .type = object, .of = around,
       .help = "the cells with their centroid near a path, or near what a blade sweeps: refine them before a cut for a "
               "smoother one"},
      {.shape = cell_selection, .name = "tag", .type = object, .of = tag,
       .help = "the cells that the mesh file marks so ('dartboard mesh info' lists its marks)"},
      {.shape = tag, .name = "of", .type = text, .standard = "\"\"",
       .help = "name of the marks in the file; may be left out where it has one kind of them, and where one kind alone has the "
               "name that is asked for"},
      {.shape = tag, .name = "value", .type = integer, .range = {.least = -2147483648.0, .most = 2147483647.0},
       .help = "the mark, a number"},
      {.shape = tag, .name = "named", .type = text, .help = "or the name that the file gives to it"},
      {.shape = cell_selection, .name = "random", .type = object, .of = random, .help = "cells drawn at random"},
      {.shape = box, .name = "min", .type = point, .unit = "m", .required = true, .help = "the lowest corner"},
      {.shape = box, .name = "max", .type = point, .unit = "m", .required = true, .help = "the highest corner"},
      {.shape = plane, .name = "point", .type = point, .unit = "m", .required = true, .help = "a point on it"},
      {.shape = plane, .name = "normal", .type = point, .required = true,
       .help = "perpendicular to it; of any length but 0"},
      {.shape = sphere, .name = "centre", .type = point, .unit = "m", .required = true, .help = "its centre"},
      {.shape = sphere, .name = "radius", .type = real, .unit = "m", .range = not_negative, .required = true,
       .help = "its radius"},
      {.shape = around, .name = "path", .type = points, .unit = "m", .least_size = 2, .required = true,
       .help = "the points that it goes by, on straight lines"},
      {.shape = around, .name = "depth", .type = point, .unit = "m", .standard = "[0, 0, 0]",
       .help = "how far, and which way, a blade reaches from the path"},
      {.shape = around, .name = "distance", .type = real, .unit = "m", .range = not_negative, .required = true,
       .help = "distance from it"},
      {.shape = random, .name = "count", .type = integer, .range = count_from_1, .required = true,
       .help = "number of cells; all when fewer remain"},
      {.shape = random, .name = "seed", .type = integer, .range = exact_integer, .standard = "1",
       .help = "seed of the random numbers; each time an event repeats it draws further numbers"},

      // ---- events
      {.shape = event, .name = "at", .type = real, .unit = "s", .range = not_negative,
       .help = "happens once, at the first multiple of the step that is not before this time"},
      {.shape = event, .name = "every", .type = real, .unit = "s", .range = positive,
       .help = "happens again and again; left out, or not above the step, at every step"},
      {.shape = event, .name = "from", .type = real, .unit = "s", .range = not_negative, .standard = "0",
       .help = "the first time of those that repeat"},
      {.shape = event, .name = "until", .type = real, .unit = "s", .range = not_negative,
       .help = "no later than this; left out, the duration"},
      {.shape = event, .name = "dissociate", .type = object, .of = dissociate,
       .help = "separate the two cells on either side of faces (of edges, in a surface)"},
      {.shape = event, .name = "remove", .type = object, .of = cell_selection, .help = "remove cells"},
      {.shape = event, .name = "tear", .type = object, .of = tear, .help = "tear a fan of faces around one vertex"},
      {.shape = event, .name = "tear_where_stressed", .type = object, .of = stress,
       .help = "tear wherever the stress is too large"},
      {.shape = event, .name = "refine", .type = object, .of = refine,
       .help = "subdivide tetrahedra; not in a scene with /driven, /forces or /attachments, with an event that releases "
               "fixed vertices ('release'), or with one that tears along a seam ('plane' of 'tear_where_stressed')"},
      {.shape = event, .name = "release", .type = object, .of = vertex_selection,
       .help = "release fixed vertices, by where they are at rest; those held along some axes too"},
      {.shape = dissociate, .name = "points", .type = integer_lists, .range = number,
       .help = "faces, each by three of its points in the mesh, counted from 0 in the order of the file; in a surface "
               "edges, each by its two ends"},
      {.shape = dissociate, .name = "plane", .type = object, .of = plane,
       .help = "the faces between cells whose centroids are on different sides of a plane at that time; a cut follows faces "
               "of the mesh, so refine along it first for a smoother one, where 'refine' is possible (not with /driven, /forces "
               "or /attachments)"},
      {.shape = dissociate, .name = "within", .type = object, .of = within,
       .help = "only those of them whose centre is in this region at that time, as a blade cuts that ends inside the body"},
      {.shape = dissociate, .name = "blade", .type = object, .of = blade,
       .help = "the faces between cells whose centroids are on different sides of what a blade sweeps, at that time"},
      {.shape = blade, .name = "path", .type = points, .unit = "m", .least_size = 2, .required = true,
       .help = "the points that the blade goes by, on straight lines"},
      {.shape = blade, .name = "depth", .type = point, .unit = "m", .required = true,
       .help = "how far, and which way, it reaches from its path"},
      {.shape = within, .name = "polygon", .type = points, .unit = "m", .least_size = 3,
       .help = "a polygon, looked at along the plane's normal; its corners in turn"},
      {.shape = within, .name = "box", .type = object, .of = box, .help = "a box"},
      {.shape = within, .name = "sphere", .type = object, .of = sphere, .help = "a sphere"},
      {.shape = within, .name = "around", .type = object, .of = around,
       .help = "all that is near a path, or near what a blade sweeps"},
      {.shape = tear, .name = "vertex", .type = integer, .range = number,
       .help = "at this point of the mesh, counted from 0 in the order of the file"},
      {.shape = tear, .name = "near", .type = point, .unit = "m", .help = "at the vertex nearest to this place"},
      {.shape = tear, .name = "direction", .type = point, .required = true,
       .help = "of the stress: the fan starts with the face whose normal is nearest to it"},
      {.shape = stress, .name = "threshold", .type = real, .unit = "Pa", .range = positive, .required = true,
       .help = "the largest principal stress that holds: Cauchy's, per area as it is now"},
      {.shape = stress, .name = "plane", .type = object, .of = plane,
       .help = "only along this seam: the faces between cells whose centroids are on different sides of it at rest"},
      {.shape = stress, .name = "most_per_step", .type = integer, .range = count_from_1,
       .help = "vertices torn at one step boundary; left out, all that are above the threshold"},
      {.shape = refine, .name = "cells", .type = object, .of = cell_selection, .required = true,
       .help = "the tetrahedra to subdivide; cells of other kinds stay as they are"},
      {.shape = refine, .name = "at", .type = choice, .choices = {"longest edge", "centre"},
       .standard = "\"longest edge\"",
       .help = "where each gets a vertex; in an edge, all tetrahedra around it are subdivided, and no other cell may have it"},
      {.shape = refine, .name = "bracing", .type = real, .range = not_negative,
       .help = "stiffness of the springs from the vertex to those across, over the material's [0.5]; not used for elements, "
               "which have no springs"},

      // ---- output and expectations
      {.shape = output, .name = "frames_every", .type = real_or_object, .of = cadence, .unit = "s", .range = positive,
       .help = "from one frame to the next, or {\"steps\": 10}; the first and the last state are always written"},
      {.shape = output, .name = "fields", .type = choices, .choices = {"held", "stress", "displacement", "springs", "contact"},
       .standard = "[\"held\", \"stress\"]",
       .help = "the fields of frames in addition to velocities and masses of vertices and numbers and components of "
               "cells. 'held': which vertices are free (0), fixed (1), driven (2) or held along some axes (3). 'stress': of each vertex the largest principal "
               "stress, the largest magnitude of one and the von Mises stress [Pa] (of a surface [N/m]), infinite where "
               "one is not finite: Cauchy's, per area (length) as it is now, of springs their virial over the volume "
               "(area) of the cells; of chains the tension [N] of each link, and 0 at vertices. 'displacement': of each vertex from where it "
               "was at rest [m], which takes 24 bytes a vertex. 'springs': every spring as a line, with its strain. "
               "'contact': of each vertex the force of obstacles and other bodies [N], without damping and friction, and how deep it is "
               "inside [m]; and as field data each pair in contact: the points whose mean is inside (contact_pair_sample, of four, -1 "
               "for none), the points of the face of a body that is nearest (contact_pair_face) or the number of the obstacle "
               "(contact_pair_obstacle), -1 for none, and the depth [m] (contact_pair_depth)"},
      {.shape = output, .name = "compressed", .type = choice, .choices = {"no", "zlib", "lz4"}, .standard = "\"no\"",
       .help = "how the arrays in the files of frames are compressed: 'zlib' is read by ParaView and meshio; 'lz4' is several "
               "times faster, and read by ParaView"},
      {.shape = output, .name = "diagnostics_every", .type = real_or_object, .of = cadence, .unit = "s", .range = positive,
       .help = "from one row of diagnostics to the next, or {\"steps\": 10}; the first and the last state always get one"},
      {.shape = output, .name = "probes", .type = objects, .of = probe, .standard = "[]",
       .help = "vertices whose motion is recorded in probes.csv"},
      {.shape = output, .name = "probes_every", .type = real_or_object, .of = cadence, .unit = "s", .range = positive,
       .help = "from one row of probes to the next, or {\"steps\": 10}; left out, as the diagnostics"},
      {.shape = output, .name = "checkpoint", .type = real, .unit = "s", .range = positive,
       .help = "time between checkpoints, each in place of the last: all that 'dartboard simulate --continue' needs to go "
               "on with the same bits, in a file of the run's folder. One is also left where such a run ends. Left out, "
               "one is left only by a run that is interrupted"},
      {.shape = cadence, .name = "steps", .type = integer, .range = count_from_1, .required = true,
       .help = "of the scene, whatever they take"},
      {.shape = probe, .name = "name", .type = text, .required = true, .help = "heads its columns; no two the same"},
      {.shape = probe, .name = "vertex", .type = integer, .range = number,
       .help = "this point of the mesh, counted from 0 in the order of the file"},
      {.shape = probe, .name = "near", .type = point, .unit = "m",
       .help = "the vertex nearest to it at rest, no farther away than the body is large"},
      {.shape = expect, .name = "vertices", .type = integer, .range = number, .help = "vertices"},
      {.shape = expect, .name = "edges", .type = integer, .range = number, .help = "edges"},
      {.shape = expect, .name = "faces", .type = integer, .range = number, .help = "faces"},
      {.shape = expect, .name = "cells", .type = integer, .range = number, .help = "volumes; of a surface, faces"},
      {.shape = expect, .name = "components", .type = integer, .range = number, .help = "connected components"},
      {.shape = expect, .name = "components_at_least", .type = integer, .range = number,
       .help = "no fewer connected components"},
      {.shape = expect, .name = "operations", .type = integer, .range = number,
       .help = "faces dissociated, cells removed, vertices put in by refinement or released"},
      {.shape = expect, .name = "mass", .type = real, .unit = "kg", .range = not_negative,
       .help = "total mass, to 12 digits"},
      {.shape = expect, .name = "kinetic_at_most", .type = real, .unit = "J", .range = not_negative,
       .help = "kinetic energy: the motion has come to rest"},
      {.shape = expect, .name = "energy_drift_at_most", .type = real, .range = not_negative,
       .help = "largest change of the total energy in any row of the diagnostics, over the largest sum of kinetic and "
               "elastic energy; only where nothing takes or supplies energy: no damping, viscosity, driven vertices, "
               "events, sleep, or forces that begin or end"},
      {.shape = expect, .name = "places", .type = objects, .of = expected_place, .standard = "[]",
       .help = "where probes are"},
      {.shape = expect, .name = "hash", .type = text,
       .help = "of positions and velocities, 16 hexadecimal digits: equal bits only"},
      {.shape = expect, .name = "why", .type = text, .standard = "\"\"",
       .help = "where these numbers come from, for readers"},
      {.shape = expected_place, .name = "probe", .type = text, .required = true, .help = "the name of a probe"},
      {.shape = expected_place, .name = "position", .type = point, .unit = "m", .required = true, .help = "its place"},
      {.shape = expected_place, .name = "within", .type = real, .unit = "m", .range = not_negative, .required = true,
       .help = "distance from there that is allowed"},
      {.shape = expected_place, .name = "of", .type = choice, .choices = {"vertex", "part"}, .standard = "\"vertex\"",
       .help = "what has its place there: the probe's vertex; or the centre of mass of all that is connected with it, "
               "whose way through the air needs no simulation to be known"},
      {.shape = expected_place, .name = "why", .type = text, .standard = "\"\"",
       .help = "where the place comes from, for readers"},
  };
  // clang-format on
}

std::vector<SceneKey> make_keys() {
  std::vector<SceneKey> by_hand = keys_by_hand();
  const auto forces = std::ranges::find(by_hand, "forces", &SceneKey::name);
  const KeyRows others = keys_of_forces();
  by_hand.insert(std::next(forces), others.keys.begin(), others.keys.end());
  std::vector<SceneKey> keys;
  // the keys of one shape under another, too: all but one, or those from one on
  const auto add = [&](Shape shape, Shape as, std::string_view but = "", std::string_view from = "") {
    bool is_left_out = !from.empty();
    for (const SceneKey& key : by_hand) {
      if (key.shape != as) continue;
      if (key.name == from) is_left_out = false;
      if (is_left_out || key.name == but) continue;
      keys.push_back(key);
      keys.back().shape = shape;
    }
  };
  for (const Shape shape : {Shape::held, Shape::driven, Shape::force, Shape::attachment})
    add(shape, Shape::vertex_selection);
  keys.insert(keys.end(), by_hand.begin(), by_hand.end());
  add(Shape::one_body, Shape::body);
  add(Shape::tissue, Shape::material, "viscosity");
  add(Shape::contact_pair, Shape::obstacle, "", "pressure");
  return keys;
}

std::string real_text(double value) { return fmt::format("{}", value); }

std::string range_text(const Range& range) {
  std::string words;
  if (std::isfinite(range.least)) words += fmt::format(" {} {}", range.above ? ">" : ">=", real_text(range.least));
  if (std::isfinite(range.most)) words += fmt::format("{} <= {}", words.empty() ? "" : " and", real_text(range.most));
  return words;
}

}  // namespace

namespace {

std::vector<ShapeHelp> shapes_by_hand() {
  return {
      {Shape::scene, "scene", "The whole file. Lengths in metres, times in seconds, SI units throughout."},
      {Shape::body, "body", "The mesh that the body is at rest in. Tetrahedra alone get the tetrahedral storage."},
      {Shape::one_body, "one_body",
       "One of several bodies: what a 'body' has, and its material. Solids, surfaces and chains may be side by side; "
       "diagnostics then list the boundary and the stress of the solids, or without any of the surfaces."},
      {Shape::generate, "generate", "A mesh made on the spot."},
      {Shape::box_mesh, "box_mesh", "A box of cubes."},
      {Shape::sheet_mesh, "sheet_mesh", "A rectangle of squares."},
      {Shape::ball_mesh, "ball_mesh",
       "A ball: the octahedral layers of a lattice, each pushed out to a sphere. All cells are well shaped."},
      {Shape::chain_mesh, "chain_mesh",
       "A chain has links and no cells, so nothing can happen to it except that fixed points are released. In place of "
       "the largest principal stress it has the largest tension [N]. Its ends can be attached to other bodies, and it touches "
       "obstacles, but no bodies."},
      {Shape::material, "material", "A homogeneous mass/spring material."},
      {Shape::tissue, "tissue",
       "The material of some of the cells: what a 'material' has, except the viscosity, which is that of what "
       "surrounds everything."},
      {Shape::region, "region", "Some of the cells, and their material."},
      {Shape::damping, "damping",
       "The damping of elements by the rate of their strain (Kelvin and Voigt): ratio / (pi frequency) times their "
       "elasticity. No motion as a whole is damped, however the body turns. The higher a frequency the more it is damped, "
       "which may shorten the stable step of explicit integrators other than 'verlet'."},
      {Shape::velocity, "velocity", "v(x) = constant + linear (x - centre)"},
      {Shape::vertex_selection, "vertex_selection", "Some of the vertices."},
      {Shape::held, "held", "Some of the vertices, and the axes along which they are held."},
      {Shape::driven, "driven",
       "Some of the vertices and how they move, in each step straight to where they should be at its end: times within "
       "steps count. Driven vertices are never free: at other times they are held still. No two drives move a vertex at "
       "one time, and none is fixed. They do work, so energy and momentum of the body change."},
      {Shape::driven_place, "driven_place", "A place on a path, and when."},
      {Shape::driven_turn, "driven_turn",
       "A turn about an axis. In each step vertices go straight on, so that they are on "
       "their circles at the ends of steps."},
      {Shape::driven_angle, "driven_angle", "An angle, and when."},
      {Shape::force, "force",
       "A force from outside that keeps its direction, and when: in each step it acts as its mean over the step, also "
       "where it begins or ends within, so that the momentum that it gives is exact. It stays with the matter it acts "
       "on: parts of a vertex that comes apart share it in proportion to their masses, and what loses cells loses their "
       "share. What of it acts on fixed or driven vertices is borne by what holds them."},
      {Shape::force_factor, "force_factor", "A factor of a force, and when."},
      {Shape::contact, "contact",
       "Contact of the surface of bodies with obstacles, and of solids with solids: of a solid its boundary, cuts included, "
       "of a surface all of it, from both sides. It is felt at the vertices and in the middles of faces, each by its share of the area at rest, and "
       "has no thickness: a fresh cut touches nothing. 'dartboard explain' reports how deep a body will rest and come in "
       "a fall, and the longest stable step there."},
      {Shape::contact_pair, "contact_pair", "Two bodies, or one and itself, and whether and how they touch."},
      {Shape::obstacle, "obstacle",
       "Something that no force moves: half of space, a ball or a box, at rest or moving straight on, and the law of the "
       "contact with it where that is another one. Times are exact, whatever the step."},
      {Shape::cell_selection, "cell_selection", "Some of the cells: volumes, or the faces of a surface."},
      {Shape::tag, "tag", "A mark of cells in a mesh file: a region, a material, a physical group."},
      {Shape::box, "box",
       "A box with faces across the axes, its surface included. What is nearer to a border, here and elsewhere, than a "
       "billionth of the body's size counts as on it."},
      {Shape::plane, "plane", "A plane; its positive side is where the normal points to, the plane itself included."},
      {Shape::sphere, "sphere", "A ball, its surface included."},
      {Shape::around, "around", "What is within a distance of a path, or of what a blade sweeps along it."},
      {Shape::random, "random", "A number of cells, each subset of that size as likely."},
      {Shape::event, "event",
       "What happens, and when. An event is applied between two steps: at time t, at the first multiple n * step that "
       "is not before t. A t within 4 units of rounding of a multiple counts as that multiple."},
      {Shape::dissociate, "dissociate", "Which faces come apart."},
      {Shape::within, "within", "How far a cut reaches."},
      {Shape::blade, "blade", "A blade that is moved through the body."},
      {Shape::rotation, "rotation", "A turn about an axis."},
      {Shape::tear, "tear", "Which fan is torn."},
      {Shape::stress, "stress", "Where stress tears."},
      {Shape::refine, "refine",
       "Which tetrahedra become smaller ones. Mass and momentum stay; a bracing above 0 makes the body a little "
       "stiffer, and without it a vertex at a centre moves freely."},
      {Shape::sleep, "sleep",
       "A component is all that springs, elements and attachments hold together, and what it rests on or touches. When "
       "all of it has been slow for long enough, its vertices keep their places, their velocities become 0, and the "
       "kinetic energy removed is reported. It is stepped again when a body comes near (closer than an eighth of the "
       "distance of vertices to the box around it), when an event changes any body, when a load on it changes, and when an "
       "obstacle moves near to it. Studies that measure the accuracy of a motion refuse a "
       "scene with this key."},
      {Shape::output, "output", "What is recorded. None of it changes a bit of the trajectory."},
      {Shape::cadence, "cadence", "A number of steps in place of a time."},
      {Shape::probe, "probe",
       "One vertex, wherever it goes: its position and velocity. Of a vertex that comes apart it follows the part that "
       "keeps its number; once that is removed, the fields are empty."},
      {Shape::expect, "expect", "What must be true at the end."},
      {Shape::expected_place, "expected_place", "Where a probe, or the part of the body that it is in, is at the end."},
  };
}

}  // namespace

std::span<const ShapeHelp> scene_shapes() {
  static const std::vector<ShapeHelp> shapes = [] {
    std::vector<ShapeHelp> all = shapes_by_hand();
    const KeyRows others = keys_of_forces();
    all.insert(all.end(), others.shapes.begin(), others.shapes.end());
    std::ranges::sort(all, {}, &ShapeHelp::shape);
    return all;
  }();
  return shapes;
}

const ShapeHelp& help_of(Shape shape) { return scene_shapes()[static_cast<std::size_t>(shape)]; }

std::span<const SceneKey> scene_keys() {
  static const std::vector<SceneKey> keys = make_keys();
  return keys;
}

const SceneKey* find_key(Shape shape, std::string_view name) {
  static const auto index = [] {
    std::map<std::pair<Shape, std::string_view>, const SceneKey*> keys;
    for (const SceneKey& key : scene_keys()) keys[{key.shape, key.name}] = &key;
    return keys;
  }();
  const auto found = index.find({shape, name});
  return found == index.end() ? nullptr : found->second;
}

std::span<const SceneRule> scene_rules() {
  using enum SceneRule::Kind;
  static const std::vector<SceneRule> rules = [] {
    std::vector<SceneRule> all{
        {exactly_one, Shape::scene, {"step", "accuracy"}},
        {exactly_one, Shape::scene, {"body", "bodies"}},
        {exactly_one, Shape::one_body, {"mesh", "generate"}},
        {exactly_one, Shape::body, {"mesh", "generate"}},
        {exactly_one, Shape::generate, {"box", "sheet", "ball", "chain"}},
        {at_most_one, Shape::material, {"stiffness", "young"}},
        {excludes, Shape::material, {"poisson", "stiffness"}},
        {needs_object, Shape::material, {"poisson", "damping"}},
        {at_most_one, Shape::tissue, {"stiffness", "young"}},
        {excludes, Shape::tissue, {"poisson", "stiffness"}},
        {needs_object, Shape::tissue, {"poisson", "damping"}},
        {exactly_one, Shape::vertex_selection, {"ids", "box", "plane", "sphere", "around"}},
        {exactly_one, Shape::held, {"ids", "box", "plane", "sphere", "around"}},
        {exactly_one, Shape::driven, {"ids", "box", "plane", "sphere", "around"}},
        {exactly_one, Shape::force, {"ids", "box", "plane", "sphere", "around"}},
        {exactly_one, Shape::driven, {"velocity", "path", "turn"}},
        {excludes, Shape::driven, {"path", "from", "until", "reverse_every"}},
        {excludes, Shape::driven, {"turn", "from", "until", "reverse_every"}},
        {exactly_one, Shape::force, {"force", "traction", "pressure", "acceleration", "torque"}},
        {excludes, Shape::force, {"pressure", "on"}},
        {excludes, Shape::force, {"acceleration", "on"}},
        {excludes, Shape::force, {"torque", "on"}},
        {exactly_one, Shape::obstacle, {"plane", "sphere", "box"}},
        {exactly_one, Shape::probe, {"vertex", "near"}},
        {exactly_one, Shape::cell_selection, {"ids", "box", "plane", "sphere", "around", "random", "tag"}},
        {exactly_one, Shape::tag, {"value", "named"}},
        {exactly_one, Shape::event, {"dissociate", "remove", "tear", "tear_where_stressed", "refine", "release"}},
        {excludes, Shape::event, {"at", "every", "from", "until"}},
        {exactly_one, Shape::dissociate, {"points", "plane", "blade"}},
        {excludes, Shape::dissociate, {"points", "within"}},
        {excludes, Shape::dissociate, {"blade", "within"}},
        {exactly_one, Shape::within, {"box", "sphere", "around", "polygon"}},
        {exactly_one, Shape::tear, {"vertex", "near"}},
        {at_most_one, Shape::expect, {"components", "components_at_least"}},
    };
    const KeyRows others = keys_of_forces();
    all.insert(all.end(), others.rules.begin(), others.rules.end());
    return all;
  }();
  return rules;
}

std::string quoted_list(const std::vector<std::string>& words, std::string_view between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : std::string(between)) + "'" + word + "'";
  return text;
}

std::string expectation(const SceneKey& key) {
  const std::string range = range_text(key.range);
  const std::string unit = key.unit.empty() ? "" : fmt::format(" [{}]", key.unit);
  const auto object = [&key] { return fmt::format("an object ({})", help_of(key.of).name); };
  switch (key.type) {
    case ValueType::text: return "a text";
    case ValueType::choice: return "one of " + quoted_list(key.choices, ", ");
    case ValueType::choices:
      return fmt::format("a list of different words, {}out of {}", key.least_size > 0 ? "at least one, " : "",
                         quoted_list(key.choices, ", "));
    case ValueType::integer: return "an integer" + range + unit;
    case ValueType::integers: return "a list of integers" + range + ", at least one";
    case ValueType::real: return "a number" + range + unit;
    case ValueType::point: return "a list of three numbers" + range + unit;
    case ValueType::points:
      return fmt::format("a list of {} points or more, each of three numbers", key.least_size) + range + unit;
    case ValueType::matrix: return "three lists of three numbers" + range + unit;
    case ValueType::object: return object();
    case ValueType::objects: return fmt::format("a list of objects ({})", help_of(key.of).name);
    case ValueType::point_or_object: return "a list of three numbers" + range + unit + " or " + object();
    case ValueType::real_or_object: return "a number" + range + unit + " or " + object();
    case ValueType::integer_pair: return "a list of two integers" + range;
    case ValueType::integer_triple: return "a list of three integers" + range;
    case ValueType::integer_lists: break;
  }
  return "a list, not empty, of lists of two or three integers" + range;
}

}  // namespace dartboard
