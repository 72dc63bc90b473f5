#include <vector>

#include "core/base/bytes.h"
#include "core/mechanics/fracture/tearing.h"
#include "core/scene/body/events/on_darts.h"
#include "core/scene/body/events/ready.h"

namespace dartboard {
namespace {

template <class Map>
class ReadyStress : public Dissociation<Map> {
 public:
  ReadyStress(ChangingBody<Map>& on, const TearWhereStressed& tear, const std::string& path)
      : Dissociation<Map>(on), rule_{tear.threshold} {
    if (tear.most_per_step) rule_.most_per_step = *tear.most_per_step;
    if (!tear.seam) return;
    const std::vector<Dart> faces = seam_on(on, *tear.seam);
    if (faces.empty())
      refuse_event(path + "/plane", "has no two cells on different sides", "a seam through the body at rest");
    filter_ = [&map = on.body().map, seam = FaceSet(on.body().map, faces)](Dart d) { return seam.contains(map, d); };
  }
  std::size_t apply(EventTargets* taken) override {
    const auto follow = [this, taken](const TopologyChange& change) {
      for (const DissociatedCell& face : change.faces) this->add(std::span(&face.kept, 1), taken);
      on_.follow(change);
    };
    return tear_where_stressed(on_.body(), on_.ends(), rule_, filter_, follow, stress_, on_.terms(), on_.corners())
        .faces;
  }
  // a seam takes a bit for each face slot of a cell
  std::size_t bytes() const override {
    return bytes_of(stress_) + (filter_ ? (on_.body().map.template slot_count<2>() + 7) / 8 : 0);
  }

 private:
  using Dissociation<Map>::on_;
  TearRule rule_;
  FaceFilter filter_;
  std::vector<Eigen::Matrix3d> stress_;
};

}  // namespace

template <class Map>
std::unique_ptr<ReadyEvent> ready(ChangingBody<Map>& on, const TearWhereStressed& tear, const std::string& path) {
  if constexpr (Map::dimension == 3)
    return std::make_unique<ReadyStress<Map>>(on, tear, path);
  else
    refuse_event(path, "tears fans of faces, and the body is a surface", "'dissociate' or 'remove'");
}

template std::unique_ptr<ReadyEvent> ready(ChangingBody<Map2>&, const TearWhereStressed&, const std::string&);
template std::unique_ptr<ReadyEvent> ready(ChangingBody<Map3>&, const TearWhereStressed&, const std::string&);
template std::unique_ptr<ReadyEvent> ready(ChangingBody<TetMap>&, const TearWhereStressed&, const std::string&);

}  // namespace dartboard
