#include "validation/drawn/drawn_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/plain/error.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/run/simulation.h"
#include "core/time/integrators.h"
#include "validation/scenes/draw.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

/// The scales of a body that is drawn.
struct Scales {
  double edge = 1.0;                     // [m]
  double density = 1000.0;               // per volume, area or length
  double rate = 100.0;                   // [1/s] of its fastest oscillation, about
  Vector3d low{0, 0, 0}, high{0, 0, 0};  // [m]
  double mass = 0.0;                     // [kg]
  std::size_t points = 0, cells = 0;
};

class SceneOfAllKeys {
 public:
  SceneOfAllKeys(std::uint64_t seed, std::uint64_t number, std::uint64_t attempt)
      : draw_(seed + 7919 * attempt, number) {
    json_["name"] = fmt::format("drawn {} of seed {}", number, seed);
    is_free_ = happens(0.35);
    keeps_energy_ = happens(0.4);
    draw_integrator();
    draw_bodies();
    json_["gravity"] = {0, 0, 0};
    measure();
    draw_regions();
    draw_times();
    draw_motion();
    draw_supports();
    draw_forces();
    draw_attachments();
    draw_contact();
    draw_events();
    draw_sleep();
    draw_output();
    draw_air();
    // events may turn out to be impossible when they are due
    Simulation simulation(read());
    while (simulation.steps_done() < simulation.step_count() && !simulation.advance()) continue;
  }
  Json json() const { return json_; }

 private:
  template <class T>
  const T& one_of(const std::vector<T>& all) {
    return all[draw_.below(all.size())];
  }
  bool happens(double probability) { return draw_.happens(probability); }
  double number(double low, double high) { return written(draw_.logarithmic(low, high)); }
  SceneFile read() const { return parse_scene(json_.dump(), "drawn", ""); }
  double time(double low, double high) { return written(draw_.uniform(low, high) * duration_); }

  void draw_integrator() {
    std::vector<std::string> names;
    for (const IntegratorEntry& entry : integrators()) names.emplace_back(entry.name);
    json_["integrator"] = one_of(names);
    if (happens(0.3)) json_["solver"] = one_of<std::string>({"kept-factor", "fresh-factor", "conjugate-gradients"});
  }

  // ---- bodies

  Json draw_mesh(double edge) {
    const int kind = draw_.whole(0, solids_ ? 3 : 6);
    const auto few = [this](int most) { return draw_.whole(1, most); };
    if (kind <= 2) {
      dimension_ = 3;
      Json box{{"cells", {few(3), few(2), few(2)}}, {"spacing", edge}};
      const std::string cells = one_of<std::string>({"tetrahedra", "hexahedra", "mixed"});
      if (cells != "tetrahedra" || happens(0.5)) box["kind"] = cells;
      simplices_ = cells == "tetrahedra";
      if (simplices_ && happens(0.5)) box["jitter"] = written(draw_.uniform(0.0, 0.3));
      if (simplices_ && happens(0.5)) box["seed"] = draw_.below(1000);
      if (happens(0.5)) box["pattern"] = one_of<std::string>({"mirrored", "kuhn"});
      return {{"box", box}};
    }
    if (kind == 3) {
      dimension_ = 3;
      simplices_ = true;
      return {{"ball", {{"layers", few(2)}, {"radius", written(1.5 * edge)}}}};
    }
    if (kind <= 5) {
      dimension_ = 2;
      Json sheet{{"cells", {few(4), few(3)}}, {"spacing", edge}};
      if (happens(0.6)) sheet["kind"] = one_of<std::string>({"triangles", "quadrilaterals"});
      simplices_ = sheet.value("kind", "triangles") == "triangles";
      return {{"sheet", sheet}};
    }
    dimension_ = 1;
    return {{"chain", {{"links", few(7)}, {"spacing", edge}}}};
  }

  Json draw_body(double edge, const Vector3d& place) {
    const double scale = happens(0.3) ? number(0.7, 1.4) : 1.0;
    Json body{{"generate", draw_mesh(written(edge / scale))}};
    if (scale != 1.0) body["scale"] = scale;
    if (happens(0.4))
      body["rotate"] = {{"axis", json_of(draw_.direction())}, {"degrees", written(draw_.uniform(-180, 180))}};
    if (happens(0.4) || !place.isZero(0.0)) body["translate"] = json_of(place + 0.1 * edge * draw_.direction());
    if (happens(0.1)) body["touching"] = one_of<std::string>({"split", "refuse"});
    return body;
  }

  /// What resists in a body of `dimension_`: its rate is about that of the scales.
  Json draw_material(const Scales& scales, bool with_viscosity) {
    const double density = written(scales.density * draw_.uniform(0.7, 1.4));
    const double young = density * scales.edge * scales.edge * scales.rate * scales.rate * draw_.logarithmic(0.3, 3.0);
    const double stiffness = young * std::pow(scales.edge, dimension_ - 2);
    Json material{{"density", density}};
    const bool elements = dimension_ > 1 && happens(0.5);
    if (elements) {
      material["young"] = written(young);
      material["poisson"] = written(draw_.uniform(0.0, 0.45));
      if (happens(0.7)) material["model"] = one_of<std::string>({"neo-hookean", "corotational", "stvk"});
      if (dimension_ == 3 && !keeps_energy_ && happens(0.4))
        material["damping"] = {{"ratio", number(0.01, 0.3)},
                               {"frequency", number(0.05 * scales.rate, 0.3 * scales.rate)}};
    } else {
      if (happens(0.5) && simplices_)
        material["young"] = written(young);
      else
        material["stiffness"] = written(stiffness);
      if (happens(0.1)) material["model"] = "springs";
      material["damping"] =
          keeps_energy_ || happens(0.3) ? 0.0 : written(draw_.logarithmic(0.01, 0.3) * stiffness / scales.rate);
    }
    if (dimension_ == 1 && happens(0.7)) material["width"] = written(0.3 * scales.edge);
    if (with_viscosity)
      material["viscosity"] =
          is_free_ || keeps_energy_ || happens(0.3) ? 0.0 : number(0.001 * scales.rate, 0.02 * scales.rate);
    return material;
  }

  void draw_bodies() {
    scales_.edge = number(1e-3, 10.0);
    scales_.density = number(10.0, 1e4);
    scales_.rate = draw_.logarithmic(10.0, 1e4);
    several_ = happens(0.5);
    solids_ = several_ && happens(0.5);
    if (!several_) {
      json_["body"] = draw_body(scales_.edge, {0, 0, 0});
      json_["material"] = draw_material(scales_, true);
      if (dimension_ < 3 || !simplices_) {
        if (happens(0.3)) json_["diagonals"] = one_of<std::string>({"none", "faces", "volumes", "all"});
      }
      if (dimension_ == 2 && happens(0.4)) {
        const double bends = scales_.density * std::pow(scales_.edge, 4) * scales_.rate * scales_.rate;
        json_["bending"] = happens(0.5)
                               ? Json{{"rigidity", written(0.02 * bends)}}
                               : Json{{"second_neighbours", written(0.1 * bends / (scales_.edge * scales_.edge))}};
      }
      return;
    }
    // in a row along x, a gap of some hundredths of an edge between those that are not turned
    const int count = happens(0.1) ? 1 : draw_.whole(2, 3);
    double end = 0.0;
    json_["bodies"] = Json::array();
    for (int k = 0; k < count; ++k) {
      Json body = draw_body(scales_.edge, {0, 0, 0});
      // about x a body keeps its place in the row
      body.erase("rotate");
      if (happens(0.3)) body["rotate"] = {{"axis", {1, 0, 0}}, {"degrees", written(draw_.uniform(-180, 180))}};
      const Json& mesh = body["generate"];
      const bool ball = mesh.contains("ball");
      const double length = ball ? 3.0 * scales_.edge
                                 : scales_.edge * (mesh.contains("box")     ? mesh["box"]["cells"][0].get<int>()
                                                   : mesh.contains("sheet") ? mesh["sheet"]["cells"][0].get<int>()
                                                                            : mesh["chain"]["links"].get<int>());
      body["translate"] =
          json_of(Vector3d(end + (ball ? 0.5 * length : 0.0), 0.05 * scales_.edge * k, ball ? 0.5 * length : 0.0));
      end += length + 0.03 * scales_.edge;
      if (k == 0 || happens(0.7)) {
        body["material"] = draw_material(scales_, false);
      }
      json_["bodies"].push_back(body);
    }
    // of those without a material of their own
    json_["material"] = draw_material(scales_, true);
    json_["material"].erase("width");
  }

  /// Reads the body alone: where it is, and what it weighs; and finds the step.
  void measure() {
    json_["step"] = 1e-9;
    json_["duration"] = 0.0;
    Json bare = json_;
    // what an implicit method follows as well: the fastest oscillation
    const bool is_implicit = scheme_of(json_["integrator"].get<std::string>()).implicit;
    if (is_implicit) {
      bare["integrator"] = "verlet";
      bare.erase("solver");
    }
    const Simulation simulation(parse_scene(bare.dump(), "drawn", ""));
    const Frame frame = simulation.frame({});
    mesh_ = frame.mesh;
    scales_.low = scales_.high = frame.mesh.points.at(0);
    for (const Vector3d& x : frame.mesh.points) {
      scales_.low = scales_.low.cwiseMin(x);
      scales_.high = scales_.high.cwiseMax(x);
    }
    const Diagnostics diagnostics = simulation.diagnostics();
    scales_.mass = diagnostics.mass;
    scales_.points = frame.mesh.points.size();
    scales_.cells = frame.mesh.cell_count();
    const double limit = simulation.step_limit().stable;
    if (!(limit > 0.0) || !std::isfinite(limit)) throw InputError("nothing limits the step");
    step_ = written(limit * draw_.logarithmic(0.1, is_implicit ? 2.0 : 0.6));
    centre_ = 0.5 * (scales_.low + scales_.high);
    size_ = scales_.high - scales_.low;
  }

  void draw_times() {
    const int steps = draw_.whole(12, 40);
    json_["step"] = step_;
    duration_ = steps * step_;
    json_["duration"] = duration_;
    if (happens(0.3)) json_["unstable_step"] = one_of<std::string>({"warn", "refuse", "substep"});
    if (happens(0.5)) json_["event_times"] = one_of<std::string>({"steps", "exact"});
    speed_ = scales_.edge / duration_;
    acceleration_ = speed_ / duration_;
  }

  // ---- places

  Json plane(bool of_rest = true) {
    const Vector3d direction = draw_.direction();
    const double reach = 0.5 * size_.cwiseProduct(direction).cwiseAbs().sum();
    const double part = of_rest ? draw_.uniform(0.1, 0.9) : draw_.uniform(-0.5, 0.5);
    return plane_of(centre_ + part * reach * direction, direction);
  }
  Vector3d place() {
    const Vector3d some = draw_.direction() * draw_.uniform(0.0, 1.0);
    return centre_ + 0.5 * size_.cwiseProduct(some) + 0.01 * scales_.edge * draw_.direction();
  }
  Json around() {
    const Vector3d begin = place();
    Json value{{"path", {json_of(begin), json_of(place())}},
               {"distance", written(draw_.uniform(0.3, 1.2) * scales_.edge)}};
    if (happens(0.5)) value["depth"] = json_of(scales_.edge * draw_.direction());
    return value;
  }
  Json box_around(const Vector3d& middle, double reach) {
    const Vector3d half = reach * Vector3d(draw_.uniform(0.6, 1.2), draw_.uniform(0.6, 1.2), draw_.uniform(0.6, 1.2));
    return {{"min", json_of(middle - half)}, {"max", json_of(middle + half)}};
  }
  /// Keys that select some of `count` vertices or cells.
  Json selection(std::size_t count) {
    const int kind = draw_.whole(several_ || count == 0 ? 1 : 0, 4);
    if (kind == 0) {
      Json ids = Json::array();
      for (int k = draw_.whole(1, 4); k > 0; --k) {
        const auto id = draw_.below(count);
        if (std::ranges::find(ids, Json(id)) == ids.end()) ids.push_back(id);
      }
      return {{"ids", ids}};
    }
    if (kind == 1) return {{"plane", plane()}};
    if (kind == 2) return {{"box", box_around(place(), 1.2 * scales_.edge)}};
    if (kind == 3)
      return {{"sphere", {{"centre", json_of(place())}, {"radius", written(draw_.uniform(0.6, 1.5) * scales_.edge)}}}};
    return {{"around", around()}};
  }
  Json cells(bool with_random) {
    if (with_random && happens(0.25)) {
      Json random{{"count", draw_.whole(1, 3)}};
      if (happens(0.5)) random["seed"] = draw_.below(1000);
      return {{"random", random}};
    }
    return selection(scales_.cells);
  }

  // ---- what is in the scene

  void draw_regions() {
    if (dimension_ == 1 || several_ || !happens(0.25)) return;
    json_["regions"] = Json::array({{{"cells", cells(false)}, {"material", draw_material(scales_, false)}}});
    json_["regions"][0]["material"].erase("width");
  }

  Json velocity() {
    Json constant = json_of(speed_ * draw_.uniform(0.0, 0.5) * draw_.direction());
    if (happens(0.4)) return constant;
    Json value{{"constant", constant}};
    if (happens(0.8)) {
      Json rows = Json::array();
      for (int k = 0; k < 3; ++k) rows.push_back(json_of(0.2 / duration_ * draw_.direction()));
      value["linear"] = rows;
    }
    if (happens(0.8)) value["centre"] = json_of(centre_);
    return value;
  }

  void draw_motion() {
    json_["gravity"] = json_of(acceleration_ * draw_.uniform(0.0, 1.0) * draw_.direction());
    if (happens(0.1)) json_["gravity"] = {0, 0, 0};
    if (happens(0.8)) json_["initial_velocity"] = velocity();
    if (several_)
      for (Json& body : json_["bodies"])
        if (happens(0.4)) body["initial_velocity"] = velocity();
  }

  void draw_supports() {
    if (is_free_) return;
    if (happens(0.5)) {
      json_["fixed"] = Json::array();
      for (int k = draw_.whole(1, 2); k > 0; --k) {
        Json held = selection(scales_.points);
        if (happens(0.4)) held["axes"] = one_of<Json>({{"x"}, {"y"}, {"z"}, {"x", "z"}, {"x", "y", "z"}});
        if (held.contains("axes") && !held["axes"].is_array()) held["axes"] = Json::array({held["axes"]});
        json_["fixed"].push_back(held);
      }
    }
    if (!happens(0.35)) return;
    json_["driven"] = Json::array({drive(0.0)});
    if (!happens(0.4)) return;
    // the same vertices once more, or others
    const Json first = json_["driven"][0];
    const double end = first.contains("velocity") ? first.value("until", duration_) : duration_;
    Json second = drive(end);
    if (end < duration_ && happens(0.7))
      for (const char* key : {"ids", "plane", "box", "sphere", "around"}) {
        second.erase(key);
        if (first.contains(key)) second[key] = first[key];
      }
    json_["driven"].push_back(second);
  }

  /// At a velocity, which may begin at a time [s]; along a path, or about an axis.
  Json drive(double begin) {
    Json drive = selection(scales_.points);
    const int kind = draw_.whole(0, 2);
    if (kind == 0) {
      drive["velocity"] = velocity();
      if (begin > 0.0 && begin < duration_)
        drive["from"] = begin;
      else if (happens(0.5))
        drive["from"] = time(0.0, 0.4);
      if (begin == 0.0 && happens(0.5)) drive["until"] = time(0.5, 0.9);
      if (happens(0.4)) drive["reverse_every"] = time(0.1, 0.5);
    } else if (kind == 1) {
      drive["path"] = {{{"at", time(0.0, 0.3)}, {"place", json_of(centre_)}},
                       {{"at", time(0.4, 0.9)}, {"place", json_of(centre_ + 0.2 * scales_.edge * draw_.direction())}}};
    } else {
      drive["turn"] = {{"axis", json_of(draw_.direction())},
                       {"centre", json_of(centre_)},
                       {"angles",
                        {{{"at", time(0.0, 0.3)}, {"degrees", 0}},
                         {{"at", time(0.4, 0.9)}, {"degrees", written(draw_.uniform(-20, 20))}}}}};
    }
    return drive;
  }

  void draw_forces() {
    if (!happens(0.5)) return;
    json_["forces"] = Json::array();
    for (int k = draw_.whole(1, 2); k > 0; --k) {
      const double all = 2.0 * scales_.mass * acceleration_, width = size_.maxCoeff();
      Json force = happens(0.5) ? Json{{"plane", plane(false)}} : selection(scales_.points);
      const int kind = draw_.whole(0, 4);
      if (kind == 0) {
        force["force"] = json_of(all * draw_.uniform(0.1, 0.5) * draw_.direction());
        if (happens(0.4)) force["on"] = one_of<std::string>({"vertices", "faces", "edges"});
      } else if (kind == 1) {
        const bool edges = dimension_ == 2 && happens(0.4);
        force["traction"] =
            json_of(all / (edges ? width : width * width) * draw_.uniform(0.1, 0.5) * draw_.direction());
        if (edges || happens(0.4)) force["on"] = edges ? "edges" : "faces";
      } else if (kind == 2) {
        force["pressure"] = written(all / (width * width) * draw_.uniform(-0.5, 0.5));
        if (happens(0.6)) force["normals"] = one_of<std::string>({"at rest", "current"});
      } else if (kind == 3) {
        force["acceleration"] = json_of(acceleration_ * draw_.direction());
      } else {
        force["torque"] = json_of(0.1 * all * width * draw_.direction());
      }
      if (happens(0.3))
        force["over_time"] = {{{"at", time(0.0, 0.4)}, {"factor", written(draw_.uniform(-1, 1))}},
                              {{"at", time(0.5, 0.9)}, {"factor", written(draw_.uniform(-1, 1))}}};
      if (happens(0.3)) force["from"] = time(0.0, 0.4);
      if (happens(0.3)) force["until"] = time(0.5, 0.9);
      json_["forces"].push_back(force);
    }
  }

  void draw_attachments() {
    if (!happens(0.25)) return;
    Json one = selection(scales_.points);
    if (several_ && happens(0.6)) {
      one = {{"box", box_around(centre_, 1.2 * scales_.edge)}};
      one["to"] = draw_.below(json_["bodies"].size());
    }
    one["stiffness"] = written(scales_.mass * scales_.rate * scales_.rate * draw_.logarithmic(1e-3, 1e-2));
    if (is_free_ && !one.contains("to")) return;
    json_["attachments"] = Json::array({one});
  }

  void draw_air() {
    if (is_free_ || dimension_ == 1 || !happens(0.25)) return;
    const double share = scales_.mass / static_cast<double>(scales_.points);
    json_["air"]["drag"] =
        written(share * scales_.rate / (scales_.edge * scales_.edge) * draw_.logarithmic(1e-3, 3e-2));
    if (happens(0.6)) json_["air"]["velocity"] = json_of(speed_ * draw_.direction());
  }

  // ---- contact

  Json obstacle() {
    const Vector3d down = draw_.direction();
    const double reach = 0.5 * size_.cwiseProduct(down).cwiseAbs().sum(),
                 inside = draw_.uniform(-0.1, 0.1) * scales_.edge;
    const int kind = draw_.whole(0, 2);
    Json one;
    if (kind == 0) {
      one["plane"] = plane_of(centre_ + (reach - inside) * down, -down);
    } else if (kind == 1) {
      const double radius = draw_.uniform(1.0, 4.0) * scales_.edge;
      one["sphere"] = {{"centre", json_of(centre_ + (reach - inside + radius) * down)}, {"radius", written(radius)}};
    } else {
      const int along = draw_.whole(0, 2);
      Vector3d min = scales_.low - 0.3 * size_ - Vector3d::Constant(scales_.edge);
      Vector3d max = scales_.high + 0.3 * size_ + Vector3d::Constant(scales_.edge);
      if (happens(0.5))
        max[along] = scales_.low[along] + inside;
      else
        min[along] = scales_.high[along] - inside;
      one["box"] = {{"min", json_of(min)}, {"max", json_of(max)}};
    }
    if (happens(0.45)) {
      one["velocity"] = json_of(0.3 * speed_ * draw_.direction());
      if (happens(0.5)) one["from"] = time(0.0, 0.4);
      if (happens(0.5)) one["until"] = time(0.5, 0.9);
    }
    if (happens(0.4)) law(one);
    return one;
  }
  /// Some numbers of a law.
  void law(Json& value) {
    const double pressure =
        scales_.mass * acceleration_ / std::pow(size_.maxCoeff(), 2) * draw_.logarithmic(3.0, 100.0);
    if (happens(0.5)) value["pressure"] = written(pressure);
    if (happens(0.5)) value["depth"] = written(draw_.uniform(0.05, 0.2) * scales_.edge);
    if (happens(0.4)) value["restitution"] = written(draw_.uniform(0.1, 1.0));
    if (happens(0.4)) value["friction"] = written(draw_.uniform(0.0, 0.8));
  }

  void draw_contact() {
    if (!happens(0.55)) return;
    Json contact;
    law(contact);
    contact["pressure"] =
        written(scales_.mass * acceleration_ / std::pow(size_.maxCoeff(), 2) * draw_.logarithmic(3.0, 100.0));
    contact["depth"] = written(draw_.uniform(0.05, 0.2) * scales_.edge);
    if (happens(0.5)) contact["exponent"] = draw_.whole(2, 4);
    if (happens(is_free_ ? 0.2 : several_ ? 0.4 : 0.9)) {
      contact["obstacles"] = Json::array();
      for (int k = draw_.whole(1, 2); k > 0; --k) contact["obstacles"].push_back(obstacle());
    }
    if (dimension_ == 3 && (several_ || happens(0.2)))
      contact["bodies"] = one_of<std::string>({"none", "others", "others", "themselves", "all", "all"});
    if (several_ && happens(0.5)) {
      contact["pairs"] = Json::array();
      for (int k = draw_.whole(1, 2); k > 0; --k) {
        Json pair{{"of", {draw_.below(json_["bodies"].size()), draw_.below(json_["bodies"].size())}}};
        if (happens(0.5)) pair["touch"] = one_of<std::string>({"yes", "yes", "no"});
        law(pair);
        contact["pairs"].push_back(pair);
      }
    }
    json_["contact"] = contact;
  }

  // ---- events

  Json dissociation() {
    const int kind = draw_.whole(0, 2);
    if (kind == 0) {
      Json blade{{"path", {json_of(place()), json_of(place())}},
                 {"depth", json_of(2.0 * scales_.edge * draw_.direction())}};
      return {{"blade", blade}};
    }
    if (kind == 1 && !several_ && mesh_.cell_count() > 0 && simplices_) {
      const auto corners = mesh_.cell(draw_.below(mesh_.cell_count()));
      Json facet = Json::array();
      for (std::size_t k = 1; k < corners.size(); ++k) facet.push_back(corners[k]);
      return {{"points", Json::array({facet})}};
    }
    Json cut{{"plane", plane(false)}};
    if (happens(0.4)) {
      const int within = draw_.whole(0, 3);
      Json region;
      if (within == 0) region["box"] = box_around(place(), 1.5 * scales_.edge);
      if (within == 1) region["sphere"] = {{"centre", json_of(place())}, {"radius", written(1.5 * scales_.edge)}};
      if (within == 2) region["around"] = around();
      if (within == 3) region["polygon"] = {json_of(place()), json_of(place()), json_of(place())};
      cut["within"] = region;
    }
    return cut;
  }

  Json event() {
    const bool refines = dimension_ == 3 && simplices_ && happens(0.25);
    const int kind = refines ? 4 : std::array{0, 0, 1, 2, 3, 5}[draw_.below(6)];
    Json one;
    const auto at = [&] { one["at"] = time(0.0, 0.9); };
    if (kind == 0) {
      at();
      one["dissociate"] = dissociation();
    } else if (kind == 1) {
      if (happens(0.5)) {
        at();
      } else {
        if (happens(0.6)) one["every"] = time(0.1, 0.5);
        if (happens(0.6)) one["from"] = time(0.0, 0.4);
        if (happens(0.6) || !one.contains("every")) one["until"] = time(0.5, 0.9);
      }
      one["remove"] = cells(true);
    } else if (kind == 2) {
      at();
      Json tear{{"direction", json_of(draw_.direction())}};
      if (happens(0.5) && !several_)
        tear["vertex"] = draw_.below(scales_.points);
      else
        tear["near"] = json_of(place());
      one["tear"] = tear;
    } else if (kind == 3) {
      const double young = scales_.density * std::pow(scales_.edge * scales_.rate, 2);
      Json stress{{"threshold", number(1e-3 * young, 0.1 * young)}};
      if (happens(0.4)) stress["plane"] = plane(false);
      if (happens(0.5)) stress["most_per_step"] = draw_.whole(1, 2);
      if (happens(0.3)) one["every"] = time(0.05, 0.2);
      if (happens(0.3)) one["from"] = time(0.0, 0.4);
      if (happens(0.3)) one["until"] = time(0.5, 0.9);
      one["tear_where_stressed"] = stress;
    } else if (kind == 4) {
      // refused beside these
      for (const char* key : {"forces", "driven", "attachments"}) json_.erase(key);
      at();
      Json refine{{"cells", cells(true)}};
      if (happens(0.6)) refine["at"] = one_of<std::string>({"longest edge", "centre"});
      if (happens(0.4)) refine["bracing"] = written(draw_.uniform(0.0, 1.0));
      one["refine"] = refine;
    } else {
      at();
      one["release"] = json_.contains("fixed") && happens(0.7) ? json_["fixed"][0] : selection(scales_.points);
      one["release"].erase("axes");
    }
    return one;
  }

  void draw_events() {
    if (!happens(0.55)) return;
    json_["events"] = Json::array();
    for (int k = draw_.whole(1, 2); k > 0; --k) json_["events"].push_back(event());
  }

  void draw_sleep() {
    if (!happens(0.2)) return;
    json_["sleep"] = {{"speed", written(speed_ * draw_.logarithmic(1e-2, 3.0))},
                      {"time", written(step_ * draw_.uniform(1.0, 6.0))}};
  }

  Json cadence() {
    if (happens(0.5)) return {{"steps", draw_.whole(1, 9)}};
    return time(0.1, 0.5);
  }
  void draw_output() {
    Json output;
    if (happens(0.5)) output["frames_every"] = cadence();
    if (happens(0.5)) output["diagnostics_every"] = cadence();
    if (happens(0.5)) {
      std::vector<std::string> fields{"held", "stress", "displacement"};
      if (json_.contains("contact")) fields.emplace_back("contact");
      fields.emplace_back("springs");
      Json some = Json::array();
      for (const std::string& field : fields)
        if (happens(0.6)) some.push_back(field);
      output["fields"] = some;
    }
    if (happens(0.3)) output["compressed"] = one_of<std::string>({"no", "zlib", "lz4"});
    if (happens(0.4)) {
      Json probe{{"name", "one"}};
      if (several_ || happens(0.5))
        probe["near"] = json_of(place());
      else
        probe["vertex"] = draw_.below(scales_.points);
      output["probes"] = Json::array({probe});
      if (happens(0.5)) output["probes_every"] = cadence();
    }
    if (happens(0.3)) output["checkpoint"] = time(0.1, 0.7);
    if (!output.empty()) json_["output"] = output;
  }

  Draw draw_;
  Json json_;
  Scales scales_;
  Mesh mesh_;
  int dimension_ = 3;  // of the body drawn last
  bool simplices_ = true, several_ = false, solids_ = false;
  bool is_free_ = false, keeps_energy_ = false;  // nothing holds it in space; nothing damps it
  double step_ = 0.0, duration_ = 0.0, speed_ = 0.0, acceleration_ = 0.0;
  Vector3d centre_{0, 0, 0}, size_{0, 0, 0};
};

}  // namespace

Json drawn_scene(std::uint64_t seed, std::uint64_t number) {
  constexpr std::uint64_t most_attempts = 1000;
  for (std::uint64_t attempt = 0; attempt < most_attempts; ++attempt) {
    try {
      return SceneOfAllKeys(seed, number, attempt).json();
    } catch (const InputError&) {
      // keys that do not go together
    }
  }
  throw InputError(fmt::format("scene {} of seed {} was refused {} times", number, seed, most_attempts));
}

std::span<const KeyNotDrawn> keys_not_drawn() {
  using enum Shape;
  static constexpr std::string_view of_file = "needs a mesh file", of_readers = "no part of the motion",
                                    of_end = "is compared with the end of a run";
  static constexpr std::array keys{
      KeyNotDrawn{scene, "about", of_readers},
      KeyNotDrawn{scene, "$schema", of_readers},
      KeyNotDrawn{scene, "accuracy", "takes the step of whole studies"},
      KeyNotDrawn{scene, "expect", of_end},
      KeyNotDrawn{body, "mesh", of_file},
      KeyNotDrawn{body, "weld", of_file},
      KeyNotDrawn{one_body, "mesh", of_file},
      KeyNotDrawn{one_body, "weld", of_file},
      KeyNotDrawn{cell_selection, "tag", of_file},
  };
  return keys;
}

}  // namespace dartboard
