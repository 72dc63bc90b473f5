#include "benchmarks/report/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>
#include <vector>

#include "benchmarks/harness/json_number.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/report/measured.h"
#include "core/meshes/text/base64.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;

constexpr const char* format_name = "dartboard-findings";
constexpr int version = 1;

nlohmann::json numbers(const std::vector<double>& all) {
  nlohmann::json out = nlohmann::json::array();
  for (const double x : all) out.push_back(number(x));
  return out;
}

nlohmann::json data_of(const std::vector<PlotSeries>& all) {
  nlohmann::json out = nlohmann::json::array();
  for (const PlotSeries& s : all) {
    nlohmann::json x = nlohmann::json::array(), y = nlohmann::json::array(), labels = nlohmann::json::array();
    for (const auto& p : s.points) {
      x.push_back(number(p.x));
      y.push_back(number(p.y));
      labels.push_back(p.label);
    }
    if (std::ranges::all_of(s.points, [](const auto& p) { return p.label.empty(); })) labels.clear();
    out.push_back({{"title", s.title},
                   {"x", std::move(x)},
                   {"y", std::move(y)},
                   {"labels", std::move(labels)},
                   {"colour", s.colour},
                   {"symbol", s.symbol},
                   {"size", s.size},
                   {"width", s.width},
                   {"dash", s.dash},
                   {"opacity", s.opacity},
                   {"staircase", s.staircase},
                   {"filled", s.filled}});
  }
  return out;
}

nlohmann::json data_of(const Plot& plot) {
  return {{"kind", "plot"},
          {"title", plot.title},
          {"subtitle", plot.subtitle},
          {"x", {{"title", plot.x_axis}, {"low", plot.x_low}, {"high", plot.x_high}, {"log", true}}},
          {"y", {{"title", plot.y_axis}, {"low", plot.y_low}, {"high", plot.y_high}, {"log", plot.rows.empty()}}},
          {"rows", plot.rows},
          {"shaded_below", plot.shaded_below},
          {"shaded_label", plot.shaded_label},
          {"series", data_of(plot.series)}};
}

nlohmann::json data_of(const Panels& panels) {
  nlohmann::json all = nlohmann::json::array();
  for (const Panel& p : panels.panels) {
    nlohmann::json ticks = nlohmann::json::array();
    for (const Tick& tick : p.y_ticks) ticks.push_back({{"at", tick.at}, {"label", tick.label}});
    all.push_back({{"title", p.title},
                   {"x", {{"title", p.x_axis}, {"low", p.x_low}, {"high", p.x_high}, {"log", p.x_log}}},
                   {"y", {{"title", p.y_axis}, {"low", p.y_low}, {"high", p.y_high}, {"log", p.y_log}}},
                   {"ticks", std::move(ticks)},
                   {"field", {{"x", p.field.x}, {"y", p.field.y}, {"values", numbers(p.field.values)}}},
                   {"series", data_of(p.series)}});
  }
  return {{"kind", "panels"},
          {"title", panels.title},
          {"columns", panels.columns},
          {"panels", std::move(all)},
          {"field", {{"low", panels.field_low}, {"high", panels.field_high}, {"label", panels.field_label}}}};
}

nlohmann::json data_of(const BodyStrip& strip) { return {{"kind", "image"}, {"title", strip.title}}; }

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
  throw IoError(fmt::format("{}: {}; expected the folder of a study, as it left it", file.string(), what));
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  std::error_code error;
  if (!in) fail(file, fs::exists(file, error) ? "cannot be read" : "is missing");
  return bytes;
}

}  // namespace

nlohmann::json read_json_file(const fs::path& file) {
  const std::string text = bytes_of(file);
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(error.byte, text.size()));
    fail(file, fmt::format("line {}: is no JSON, or ends too soon", 1 + std::count(text.begin(), end, '\n')));
  }
}

bool has_findings(const fs::path& folder) {
  std::error_code error;
  return fs::exists(folder / findings_name, error);
}

nlohmann::json begin_findings(const std::string& label) {
  return {{"format", format_name}, {"version", version}, {"label", label}, {"parts", nlohmann::json::array()}};
}

nlohmann::json findings_of(const Report& part, const std::string& folder) {
  nlohmann::json tables = nlohmann::json::array(), diagrams = nlohmann::json::array();
  for (const NamedTable& t : part.tables) {
    nlohmann::json columns = nlohmann::json::array();
    for (const Column& column : t.table.columns())
      columns.push_back({{"title", column.title}, {"right", column.align == Align::right}});
    tables.push_back({{"name", t.name},
                      {"heading", t.heading},
                      {"note", t.note},
                      {"columns", std::move(columns)},
                      {"rows", t.table.rows()}});
  }
  for (const Picture& picture : part.pictures) {
    nlohmann::json data = std::visit([](const auto& what) { return data_of(what); }, picture.what);
    data["name"] = picture.name;
    diagrams.push_back(std::move(data));
  }
  return {{"folder", folder},
          {"opening", part.opening},
          {"tables", std::move(tables)},
          {"claims", part.claims},
          {"diagrams", std::move(diagrams)},
          {"disagreements", part.disagreements},
          {"sentence", part.sentence},
          {"limits", part.limits}};
}

nlohmann::json read_run(const fs::path& folder) {
  nlohmann::json run{{"folder", folder.lexically_normal().filename().string()},
                     {"manifest", read_json_file(folder / "manifest.json")},
                     {"findings", read_json_file(folder / findings_name)},
                     {"files", nlohmann::json::array()}};
  nlohmann::json& findings = run["findings"];
  const fs::path file = folder / findings_name;
  const auto is = [&findings](const char* member, const nlohmann::json& value) {
    return findings.is_object() && findings.contains(member) && findings[member] == value;
  };
  if (!is("format", format_name)) fail(file, "is no list of findings");
  if (!is("version", version))
    fail(file, fmt::format("has version {} of its format, and this program reads {}", json_text(findings["version"]),
                           version));
  std::set<std::string> files;
  std::error_code error;
  if (fs::exists(folder / packed_measured_name, error))  // all else follows from it
    files = {"manifest.json", packed_measured_name};
  else
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, error))
      if (entry.path().extension() == ".jsonl" || entry.path().extension() == ".json")
        files.insert(fs::relative(entry.path(), folder).string());
  for (const std::string& one : files) run["files"].push_back(one);
  try {
    for (nlohmann::json& part : findings.at("parts"))
      for (nlohmann::json& diagram : part.at("diagrams"))
        if (diagram.at("kind") == "image") {
          const fs::path picture =
              folder / part.at("folder").get<std::string>() / (diagram.at("name").get<std::string>() + ".png");
          diagram["image"] =
              fs::exists(picture, error) ? "data:image/png;base64," + encode_base64(bytes_of(picture)) : "";
        }
  } catch (const nlohmann::json::exception& problem) {
    fail(file, fmt::format("has not the members of version {}: {}", version, problem.what()));
  }
  return run;
}

}  // namespace dartboard
