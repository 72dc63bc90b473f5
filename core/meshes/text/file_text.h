#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dartboard {

/// The contents of a regular file. Errors name `wanted` as expected there.
///
/// throws  IoError when it does not exist, is a folder or a device, cannot be read, is empty, is compressed, or is a
///         page or a pointer in the place of the file
std::string file_text(const std::filesystem::path& path, std::string_view wanted);

// a path that cannot be examined does not exist, and is no folder
bool is_there(const std::filesystem::path& path);
bool is_folder(const std::filesystem::path& path);

}  // namespace dartboard
