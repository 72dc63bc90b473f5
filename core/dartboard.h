#pragma once
// All that a program needs to build a body, change its topology and move it.
//
//   mesh     mesh_generators.h, mesh_io.h      from a generator or a file
//   body     mass_spring_body.h                a map whose cells carry mass, stiffness, position, velocity
//   change   dissociate_*.h, remove_*.h        topological operations ...
//            adapt.h, refine.h, split_off.h    ... and how embeddings follow
//   tear     seam.h, tearing.h, stress.h       along a plane, between chosen cells, or where the stress is too high
//   follow   views.h                           arrays that keep up with changes
//   touch    skin.h, obstacle_contact.h        samples of the boundary, and the force term of what they run into ...
//            skin_solids_view.h                ... and what they may be inside of,
//            body_contact.h                    for the force term between and within bodies ...
//            contact_impulses.h                ... with restitution and friction around each step
//   force    piece_term.h                      a force of your own, from the energy of its pieces
//   move     integrators.h, runge_kutta_4.h    every integrator, by name; the paper's, over its walks
//   measure  energy.h                          energies and momenta
//   scene    recorded_run.h                    what the program does with a scene file ...
//            simulation.h                      ... step by step
//   or all   soft_body.h                       body, change, follow and move in one class

#include "core/contact/body_contact.h"
#include "core/contact/contact_impulses.h"
#include "core/contact/obstacle_contact.h"
#include "core/forces/piece_term.h"
#include "core/mechanics/adapt.h"
#include "core/mechanics/fracture/seam.h"
#include "core/mechanics/fracture/stress.h"
#include "core/mechanics/fracture/tearing.h"
#include "core/mechanics/mass_spring_body.h"
#include "core/mechanics/refine.h"
#include "core/mechanics/split_off.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/meshes/mesh_io.h"
#include "core/operations/dissociate_all.h"
#include "core/operations/dissociate_face.h"
#include "core/operations/remove_component.h"
#include "core/operations/remove_face.h"
#include "core/operations/remove_volume.h"
#include "core/operations/subdivide.h"
#include "core/operations/tear_fan.h"
#include "core/scene/output/write_vtu.h"
#include "core/scene/recorded_run.h"
#include "core/scene/run/simulation.h"
#include "core/scene/soft_body.h"
#include "core/time/integrators.h"
#include "core/time/system/energy.h"
#include "core/topology/check.h"
#include "core/views/skin.h"
#include "core/views/skin_solids_view.h"
#include "core/views/views.h"
#include "core/walks/runge_kutta_4.h"
