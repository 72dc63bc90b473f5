#pragma once
// The folder of the project's files: its meshes, scenes and values.

#include <filesystem>

namespace dartboard {

/// The folder of the sources that this program was built from. It is the only object that depends on where a checkout
/// lies, so that a compiler cache serves every other object to another checkout.
std::filesystem::path source_folder();

}  // namespace dartboard
