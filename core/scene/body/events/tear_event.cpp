#include <fmt/format.h>

#include <limits>
#include <optional>

#include "core/mechanics/fracture/tearing.h"
#include "core/operations/tear_fan.h"
#include "core/scene/body/events/on_darts.h"
#include "core/scene/body/events/ready.h"

namespace dartboard {
namespace {

template <class Map>
class ReadyTear : public Dissociation<Map> {
 public:
  ReadyTear(ChangingBody<Map>& on, const Tear& tear, const std::string& path) : Dissociation<Map>(on), tear_(tear) {
    const auto* point = std::get_if<std::uint32_t>(&tear.vertex);
    if (point != nullptr && *point >= on.body().vertices.size())  // one vertex for each point at the start
      refuse_event(path + "/vertex", fmt::format("is {}", *point),
                   fmt::format("a point of the mesh, less than {}", on.body().vertices.size()));
  }

  std::size_t apply(EventTargets* taken) override {
    const auto& body = on_.body();
    const auto vertex = chosen();
    if (!vertex) return 0;
    const Dart start = starting_face(body, *vertex, tear_.direction);
    if (start == no_dart) return 0;  // a vertex of a single cell
    return this->take(fan(body.map, start), taken);
  }

 private:
  // That of the lowest dart, of several: parts of one point, or vertices at the same distance.
  std::optional<std::uint32_t> chosen() const {
    const VertexColumns& v = on_.body().vertices;
    std::optional<std::uint32_t> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t k = 0; k < v.size(); ++k) {
      double far = 0.0;
      if (const auto* point = std::get_if<std::uint32_t>(&tear_.vertex)) {
        if (v.point[k] != *point) continue;
      } else {
        far = (v.position[k] - std::get<Eigen::Vector3d>(tear_.vertex)).squaredNorm();
      }
      if (far < least || (far == least && best && v.dart[k] < v.dart[*best])) {
        best = k;
        least = far;
      }
    }
    return best;
  }

  using Dissociation<Map>::on_;
  Tear tear_;
};

}  // namespace

template <class Map>
std::unique_ptr<ReadyEvent> ready(ChangingBody<Map>& on, const Tear& tear, const std::string& path) {
  if constexpr (Map::dimension == 3)
    return std::make_unique<ReadyTear<Map>>(on, tear, path);
  else
    refuse_event(path, "tears fans of faces, and the body is a surface", "'dissociate' or 'remove'");
}

template std::unique_ptr<ReadyEvent> ready(ChangingBody<Map2>&, const Tear&, const std::string&);
template std::unique_ptr<ReadyEvent> ready(ChangingBody<Map3>&, const Tear&, const std::string&);
template std::unique_ptr<ReadyEvent> ready(ChangingBody<TetMap>&, const Tear&, const std::string&);

}  // namespace dartboard
