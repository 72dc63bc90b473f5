#pragma once
// Writing of files that appear whole or not at all.

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string_view>

namespace dartboard {

/// Write to a temporary file in the same folder, then rename it: a reader always finds the old contents or the new.
///
/// throws  IoError if it cannot be written
void write_whole(const std::filesystem::path& path, std::string_view contents);
/// The contents are what `put` writes.
/// pre     `put` does not throw
void write_whole(const std::filesystem::path& path, const std::function<void(std::ostream&)>& put);

/// throws  IoError "PATH: cannot be written: ..." with the reason that the system gave last
/// pre     errno was set to 0 before the file was written
[[noreturn]] void throw_not_written(const std::filesystem::path& path);

}  // namespace dartboard
