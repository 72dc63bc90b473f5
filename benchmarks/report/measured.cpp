#include "benchmarks/report/measured.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/manifest.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

struct CloseGz {
  void operator()(gzFile file) const { gzclose(file); }
};
using GzFile = std::unique_ptr<gzFile_s, CloseGz>;

/// The text of a file, whether compressed or not.
///
/// throws  IoError where it cannot be read, or is cut off or damaged
std::string unpacked(const fs::path& file) {
  const GzFile in(gzopen(file.c_str(), "rb"));
  if (!in) throw IoError(fmt::format("{}: cannot be read", file.string()));
  std::string text;
  std::array<char, 1 << 16> block{};
  for (;;) {
    const int count = gzread(in.get(), block.data(), block.size());
    if (count > 0) text.append(block.data(), static_cast<std::size_t>(count));
    if (count == static_cast<int>(block.size())) continue;
    int error = Z_OK;
    gzerror(in.get(), &error);
    if (error == Z_OK) return text;
    throw IoError(fmt::format("{}: is cut off or damaged after line {}; expected what the study left", file.string(),
                              std::count(text.begin(), text.end(), '\n')));
  }
}

}  // namespace

fs::path measured_file(const fs::path& folder) {
  for (const char* name : {measured_name, packed_measured_name}) {
    std::error_code error;
    if (fs::exists(folder / name, error)) return folder / name;
  }
  throw IoError(
      fmt::format("{}: {}; expected the folder of a study", folder.string(),
                  fs::is_directory(folder)
                      ? fmt::format("holds no {}, the output of the processes of a study that measures in some",
                                    packed_measured_name)
                      : "there is no such folder"));
}

Json measured_by(const Json& study) {
  return {
      {"study", study}, {"program", file_hash("/proc/self/exe")}, {"cpu", begin_manifest({}).at("machine").at("cpu")}};
}

MeasuredLog::MeasuredLog(const RunFolder& folder, const Json& by)
    : file_(folder.path() / measured_name), lines_(folder.json_lines(measured_name)) {
  lines_.append(by);
}

void MeasuredLog::add(const std::vector<std::string>& arguments, const MeasuredOutput& output) {
  Json line{{"arguments", arguments}, {"lines", output.lines}};
  if (!output.failure.empty()) line["failure"] = output.failure;
  lines_.append(line);
}

void MeasuredLog::pack() const {
  const fs::path packed = file_.parent_path() / packed_measured_name;
  const std::string text = unpacked(file_);
  GzFile out(gzopen(packed.c_str(), "wb9"));
  const bool written =
      out && gzwrite(out.get(), text.data(), static_cast<unsigned>(text.size())) == static_cast<int>(text.size());
  if (!written || gzclose(out.release()) != Z_OK) throw IoError(fmt::format("{}: cannot be written", packed.string()));
  fs::remove(file_);
}

Measured::Measured(const fs::path& folder, const Json& study, MeasuredFor use)
    : folder_(folder), file_(measured_file(folder)), use_(use) {
  const std::string text = unpacked(file_);
  std::size_t number = 0;
  for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
    end = std::min(text.find('\n', at), text.size());
    const Json line = Json::parse(std::string_view(text).substr(at, end - at), nullptr, false);
    if (++number == 1) {
      by_ = line;
      continue;
    }
    if (use == MeasuredFor::going_on && end == text.size() && line.is_discarded())
      break;  // the program was ended while it wrote
    try {
      MeasuredOutput output{line.at("lines"), line.value("failure", "")};
      if (use == MeasuredFor::deriving || output.failure.empty())
        outputs_.emplace(line.at("arguments"), std::move(output));
    } catch (const Json::exception&) {
      throw IoError(
          fmt::format("{}:{}: is no output of a process with its arguments and lines", file_.string(), number));
    }
  }
  const Json expected = use == MeasuredFor::deriving ? Json{{"study", study}} : measured_by(study);
  for (const auto& [key, what] : {std::pair("study", "another study, or of other options"),
                                  {"program", "another build of this program"},
                                  {"cpu", "another processor"}})
    if (expected.contains(key) && (!by_.is_object() || !by_.contains(key) || by_.at(key) != expected.at(key)))
      throw IoError(
          fmt::format("{}: is that of {}; expected {} {}", folder.string(), what, key, json_text(expected.at(key))));
}

std::optional<MeasuredOutput> Measured::take(const std::vector<std::string>& arguments) {
  const auto found = outputs_.lower_bound(arguments);
  if (found == outputs_.end() || found->first != arguments) {
    if (use_ == MeasuredFor::going_on) return std::nullopt;
    throw IoError(fmt::format("{}: has no output of `{}`, which this program asks for", file_.string(),
                              fmt::join(arguments, " ")));
  }
  MeasuredOutput output = std::move(found->second);
  outputs_.erase(found);
  ++taken_;
  return output;
}

}  // namespace dartboard
