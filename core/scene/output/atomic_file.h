#pragma once
// Files that appear whole or not at all.

#include <filesystem>
#include <string_view>

namespace dartboard {

/// Write beside the place, then rename into it: who reads at any moment finds the old contents or the new.
///
/// throws  IoError if it cannot be written
void write_whole(const std::filesystem::path& path, std::string_view contents);

/// throws  IoError "PATH: cannot be written: ..." with the reason that the system gave last
/// pre     errno was set to 0 before the file was written
[[noreturn]] void throw_not_written(const std::filesystem::path& path);

}  // namespace dartboard
