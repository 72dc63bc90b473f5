#include <vector>

#include "core/operations/remove_face.h"
#include "core/operations/remove_volume.h"
#include "core/scene/body/events/cell_chooser.h"
#include "core/scene/body/events/ready.h"

namespace dartboard {
namespace {

template <class Map>
class ReadyRemoval : public OnDarts<Map> {
 public:
  ReadyRemoval(ChangingBody<Map>& on, const CellSelection& selection, const std::string& path)
      : OnDarts<Map>(on), chooser_(on, selection, path) {}

  std::size_t apply(EventTargets* taken) override {
    // darts and not numbers: these change when the body follows
    std::vector<Dart> darts;
    for (const std::uint32_t k : chooser_.choose()) darts.push_back(on_.body().cell_dart[k]);
    return this->take(darts, taken);
  }
  void state(Archive& archive) override { chooser_.state(archive); }
  std::size_t bytes() const override { return chooser_.bytes(); }

 private:
  std::size_t operate(std::span<const Dart> darts) override {
    if (darts.empty()) return 0;
    auto& body = on_.body();
    double mass = 0.0;
    for (const Dart d : darts) mass += body.cell_mass[body.cell(body.map, d)];
    TopologyChange change;
    for (const Dart d : darts) {
      if constexpr (Map::dimension == 3)
        change.append(remove_volume(body.map, d));
      else
        change.append(remove_face(body.map, d));
    }
    on_.follow(change);
    on_.count_removed(mass);
    return darts.size();
  }

  using OnDarts<Map>::on_;
  CellChooser<Map> chooser_;
};

}  // namespace

template <class Map>
std::unique_ptr<ReadyEvent> ready(ChangingBody<Map>& on, const Remove& remove, const std::string& path) {
  return std::make_unique<ReadyRemoval<Map>>(on, remove.cells, path);
}

template std::unique_ptr<ReadyEvent> ready(ChangingBody<Map2>&, const Remove&, const std::string&);
template std::unique_ptr<ReadyEvent> ready(ChangingBody<Map3>&, const Remove&, const std::string&);
template std::unique_ptr<ReadyEvent> ready(ChangingBody<TetMap>&, const Remove&, const std::string&);

}  // namespace dartboard
