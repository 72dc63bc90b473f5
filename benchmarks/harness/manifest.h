#pragma once
// The manifest of a run: the command, its inputs, the build, the kind of machine. It is meant to be published, so it
// holds no host name and no absolute path.

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dartboard {

/// Facts that only the caller knows.
struct RunFacts {
  std::vector<std::string> command_line{};
  std::map<std::string, std::uint64_t> seeds{};      // by what each of them seeds
  std::map<std::string, std::string> libraries{};    // versions of those that this room may not include (CGAL)
  std::vector<std::filesystem::path> input_files{};  // meshes and scenes
};

/// Everything known before the first measurement. Unknown values are null, never left out.
///
/// throws  IoError if an input file cannot be read
nlohmann::json begin_manifest(const RunFacts& facts);

/// Adds what is known after the last measurement: the time and the load average, whose rise reveals a noisy neighbour.
void finish_manifest(nlohmann::json& manifest);

/// The commit checked out in `folder`, and whether tracked or new files differ from it ("results" aside, where every
/// run leaves some); both null if git, or a repository with its root there, is missing.
nlohmann::json git_state(const std::filesystem::path& folder);

/// FNV-1a of the bytes of a file, "fnv1a64:" and 16 hexadecimal digits. It detects accidental changes, not malice.
///
/// throws  IoError if it cannot be read
std::string file_hash(const std::filesystem::path& file);

/// A path as the manifest names it: relative to the source folder or the working folder if it lies there, else only the
/// file name.
std::string published_path(const std::filesystem::path& path);

/// The folder and the file of the library that contains a function: "blas/libblas.so.3.11.0"; nothing if there is none.
std::optional<std::string> library_of(const void* function);

/// The words of a command line with every absolute path in them (alone, after '=' or after a flag of one letter)
/// published as above.
std::string published_command(std::string_view words);

}  // namespace dartboard
