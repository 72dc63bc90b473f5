#include "core/scene/file/scene_file.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <new>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "core/plain/cell_limits.h"
#include "core/plain/error.h"
#include "core/plain/material.h"
#include "core/scene/file/load_mesh.h"
#include "core/scene/file/scene_check.h"
#include "core/scene/file/step_times.h"
#include "core/scene/file/strict_json.h"
#include "core/time/integrators.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// More steps than this are a mistake in a unit; the limit also keeps step numbers exact in a double.
constexpr double most_steps = 1e12;

/// Makes structs of JSON that has been checked against the table of keys: types are right and defaults are filled in.
class Reader {
 public:
  Reader(std::string_view name, fs::path folder) : name_(name), folder_(std::move(folder)) {}

  SceneFile scene(const Json& json) const {
    SceneFile scene;
    scene.file = name_;
    scene.name = json.at("name").get<std::string>();
    scene.about = json.at("about").get<std::string>();
    scene.duration = json.at("duration");
    if (json.contains("accuracy")) scene.accuracy = json.at("accuracy").get<double>();
    if (json.contains("step")) scene.step = json.at("step");
    if (!scene.accuracy && scene.duration / scene.step > most_steps)
      fail("/duration", fmt::format("is {} s, {:.3g} steps", scene.duration, scene.duration / scene.step),
           fmt::format("at most {:.0e} steps", most_steps));
    if (json.contains("body")) {
      scene.body = body(json.at("body"), "/body");
    } else {
      BodyList list;
      for (std::size_t k = 0; k < json.at("bodies").size(); ++k)
        list.all.push_back(one_body(json.at("bodies")[k], fmt::format("/bodies/{}", k)));
      if (list.all.empty()) fail("/bodies", "is empty", "at least one body");
      scene.body = {.mesh = std::move(list), .scale = 1.0, .translate = {0, 0, 0}, .path = "/bodies"};
    }
    scene.material = material(json.at("material"), "/material");
    for (std::size_t k = 0; k < json.at("regions").size(); ++k) {
      const std::string path = fmt::format("/regions/{}", k);
      const Json& region = json.at("regions")[k];
      scene.regions.push_back(
          {cells(region.at("cells"), path + "/cells"), material(region.at("material"), path + "/material"), path});
      if (std::holds_alternative<RandomSelection>(scene.regions.back().cells))
        fail(path + "/cells/random", "is drawn anew with every seed", "cells by place, by number or by tag");
    }
    for (const SceneFile::Tissue& tissue : scene.tissues())
      if (!json.at(Json::json_pointer(tissue.path)).contains("model")) scene.without_model.push_back(tissue.path);
    scene.diagonals = static_cast<Diagonals>(
        std::ranges::find(diagonals_names, json.at("diagonals").get<std::string>()) - diagonals_names.begin());
    if (json.contains("bending"))
      scene.bending = {.rigidity = json.at("bending").value("rigidity", 0.0),
                       .second_neighbours = json.at("bending").value("second_neighbours", 0.0)};
    scene.gravity = point(json.at("gravity"));
    scene.initial_velocity = velocity(json.at("initial_velocity"));
    for (std::size_t k = 0; k < json.at("fixed").size(); ++k)
      scene.fixed.push_back(hold(json.at("fixed")[k], fmt::format("/fixed/{}", k)));
    for (std::size_t k = 0; k < json.at("driven").size(); ++k)
      scene.driven.push_back(drive(json.at("driven")[k], fmt::format("/driven/{}", k), scene));
    for (std::size_t k = 0; k < json.at("forces").size(); ++k)
      scene.forces.push_back(force(json.at("forces")[k], fmt::format("/forces/{}", k), scene));
    if (json.contains("contact")) contact(json.at("contact"), scene);
    scene.integrator = json.value("integrator", scene.accuracy ? "" : standard_integrator);
    scene.solver = json.value("solver", "");
    const Json& unstable = json.at("unstable_step");
    scene.unstable_step = unstable == "refuse"    ? UnstableStep::refuse
                          : unstable == "substep" ? UnstableStep::substep
                                                  : UnstableStep::warn;
    scene.exact_events = json.at("event_times") == "exact";
    for (std::size_t k = 0; k < json.at("events").size(); ++k)
      scene.events.push_back(event(json.at("events")[k], fmt::format("/events/{}", k), scene));
    require_consistent(scene);
    const Json& output = json.at("output");
    const auto take_every = [&output](const char* key, auto& time, auto& steps) {
      if (!output.contains(key)) return;
      if (const Json& every = output.at(key); every.is_number())
        time = every.get<double>();
      else
        steps = every.at("steps").get<std::uint64_t>();
    };
    take_every("frames_every", scene.output.frame_time, scene.output.frame_steps);
    take_every("diagnostics_every", scene.output.diagnostic_time, scene.output.diagnostic_steps);
    take_every("probes_every", scene.output.probe_time, scene.output.probe_steps);
    if (output.contains("checkpoint")) scene.output.checkpoint_time = output.at("checkpoint").get<double>();
    const auto has_field = [&fields = output.at("fields")](const char* name) {
      return std::ranges::find(fields, Json(name)) != fields.end();
    };
    scene.output.fields = {.held = has_field("held"),
                           .stress = has_field("stress"),
                           .displacement = has_field("displacement"),
                           .springs = has_field("springs"),
                           .contact = has_field("contact")};
    if (scene.output.fields.springs && !has_springs(scene))
      fail("/output/fields", "has \"springs\", and the body is made of elements", "fields without it");
    if (scene.output.fields.contact && !scene.has_contact())
      fail("/output/fields", "has \"contact\" without /contact", "obstacles or bodies that touch, or no such field");
    for (std::size_t k = 0; k < output.at("probes").size(); ++k)
      scene.probes.push_back(probe(output.at("probes")[k], fmt::format("/output/probes/{}", k), scene.probes));
    if (!scene.accuracy) scene.output = scene.output.in_steps_of(scene.step);
    scene.expect = expectation(json.at("expect"), scene);
    return scene;
  }

 private:
  [[noreturn]] void fail(const std::string& path, std::string_view found, std::string_view expected) const {
    throw InputError(fmt::format("{}: {}: {}; expected {}", name_, path, found, expected));
  }

  static Eigen::Vector3d point(const Json& json) {
    return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
  }

  static std::vector<Eigen::Vector3d> points(const Json& json) {
    std::vector<Eigen::Vector3d> all;
    for (const Json& one : json) all.push_back(point(one));
    return all;
  }

  // The elements of a map are numbered in 32 bits.
  void require_room(const Json& cells, const std::string& path, std::uint64_t most) const {
    double count = 1.0;
    for (const Json& along : cells) count *= along.get<double>();
    if (count > static_cast<double>(most))
      fail(path, fmt::format("is {}, {:.0f} in all", shown(cells), count), fmt::format("at most {} in all", most));
  }

  Eigen::Matrix3d rotation(const Json& body, const std::string& path) const {
    if (!body.contains("rotate")) return Eigen::Matrix3d::Identity();
    const Json& rotate = body.at("rotate");
    const double degrees = rotate.at("degrees");
    return Eigen::AngleAxisd(degrees * (std::numbers::pi / 180.0), direction(rotate.at("axis"), path + "/rotate/axis"))
        .toRotationMatrix();
  }

  Material material(const Json& json, const std::string& path) const {
    Material material{.density = json.at("density"),
                      .stiffness = json.at("stiffness"),
                      .damping = json.at("damping").is_number() ? json.at("damping").get<double>() : 0.0,
                      .viscosity = json.value("viscosity", 0.0),
                      .young = json.value("young", 0.0),
                      .poisson = json.value("poisson", Material{}.poisson),
                      .model = model(json, path)};
    if (material.model != Model::springs) material.stiffness = material.damping = 0.0;
    if (json.at("damping").is_object()) material.damping_time = damping_time(json.at("damping"), path, material.model);
    return material;
  }

  double damping_time(const Json& damping, const std::string& path, Model model) const {
    if (model == Model::springs)
      fail(path + "/damping", "is " + shown(damping) + " without 'poisson'",
           "a number of N s/m of each spring, or elements");
    constexpr double longest = 1e9;  // [s]: a relaxation longer than any run is a mistake in a unit
    const double time = damping_time_of(damping.at("ratio"), damping.at("frequency"));
    if (!(time <= longest))
      fail(path + "/damping", fmt::format("has a ratio / (pi frequency) of {:.3g} s", time),
           fmt::format("at most {:.0e} s", longest));
    return time;
  }

  BodySource one_body(const Json& json, const std::string& path) const {
    BodySource source = body(json, path);
    if (std::holds_alternative<ChainMesh>(source.mesh))
      fail(path + "/generate/chain", "is a chain", "cells, or a chain alone in its scene");
    if (json.contains("material")) source.material = material(json.at("material"), path + "/material");
    if (json.contains("initial_velocity")) source.velocity = velocity(json.at("initial_velocity"));
    return source;
  }

  /// Elements have a Young's modulus and a Poisson's ratio; springs have no 'poisson', their ratio is fixed.
  Model model(const Json& material, const std::string& path) const {
    const bool has_ratio = material.contains("poisson");
    Model model = has_ratio ? Model::neo_hookean : Model::springs;
    if (material.contains("model"))
      model = static_cast<Model>(std::ranges::find(model_names, material.at("model").get<std::string>()) -
                                 model_names.begin());
    if (model == Model::springs && has_ratio)
      fail(path + "/poisson",
           "cannot be combined with the model \"springs\", which have a ratio of 1/4, or 1/3 in a surface",
           "another model, or no 'poisson'");
    if (model != Model::springs && !has_ratio)
      fail(path + "/model", "is " + shown(material.at("model")) + " without 'poisson'",
           "'young' and 'poisson' together with it");
    if (model != Model::springs && !material.contains("young"))
      fail(path + "/poisson", "is given without 'young'", "Young's modulus together with it");
    return model;
  }

  BodySource body(const Json& json, const std::string& path) const {
    BodySource source{
        {}, json.at("scale"), point(json.at("translate")), json.at("touching") == "split", rotation(json, path)};
    source.path = path;
    if (json.contains("weld")) source.weld = json.at("weld").get<double>();
    if (json.contains("mesh")) {
      source.mesh = folder_ / json.at("mesh").get<std::string>();
      return source;
    }
    if (source.weld) fail(path + "/weld", "is given for a mesh that is generated", "'mesh', or no 'weld'");
    const Json& generate = json.at("generate");
    if (generate.contains("box")) {
      const Json& box = generate.at("box");
      source.mesh = BoxMesh{box.at("cells"),  box.at("spacing"), box.at("kind"),
                            box.at("jitter"), box.at("seed"),    box.at("pattern")};
      // six tetrahedra to a cube; of mixed cells at most as many darts as seven pyramids have (mixed_box)
      const std::uint64_t most = box.at("kind") == "tetrahedra"  ? most_tetrahedra / 6
                                 : box.at("kind") == "hexahedra" ? most_darts(3) / darts_of(CellKind::hexahedron)
                                                                 : most_darts(3) / (7 * darts_of(CellKind::pyramid));
      require_room(box.at("cells"), path + "/generate/box/cells", most);
      if (box.at("kind") != "tetrahedra" && box.at("jitter").get<double>() != 0.0)
        fail(path + "/generate/box/jitter", "is " + shown(box.at("jitter")), "0: only boxes of tetrahedra can have it");
    } else if (generate.contains("sheet")) {
      const Json& sheet = generate.at("sheet");
      source.mesh = SheetMesh{sheet.at("cells"), sheet.at("spacing"), sheet.at("kind")};
      const std::uint64_t darts =
          sheet.at("kind") == "triangles" ? 2 * darts_of(CellKind::triangle) : darts_of(CellKind::quadrilateral);
      require_room(sheet.at("cells"), path + "/generate/sheet/cells", most_darts(2) / darts);
    } else if (generate.contains("ball")) {
      source.mesh = BallMesh{generate.at("ball").at("layers"), generate.at("ball").at("radius")};
    } else {
      source.mesh = ChainMesh{generate.at("chain").at("links"), generate.at("chain").at("spacing")};
    }
    return source;
  }

  static InitialVelocity velocity(const Json& json) {
    if (json.is_array()) return {.constant = point(json)};
    InitialVelocity v{.constant = point(json.at("constant")), .centre = point(json.at("centre"))};
    for (int r = 0; r < 3; ++r) v.linear.row(r) = point(json.at("linear")[static_cast<std::size_t>(r)]);
    return v;
  }

  /// The direction with length 1, whatever its length in the file.
  Eigen::Vector3d direction(const Json& json, const std::string& path) const {
    Eigen::Vector3d d = point(json);
    const double largest = d.lpNorm<Eigen::Infinity>();
    if (largest == 0.0) fail(path, "is " + shown(json), "a direction, of a length other than 0");
    // the square of a length must not overflow, nor lose digits; others keep their bits
    if (largest > 1e150 || largest < 1e-140) d /= largest;
    return d / d.norm();
  }

  PlaneSelection plane(const Json& json, const std::string& path) const {
    PlaneSelection plane{point(json.at("point")), direction(json.at("normal"), path + "/normal")};
    return plane;
  }

  template <class Selection>
  std::optional<Selection> region(const Json& json, const std::string& path) const {
    if constexpr (std::is_constructible_v<Selection, IdSelection>) {
      if (json.contains("ids")) return IdSelection{json.at("ids").get<std::vector<std::uint32_t>>()};
      if (json.contains("plane")) return plane(json.at("plane"), path + "/plane");
    }
    if (json.contains("sphere"))
      return SphereSelection{point(json.at("sphere").at("centre")), json.at("sphere").at("radius")};
    if (json.contains("around")) {
      const Json& around = json.at("around");
      return AroundSelection{{points(around.at("path")), point(around.at("depth"))}, around.at("distance")};
    }
    if (!json.contains("box")) return {};
    const BoxSelection box{point(json.at("box").at("min")), point(json.at("box").at("max"))};
    for (int k = 0; k < 3; ++k)
      if (box.min[k] > box.max[k])
        fail(path + "/box", fmt::format("has a min[{}] of {} and a max[{}] of {}", k, box.min[k], k, box.max[k]),
             "no min above its max");
    return box;
  }

  CellSelection cells(const Json& json, const std::string& path) const {
    if (const auto selection = region<CellSelection>(json, path)) return *selection;
    if (json.contains("tag")) {
      const Json& tag = json.at("tag");
      if (tag.contains("named")) return TagSelection{tag.at("of"), tag.at("named").get<std::string>()};
      return TagSelection{tag.at("of"), tag.at("value").get<std::int32_t>()};
    }
    return RandomSelection{json.at("random").at("count"), json.at("random").at("seed")};
  }

  HeldSelection hold(const Json& json, const std::string& path) const {
    HeldSelection hold{region<VertexSelection>(json, path).value(), 0};
    for (const Json& axis : json.at("axes"))
      hold.axes |= axis == "x" ? HeldAxes{1} : axis == "y" ? HeldAxes{2} : HeldAxes{4};
    return hold;
  }

  SceneDrive drive(const Json& json, const std::string& path, const SceneFile& scene) const {
    SceneDrive drive{
        region<VertexSelection>(json, path).value(), velocity(json.at("velocity")), json.at("from"), {}, {}, path};
    if (json.contains("reverse_every")) drive.reverse_every = json.at("reverse_every").get<double>();
    drive.until = until_of(json, path, drive.from, scene);
    return drive;
  }

  SceneForce force(const Json& json, const std::string& path, const SceneFile& scene) const {
    SceneForce force{region<VertexSelection>(json, path).value(), {}, {}, json.at("from"), {}, path};
    if (json.contains("force"))
      force.force = point(json.at("force"));
    else
      force.pressure = json.at("pressure").get<double>();
    force.until = until_of(json, path, force.from, scene);
    return force;
  }

  void contact(const Json& json, SceneFile& scene) const {
    const ContactLaw law{.pressure = json.at("pressure"),
                         .depth = json.at("depth"),
                         .exponent = json.at("exponent"),
                         .restitution = json.at("restitution"),
                         .friction = json.at("friction"),
                         .mass_behind = json.at("mass_behind")};
    for (const Json& one : json.at("obstacles"))
      scene.obstacles.push_back(
          obstacle(one, law, fmt::format("/contact/obstacles/{}", scene.obstacles.size()), scene));
    touches(json, law, scene);
    if (!scene.has_contact())
      fail("/contact", "has no obstacle and no bodies that touch", "'obstacles', 'bodies' or 'pairs', or no 'contact'");
  }

  /// The touches by 'bodies' for all pairs, then those by 'pairs' for some.
  void touches(const Json& json, const ContactLaw& law, SceneFile& scene) const {
    constexpr std::size_t most_bodies = 1000;  // their pairs make a table
    const std::size_t bodies = scene.bodies().size();
    const std::string which = json.at("bodies");
    if (which == "others" && bodies == 1)
      fail("/contact/bodies", "is \"others\" with only one body", "\"themselves\", \"all\", or several bodies");
    if ((which != "none" || !json.at("pairs").empty()) && bodies > most_bodies)
      fail("/contact", fmt::format("has bodies that touch among {}", bodies), fmt::format("at most {}", most_bodies));
    std::map<std::pair<std::uint32_t, std::uint32_t>, SceneTouch> all;
    for (std::uint32_t a = 0; a < bodies && which != "none"; ++a)
      for (std::uint32_t b = a; b < bodies; ++b)
        if (a == b ? which != "others" : which != "themselves") all[{a, b}] = {a, b, law, "/contact/bodies"};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> named;
    for (std::size_t k = 0; k < json.at("pairs").size(); ++k) {
      const Json& pair = json.at("pairs")[k];
      const std::string path = fmt::format("/contact/pairs/{}", k);
      const std::array<std::uint32_t, 2> of = pair.at("of");
      for (const std::uint32_t body : of)
        if (body >= bodies)
          fail(path + "/of", "is " + shown(pair.at("of")), fmt::format("numbers below {}, of the bodies", bodies));
      const auto [first, second] = std::minmax(of[0], of[1]);
      const auto [place, is_new] = named.insert({{first, second}, path});
      if (!is_new)
        fail(path + "/of", fmt::format("is {}, like {}/of", shown(pair.at("of")), place->second), "each pair once");
      SceneTouch touch{first, second, law, path};
      touch.law.pressure = pair.value("pressure", law.pressure);
      touch.law.depth = pair.value("depth", law.depth);
      touch.law.restitution = pair.value("restitution", law.restitution);
      touch.law.friction = pair.value("friction", law.friction);
      if (pair.at("touch") == "yes")
        all[{first, second}] = std::move(touch);
      else
        all.erase({first, second});
    }
    for (auto& [pair, touch] : all) scene.touches.push_back(std::move(touch));
  }

  SceneObstacle obstacle(const Json& json, const ContactLaw& law, const std::string& path,
                         const SceneFile& scene) const {
    SceneObstacle made{{}, law, path};
    made.law.pressure = json.value("pressure", law.pressure);
    made.law.depth = json.value("depth", law.depth);
    made.law.restitution = json.value("restitution", law.restitution);
    made.law.friction = json.value("friction", law.friction);
    if (json.contains("plane")) {
      const PlaneSelection side = plane(json.at("plane"), path + "/plane");
      made.obstacle.shape = HalfSpace{side.point, side.normal};
    } else {
      const CutRegion inside = region<CutRegion>(json, path).value();
      if (const auto* ball = std::get_if<SphereSelection>(&inside)) {
        if (ball->radius == 0.0) fail(path + "/sphere/radius", "is 0 m", "a ball that has an inside");
        made.obstacle.shape = Ball{ball->centre, ball->radius};
      } else {
        const auto& box = std::get<BoxSelection>(inside);
        for (int k = 0; k < 3; ++k)
          if (box.min[k] == box.max[k])
            fail(path + "/box", fmt::format("has a min[{}] and a max[{}] of {}", k, k, box.min[k]),
                 "a box that has an inside");
        made.obstacle.shape = Block{box.min, box.max};
      }
    }
    made.obstacle.velocity = point(json.at("velocity"));
    if (!(made.obstacle.velocity.stableNorm() <= speed_of_light))
      fail(path + "/velocity", fmt::format("is {:.6g} m/s", made.obstacle.velocity.stableNorm()),
           "no speed above that of light");
    made.obstacle.from = json.at("from");
    made.obstacle.until = json.value("until", made.obstacle.until);
    if (!(made.obstacle.from < made.obstacle.until))
      fail(path + "/until", fmt::format("is {} s", made.obstacle.until),
           fmt::format("a time after that of 'from', {} s", made.obstacle.from));
    if (made.obstacle.from >= scene.duration && json.at("from").get<double>() > 0.0)
      fail(path + "/from", fmt::format("is {} s", made.obstacle.from),
           fmt::format("a time before the duration of {} s", scene.duration));
    return made;
  }

  /// The end of an action that begins at `from`; no value if it is not before the end of the scene.
  std::optional<double> until_of(const Json& json, const std::string& path, double from, const SceneFile& scene) const {
    if (from >= scene.duration)
      fail(path + "/from", fmt::format("is {} s", from),
           fmt::format("a time before the duration of {} s", scene.duration));
    const double until = json.value("until", scene.duration);
    const bool ends = json.contains("until") && until <= scene.duration;
    if (until <= from || (ends && !scene.accuracy && step_of_time(until, scene.step) == step_of_time(from, scene.step)))
      fail(path + "/until", fmt::format("leaves the time from {} to {} s", from, until), "at least one step");
    return ends ? std::optional(until) : std::nullopt;
  }

  Probe probe(const Json& json, const std::string& path, const std::vector<Probe>& others) const {
    Probe probe{json.at("name").get<std::string>(), {}, path};
    for (const Probe& other : others)
      if (other.name == probe.name)
        fail(path + "/name", fmt::format("is {}, like {}/name", shown(json.at("name")), other.path),
             "a name of its own");
    if (probe.name.empty()) fail(path + "/name", "is empty", "a name");
    if (json.contains("vertex"))
      probe.vertex = json.at("vertex").get<std::uint32_t>();
    else
      probe.vertex = point(json.at("near"));
    return probe;
  }

  SceneEvent event(const Json& json, const std::string& path, const SceneFile& scene) const {
    SceneEvent event;
    event.path = path;
    const bool by_stress = json.contains("tear_where_stressed");
    if (json.contains("refine") && json.at("refine").contains("bracing") && !has_springs(scene))
      fail(path + "/refine/bracing", "is " + shown(json.at("refine").at("bracing")),
           "no such key: a body of elements has no springs");
    if (json.contains("at")) {
      event.from = event.until = json.at("at");
    } else {
      event.from = json.at("from");
      event.until = json.value("until", scene.duration);
      if (json.contains("every")) event.every = json.at("every").get<double>();
      if (!event.every && !by_stress && !json.contains("until"))
        fail(path, "has no time", "'at', or 'every', 'from' and 'until'");
      if (event.until < event.from)
        fail(path + "/until", fmt::format("is {} s", event.until),
             fmt::format("no time before that of 'from', {} s", event.from));
    }
    if (event.from > scene.duration)
      fail(path + (json.contains("at") ? "/at" : "/from"), fmt::format("is {} s", event.from),
           fmt::format("a time within the duration of {} s", scene.duration));
    event.until = std::min(event.until, scene.duration);
    event.action = action(json, path);
    return event;
  }

  BladeSweep sweep(const Json& json, const std::string& path) const {
    BladeSweep sweep{points(json.at("path")), point(json.at("depth"))};
    for (std::size_t k = 0; k + 1 < sweep.path.size(); ++k) {
      const Eigen::Vector3d leg = sweep.path[k + 1] - sweep.path[k];
      // the side of a parallelogram thinner than this cannot be decided
      if (!(leg.cross(sweep.depth).norm() > 1e-12 * leg.norm() * sweep.depth.norm()))
        fail(fmt::format("{}/path/{}", path, k + 1), "is where the point before it is, or along the depth from there",
             "a leg that the blade sweeps an area on");
    }
    return sweep;
  }

  PolygonSelection polygon(const Eigen::Vector3d& along, std::vector<Eigen::Vector3d> corners,
                           const std::string& path) const {
    double twice_area = 0.0, around = 0.0;  // twice_area: the largest of a triangle with the first corner
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Eigen::Vector3d &here = corners[k], &next = corners[(k + 1) % corners.size()];
      twice_area = std::max(twice_area, std::abs((here - corners[0]).cross(next - corners[0]).dot(along)));
      around += (next - here).norm();
    }
    constexpr double flat = 1e-9;
    if (!(twice_area > flat * around * around))
      fail(path, "has no area as seen along the plane's normal", "corners that enclose one");
    return {along, std::move(corners)};
  }

  static bool has_springs(const SceneFile& scene) {
    return scene.diagonals != Diagonals::none ||
           std::ranges::any_of(scene.tissues(),
                               [](const SceneFile::Tissue& tissue) { return tissue.material.model == Model::springs; });
  }

  Action action(const Json& json, const std::string& path) const {
    if (json.contains("release"))
      return Release{region<VertexSelection>(json.at("release"), path + "/release").value()};
    if (json.contains("remove")) return Remove{cells(json.at("remove"), path + "/remove")};
    if (json.contains("dissociate")) {
      const Json& faces = json.at("dissociate");
      if (faces.contains("points"))
        return Dissociate{faces.at("points").get<std::vector<std::vector<std::uint32_t>>>()};
      if (faces.contains("blade")) return Dissociate{sweep(faces.at("blade"), path + "/dissociate/blade")};
      const PlaneSelection seam = plane(faces.at("plane"), path + "/dissociate/plane");
      Dissociate cut{seam};
      if (faces.contains("within")) {
        const Json& within = faces.at("within");
        if (within.contains("polygon"))
          cut.within = polygon(seam.normal, points(within.at("polygon")), path + "/dissociate/within/polygon");
        else
          cut.within = region<CutRegion>(within, path + "/dissociate/within");
      }
      return cut;
    }
    if (json.contains("tear")) {
      const Json& tear = json.at("tear");
      const Eigen::Vector3d toward = direction(tear.at("direction"), path + "/tear/direction");
      if (tear.contains("vertex")) return Tear{tear.at("vertex").get<std::uint32_t>(), toward};
      return Tear{point(tear.at("near")), toward};
    }
    if (json.contains("refine")) {
      const Json& refine = json.at("refine");
      return Refine{cells(refine.at("cells"), path + "/refine/cells"), refine.at("at") == "centre",
                    refine.value("bracing", 0.5)};
    }
    const Json& stress = json.at("tear_where_stressed");
    TearWhereStressed tear{stress.at("threshold"), {}, {}};
    if (stress.contains("most_per_step")) tear.most_per_step = stress.at("most_per_step").get<std::size_t>();
    if (stress.contains("plane")) tear.seam = plane(stress.at("plane"), path + "/tear_where_stressed/plane");
    return tear;
  }

  // A seam is a set of faces of the body at rest, and refinement replaces faces. A vertex that it puts between driven
  // ones would have no path of its own, and one between fixed ones would never be released.
  void require_consistent(const SceneFile& scene) const {
    if (!scene.solver.empty()) {
      if (scene.integrator.empty())
        fail("/solver", fmt::format("is \"{}\" without an 'integrator'", scene.solver), "an implicit one to be named");
      try {
        make_integrator(scene.integrator, scene.solver);
      } catch (const InputError& error) {
        fail("/solver", error.what(), "one of those as 'integrator', or no 'solver'");
      }
    }
    if (scene.is_chain() && !scene.regions.empty())
      fail("/regions", "cannot be combined with /body/generate/chain, which has no cells", "no such key");
    for (const SceneFile::Tissue& tissue : scene.tissues()) {
      if (tissue.material.model == Model::springs) continue;
      if (scene.is_chain()) fail(tissue.path + "/poisson", "cannot be combined with /body/generate/chain", "cells");
    }
    if (const std::string key(scene.key_beside_edges()); !key.empty() && scene.is_chain())
      fail(key, "cannot be combined with /body/generate/chain, which has no cells", "cells");
    if (scene.has_contact()) {
      if (scene.is_chain())
        fail("/contact", "cannot be combined with /body/generate/chain, which has no surface", "cells");
      if (scene.accuracy)
        fail("/accuracy", "cannot be combined with /contact, which changes motions after the part that short runs see",
             "'step' in its place");
    }
    if (!scene.touches.empty() && scene.integrator == "energy-momentum")
      fail(scene.touches.front().path,
           "cannot be combined with the integrator \"energy-momentum\", whose forces are not defined where "
           "depths have kinks",
           "another integrator, or only obstacles");
    if (scene.exact_events && !scene.driven.empty())
      fail("/event_times", "is \"exact\" together with /driven, which turns only at steps", "\"steps\"");
    for (const SceneForce& force : scene.forces)
      if (scene.exact_events && !force.lasts())
        fail("/event_times",
             fmt::format("is \"exact\" together with {}, which begins or ends only at steps", force.path), "\"steps\"");
    if (scene.is_chain())
      for (const SceneForce& force : scene.forces)
        if (force.pressure)
          fail(force.path + "/pressure", "cannot be combined with /body/generate/chain, which has no faces", "'force'");
    if (scene.accuracy && scene.material.stiffness == 0.0 && scene.material.damping > 0.0)
      fail("/accuracy", "cannot be combined with /material/stiffness of 0 and a damping", "'step' in its place");
    const SceneEvent *seam = nullptr, *refinement = nullptr, *release = nullptr;
    for (const SceneEvent& event : scene.events) {
      if (scene.is_chain() && changes_topology(event.action))
        fail(fmt::format("{}/{}", event.path, key_of(event.action)), "needs cells, which a chain does not have",
             "no such event");
      const auto* stress = std::get_if<TearWhereStressed>(&event.action);
      if (stress != nullptr && stress->seam) seam = &event;
      if (std::holds_alternative<Refine>(event.action)) refinement = &event;
      if (std::holds_alternative<Release>(event.action)) release = &event;
    }
    if (seam != nullptr && refinement != nullptr)
      fail(refinement->path + "/refine",
           fmt::format("cannot be combined with {}/tear_where_stressed/plane", seam->path),
           "no refinement where a seam is given");
    if (refinement != nullptr && release != nullptr)
      fail(refinement->path + "/refine", fmt::format("cannot be combined with {}/release", release->path),
           "no refinement where fixed vertices are released");
    if (refinement != nullptr && !scene.driven.empty())
      fail(refinement->path + "/refine", "cannot be combined with /driven", "no refinement where vertices are driven");
    if (refinement != nullptr && !scene.forces.empty())
      fail(refinement->path + "/refine",
           "cannot be combined with /forces: it takes mass from the vertices that share them",
           "no refinement where forces are applied");
  }

  ExpectedPlace place(const Json& json, const std::string& path, const std::vector<Probe>& probes) const {
    const auto name = json.at("probe").get<std::string>();
    for (std::size_t k = 0; k < probes.size(); ++k)
      if (probes[k].name == name)
        return {k, point(json.at("position")), json.at("within"), json.at("of") == "part", json.at("why")};
    fail(path + "/probe", "is " + shown(json.at("probe")), "the name of one of /output/probes");
  }

  Expectation expectation(const Json& json, const SceneFile& scene) const {
    Expectation e;
    for (std::size_t k = 0; k < json.at("places").size(); ++k)
      e.places.push_back(place(json.at("places")[k], fmt::format("/expect/places/{}", k), scene.probes));
    const auto take = [&json](const char* key, auto& into) {
      if (json.contains(key)) into = json.at(key).get<typename std::decay_t<decltype(into)>::value_type>();
    };
    take("vertices", e.vertices);
    take("edges", e.edges);
    take("faces", e.faces);
    take("cells", e.cells);
    take("components", e.components);
    take("components_at_least", e.components_at_least);
    take("operations", e.operations);
    take("mass", e.mass);
    e.why = json.at("why");
    take("kinetic_at_most", e.kinetic_at_most);
    take("energy_drift_at_most", e.energy_drift_at_most);
    if (e.energy_drift_at_most) {
      std::string taker = scene.material.damping > 0.0     ? "/material/damping"
                          : scene.material.viscosity > 0.0 ? "/material/viscosity"
                          : !scene.driven.empty()          ? "/driven"
                          : !scene.events.empty()          ? "/events"
                                                           : "";
      for (const SceneFile::Tissue& tissue : scene.tissues())
        if (taker.empty() && tissue.material.damping_time > 0.0) taker = tissue.path + "/damping";
      if (!std::ranges::all_of(scene.forces, &SceneForce::lasts)) taker = "/forces";
      for (const SceneObstacle& one : scene.obstacles) {
        if (!taker.empty()) break;
        if (one.law.restitution < 1.0) taker = one.path + "/restitution";
        if (one.law.friction > 0.0) taker = one.path + "/friction";
        if (one.moves()) taker = one.path + "/velocity";
      }
      for (const SceneTouch& touch : scene.touches) {
        if (!taker.empty()) break;
        const std::string path = touch.path == "/contact/bodies" ? "/contact" : touch.path;
        if (touch.law.restitution < 1.0) taker = path + "/restitution";
        if (touch.law.friction > 0.0) taker = path + "/friction";
      }
      if (!taker.empty())
        fail("/expect/energy_drift_at_most", fmt::format("cannot be combined with {}, which changes the energy", taker),
             "damping and viscosity of 0, no driven vertices or events, and forces from start to end");
    }
    if (json.contains("hash")) {
      const auto digits = json.at("hash").get<std::string>();
      std::uint64_t value = 0;
      const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
      if (digits.size() != 16 || error != std::errc() || end != digits.data() + digits.size())
        fail("/expect/hash", "is " + shown(json.at("hash")), "16 hexadecimal digits");
      e.hash = value;
    }
    return e;
  }

  std::string name_;
  fs::path folder_;
};

}  // namespace

std::span<const BodySource> SceneFile::bodies() const {
  if (const auto* list = std::get_if<BodyList>(&body.mesh)) return list->all;
  return {&body, 1};
}

std::vector<SceneFile::Tissue> SceneFile::tissues() const {
  std::vector<Tissue> all{{material, "/material", true}};
  for (const BodySource& one : bodies())
    if (one.material) all.push_back({*one.material, one.path + "/material", true});
  for (const SceneRegion& region : regions) all.push_back({region.material, region.path + "/material", true});
  for (Tissue& tissue : all) tissue.names_model = std::ranges::find(without_model, tissue.path) == without_model.end();
  return all;
}

bool SceneFile::has_elements() const {
  return std::ranges::any_of(tissues(), [](const Tissue& tissue) { return tissue.material.model != Model::springs; });
}

bool SceneFile::holds_axes() const {
  return std::ranges::any_of(fixed, [](const HeldSelection& held) { return held.axes != all_axes; });
}

bool changes_topology(const Action& action) { return !std::holds_alternative<Release>(action); }

std::string_view key_of(const Action& action) {
  constexpr std::string_view keys[] = {"dissociate", "remove", "tear", "tear_where_stressed", "refine", "release"};
  return keys[action.index()];
}

OutputPlan OutputPlan::in_steps_of(double step) const {
  const auto steps = [step](const std::optional<std::uint64_t>& given, const std::optional<double>& time) {
    if (given || !time) return given;
    // far beyond the end of any run, so that the number of steps fits
    const double in_reach = std::min(*time, 2.0 * most_steps * step);
    return std::optional(std::max<std::uint64_t>(1, step_of_time(in_reach, step)));
  };
  return {.frame_steps = steps(frame_steps, frame_time),
          .diagnostic_steps = steps(diagnostic_steps, diagnostic_time),
          .probe_steps = steps(probe_steps, probe_time),
          .frame_time = {},
          .diagnostic_time = {},
          .probe_time = {},
          .checkpoint_time = {},
          .checkpoint_steps = steps(checkpoint_steps, checkpoint_time),
          .fields = fields};
}

bool Expectation::empty() const {
  return !vertices && !edges && !faces && !cells && !components && !components_at_least && !operations && !mass &&
         !kinetic_at_most && !energy_drift_at_most && places.empty() && !hash;
}

SceneFile parse_scene(std::string_view text, const std::string& name, const fs::path& folder) {
  const Json complete = check_and_complete(parse_strict_json(text, name), Shape::scene, name);
  SceneFile scene = Reader(name, folder).scene(complete);
  scene.text = text;
  scene.folder = folder;
  return scene;
}

SceneFile read_scene(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error))
    throw IoError(fmt::format("{}: there is no such file; expected a scene", path.string()));
  if (fs::is_directory(path, error)) throw IoError(fmt::format("{}: is a folder; expected a scene", path.string()));
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw IoError(fmt::format("{}: cannot be read; expected a scene", path.string()));
  SceneFile scene = parse_scene(text.str(), path.string(), path.parent_path());
  load_mesh(scene);
  return scene;
}

bool reseed(SceneFile& scene, std::uint64_t seed) {
  bool changed = false;
  scene.added_seed += seed;
  const auto reseed_cells = [seed, &changed](CellSelection& cells) {
    if (auto* random = std::get_if<RandomSelection>(&cells)) {
      random->seed += seed;
      changed = changed || seed != 0;
    }
  };
  for (SceneEvent& event : scene.events) {
    if (auto* remove = std::get_if<Remove>(&event.action)) reseed_cells(remove->cells);
    if (auto* refine = std::get_if<Refine>(&event.action)) reseed_cells(refine->cells);
  }
  return changed;
}

}  // namespace dartboard
