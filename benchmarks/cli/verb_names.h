#pragma once
// The verbs, in the order of the help: a row for each.

#include <array>
#include <string_view>

namespace dartboard {

struct VerbName {
  std::string_view name, help;
  bool in_both = false;  // programs; the others are in dartboard-harness alone
};

inline constexpr std::array verb_names{
    VerbName{"reproduce",
             "Gate and time the paper's walks on a body of its size and answer its claims; time a larger body on one "
             "core and on all; then put all integrators to the extremes and answer ours."},
    VerbName{"validate", "Compare with independent implementations."},
    VerbName{"bench", "Measure one part against its targets and its peers."},
    VerbName{"simulate", "Run a scene: a body that moves, and is cut, torn or eroded meanwhile.", true},
    VerbName{"scene", "What a scene file may say.", true},
    VerbName{"tradeoff",
             "Measure what accuracy costs on a scene: every integrator and every step; or, of a bar held at one end, "
             "every model and mesh."},
    VerbName{"recommend",
             "The cheapest integrator and step for an error, predicted from short runs of the scene; or, of a bar held "
             "at one end, the cheapest model and mesh, too."},
    VerbName{"extremes",
             "Run every integrator at the extremes, of our own bodies or of scenes at steps of every length: each run "
             "is right, warned of, or stopped with a diagnosis."},
    VerbName{"explain", "The plan of a scene before it runs: what will be there and why, its bytes, what is left out.",
             true},
    VerbName{"explain-dt",
             "Which springs, elements and vertices limit the time step of a scene, and what changing them would buy."},
    VerbName{"gallery", "Run every scene that comes with the program, judge it, and draw it."},
    VerbName{"report", "Make the page of one study, or of several, from the folders that they have left."},
    VerbName{
        "compare",
        "Compare two runs of a study, task by task and verdict by verdict; or of a scene: when and how far they part."},
    VerbName{"mesh", "Look at a mesh file, or at the formats that are read.", true},
    VerbName{"list", "List scenes, contenders, integrators and claims."},
};

/// Whether the first word of a command line asks for the program that has every verb: the name of a verb that is not in
/// both, or of one that times in a process of its own.
bool is_of_harness(std::string_view word);

}  // namespace dartboard
