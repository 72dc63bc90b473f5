#include "benchmarks/harness/run_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>

#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/json_text.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;

/// The library would print null for a NaN, which a reader could not distinguish from a missing value.
void check_finite(const nlohmann::json& value, const std::string& pointer) {
  if (value.is_number_float() && !std::isfinite(value.get<double>()))
    throw InputError(fmt::format("{}: {} is not finite, JSON cannot hold it", pointer, value.get<double>()));
  if (!value.is_structured()) return;
  for (const auto& [key, part] : value.items()) check_finite(part, fmt::format("{}/{}", pointer, key));
}

std::string dump(const nlohmann::json& value, int indent) {
  check_finite(value, "");
  return json_text(value, indent);
}

}  // namespace

JsonLines::JsonLines(fs::path file) : file_(std::move(file)), stream_(file_, std::ios::app) {
  if (!stream_) throw IoError(fmt::format("{}: cannot be opened for appending", file_.string()));
}

void JsonLines::append(const nlohmann::json& value) {
  stream_ << dump(value, -1) << '\n' << std::flush;
  if (!stream_) throw IoError(fmt::format("{}: a line could not be written; is the disk full?", file_.string()));
}

RunFolder::RunFolder(fs::path path) : claim_(std::make_shared<const FolderClaim>(path)), path_(std::move(path)) {}

fs::path RunFolder::file(std::string_view name) const {
  if (name.empty() || name == "." || name == ".." || name.find('/') != name.npos)
    throw InputError(fmt::format("'{}' is not a plain file name", name));
  return path_ / name;
}

void RunFolder::write(std::string_view name, std::string_view text) const {
  const fs::path target = file(name);
  const fs::path beside = path_ / fmt::format(".{}.part", name);
  std::error_code error;
  std::ofstream stream(beside, std::ios::binary | std::ios::trunc);
  stream << text;
  stream.close();
  if (stream) fs::rename(beside, target, error);
  if (stream && !error) return;
  std::error_code ignored;
  fs::remove(beside, ignored);
  throw IoError(fmt::format("{}: cannot be written{}", target.string(), error ? ": " + error.message() : ""));
}

void RunFolder::write_json(std::string_view name, const nlohmann::json& value) const {
  write(name, dump(value, 2) + "\n");
}

void RunFolder::write_manifest(const nlohmann::json& manifest) const { write_json("manifest.json", manifest); }

void RunFolder::write_claims(std::span<const Claim> claims) const {
  nlohmann::json all = nlohmann::json::array();
  for (const Claim& claim : claims) all.push_back(claim);
  write_json("claims.json", all);
}

JsonLines RunFolder::json_lines(std::string_view name) const { return JsonLines(file(name)); }

fs::path new_run_path(const fs::path& results, std::string_view label) {
  std::string time = utc_time();
  // without the separators: colons are awkward in file names
  time.erase(std::remove_if(time.begin(), time.end(), [](char c) { return c == '-' || c == ':'; }), time.end());
  const std::string first = fmt::format("{}-{}", label, time);
  std::error_code error;
  fs::create_directories(results, error);
  fs::path path = results / first;
  // true means that this process made the folder, and no other
  for (int n = 2; !error && !fs::create_directory(path, error); ++n) path = results / fmt::format("{}-{}", first, n);
  if (error) throw IoError(fmt::format("{}: cannot be created: {}", path.string(), error.message()));
  return path;
}

fs::path run_path(const std::string& out, std::string_view label) {
  return out.empty() ? new_run_path(default_results, label) : fs::path(out);
}

}  // namespace dartboard
