#pragma once
// The folder of an earlier run of a scene, which a new run may replace.

#include <filesystem>
#include <span>

namespace dartboard {

/// Does the folder hold the manifest of a run?
bool is_run_folder(const std::filesystem::path& folder);

/// Removes all files of an earlier run; does nothing if there is no such folder, or it is empty.
///
/// throws  IoError if it is no folder of a run, holds anything that runs of scenes do not write or one of the `inputs`
///         of the new run, or is in use by another run; then nothing is removed
void empty_run_folder(const std::filesystem::path& folder, std::span<const std::filesystem::path> inputs = {});

}  // namespace dartboard
