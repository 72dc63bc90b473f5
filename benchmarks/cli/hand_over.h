#pragma once
// From the program of scenes and meshes to the program that has every verb.

namespace dartboard {

/// Replace this process by dartboard-harness with the same command line. `./dartboard` builds that first, if it started
/// this process; else the program beside this one is taken.
///
/// throws  IoError if there is none
[[noreturn]] void hand_over_to_harness(char** argv);

}  // namespace dartboard
