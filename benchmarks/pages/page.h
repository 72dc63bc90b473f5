#pragma once
// Pages of one file that open in a browser without a network.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace dartboard {

/// Is this file a page made by `write_page`, by the template of that name?
bool is_page(const std::filesystem::path& file, std::string_view name);

/// `made_later` is a folder that will be there when the page is written.
/// throws  IoError if there is no folder for it, or the file exists and is not to be replaced, or is no such page
void require_writable_page(const std::filesystem::path& file, std::string_view name, bool replace,
                           const std::filesystem::path& made_later);

/// Make a page by a template of this folder, `name`.html.
///
/// returns  a sentence on what went wrong; empty when all is well
/// throws   IoError when the file cannot be written
std::string write_page(const std::string& name, const nlohmann::json& page, const std::filesystem::path& file);

}  // namespace dartboard
