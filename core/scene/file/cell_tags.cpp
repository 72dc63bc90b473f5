#include "core/scene/file/cell_tags.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "core/base/overloads.h"
#include "core/scene/file/load_mesh.h"
#include "core/scene/file/scene_problem.h"

namespace dartboard {
namespace {

bool is_meant(const TagSelection& tag, const CellTags& marks) { return tag.tag.empty() || tag.tag == marks.name; }

bool has_value(const TagSelection& tag, const CellTags& marks, std::int32_t value) {
  if (const auto* number = std::get_if<std::int32_t>(&tag.value)) return value == *number;
  const auto name = marks.names.find(value);
  return name != marks.names.end() && name->second == std::get<std::string>(tag.value);
}

/// "'left' (1), 2"
void add_values(const CellTags& marks, std::set<std::string>& values) {
  for (const std::int32_t value : marks.values)
    values.insert(marks.names.contains(value) ? fmt::format("'{}' ({})", marks.names.at(value), value)
                                              : fmt::format("{}", value));
}

bool has_name(const TagSelection& tag, const CellTags& marks) {
  const auto* named = std::get_if<std::string>(&tag.value);
  return named != nullptr &&
         std::ranges::any_of(marks.names, [named](const auto& entry) { return entry.second == *named; });
}

/// The kinds of marks that the files of a scene have.
struct Found {
  std::map<std::string, std::set<std::string>> values;  // by kind, of the marks that could be meant
  std::set<std::string> holders;                        // those of these kinds with the name that is asked for
  std::set<std::string> others;                         // kinds that could not be meant

  /// A name means the marks that have it, and all only where there are no such marks.
  std::set<std::string> kinds() const {
    if (!holders.empty()) return holders;
    std::set<std::string> all;
    for (const auto& [kind, of_kind] : values) all.insert(kind);
    return all;
  }
};

void require_found(const SceneFile& scene, const Found& found, bool any, const std::string& path) {
  const auto fail = [&](const std::string& what, const std::string& expected) { scene.fail(path, what, expected); };
  const std::set<std::string> kinds = found.kinds();
  if (kinds.empty() && found.others.empty())
    fail("names a mark of cells, and no mesh file of the scene has any", "a selection by place");
  if (kinds.empty())
    fail("names a kind of marks that no mesh file has", fmt::format("'{}'", fmt::join(found.others, "' or '")));
  if (kinds.size() > 1)
    fail("does not say which kind of marks it means", fmt::format("\"of\": '{}'", fmt::join(kinds, "' or '")));
  if (!any) fail("names a mark that no cell has", fmt::format("{}", fmt::join(found.values.at(*kinds.begin()), ", ")));
}

}  // namespace

std::vector<std::uint32_t> cells_with(const SceneFile& scene, const TagSelection& tag, const std::string& path) {
  std::vector<std::uint32_t> cells;
  Found found;
  std::size_t before = 0;
  for (const BodySource& body : scene.bodies()) {
    if (!std::holds_alternative<std::filesystem::path>(body.mesh)) {
      before += make_mesh(scene.file, body).cell_count();
      continue;
    }
    const LoadedMesh read = body.loaded ? LoadedMesh{} : read_body_mesh(body);
    const LoadedMesh& loaded = body.loaded ? *body.loaded : read;
    for (const CellTags& marks : loaded.tags) {
      if (!is_meant(tag, marks)) {
        found.others.insert(marks.name);
        continue;
      }
      add_values(marks, found.values[marks.name]);
      if (has_name(tag, marks)) found.holders.insert(marks.name);
      for (std::size_t c = 0; c < marks.values.size(); ++c)
        if (has_value(tag, marks, marks.values[c])) cells.push_back(static_cast<std::uint32_t>(before + c));
    }
    before += loaded.mesh.cell_count();
  }
  require_found(scene, found, !cells.empty(), path);
  return cells;
}

void resolve_tags(SceneFile& scene) {
  const auto resolve = [&scene](const std::string& path, CellSelection& selection) {
    if (const auto* tag = std::get_if<TagSelection>(&selection))
      selection = IdSelection{cells_with(scene, *tag, path + "/tag")};
  };
  for (SceneRegion& region : scene.regions) resolve(region.path + "/cells", region.cells);
  const auto leave = [](const std::string&, const auto&) {};  // tags mark cells
  for (SceneEvent& event : scene.events) for_each_choice(event, Overloads{resolve, leave});
}

}  // namespace dartboard
