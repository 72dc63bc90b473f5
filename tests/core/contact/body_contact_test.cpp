// Contact between bodies: which points are inside which body, how deep, and with which force.

#include "core/contact/body_contact.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <vector>

#include "core/contact/contacts.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "core/plain/random.h"
#include "tests/support/bodies/term_checks_for_tests.h"
#include "tests/support/bodies/touching_bodies_for_tests.h"

namespace dartboard::body_contact_test {
namespace {

using Eigen::Vector3d;

/// Two meshes, and one term between them.
struct TwoBodies {
  Mesh mesh;
  std::unique_ptr<MeshSkin> skin;
  std::vector<Vector3d> x;
  std::unique_ptr<BodyContact> contact;

  TwoBodies(const Mesh& one, const Mesh& other, const std::vector<ContactPair>& pairs)
      : mesh(together(one, other)),
        skin(std::make_unique<MeshSkin>(skin_of_mesh<Map3>(mesh, static_cast<std::uint32_t>(one.cell_count())))),
        x(mesh.points),
        contact(std::make_unique<BodyContact>(skin->samples, skin->solids, pairs)) {}
};

std::vector<ContactPair> between(const ContactLaw& law) { return {{0, 1, law}}; }

/// A box of n cells a side on another, overlapping by `depth`, its width 1.
TwoBodies stacked(int n, double depth, const ContactLaw& law) {
  return {kuhn_box(n, n, n, 1.0 / n), shifted(kuhn_box(n, n, n, 1.0 / n), {0, 0, 1 - depth}), between(law)};
}

// Each side has half of the pressure of its law on its inner samples; those on the edges have no depth, as the sides of
// the box are as near as its top. The force is lower by the share of the border's vertices.
TEST(BodyContact, CarriesThePressureOfItsLawBetweenBoxes) {
  for (const int p : {2, 3, 4}) {
    const ContactLaw law = law_between(p, 1000.0, 0.02);
    for (const int n : {1, 4, 8}) {
      const double d = 0.01;
      const TwoBodies boxes = stacked(n, d, law);
      std::vector<Vector3d> force(boxes.x.size(), Vector3d(0, 0, 0));
      boxes.contact->add_forces({boxes.x}, force);
      Vector3d up(0, 0, 0);
      for (std::size_t i = boxes.x.size() / 2; i < boxes.x.size(); ++i) up += force[i];
      // a vertex within has A/12 of six triangles of h^2/2, on the border of three to two; middles have the rest
      const double h = 1.0 / n, pressure = 1000.0 * std::pow(d / 0.02, p - 1);
      const double expected = (0.75 + (n - 1) * (n - 1) * 0.25 * h * h) * pressure;
      EXPECT_NEAR(up[2], expected, 1e-12 * expected) << n << ' ' << p;
      EXPECT_LE(up.head<2>().norm(), 1e-12 * expected);
    }
  }
}

/// Two balls of jittered cells that overlap, each moved at random a little.
TwoBodies overlapping_balls(int exponent, std::uint64_t seed) {
  TwoBodies balls(tetrahedron_ball(2, 0.5), shifted(tetrahedron_ball(3, 0.4), {0.3, 0.5, 0.35}),
                  between(law_between(exponent, 1000.0, 0.1)));
  SplitMix64 random(seed);
  for (Vector3d& x : balls.x)
    for (double& c : x) c += 0.02 * random.next_signed();
  return balls;
}

// Differences of a step d at d and 2 d, so that errors of d^2 cancel; no kink is within 2 d of these places.
TEST(BodyContact, PullsAlongTheSlopeOfItsEnergyWithoutSumOrTorque) {
  for (const int p : {2, 3, 4})
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      const TwoBodies balls = overlapping_balls(p, seed);
      BodyContact& term = *balls.contact;
      const auto& x = balls.x;
      const auto force = forces_of(term, x);
      const double size = size_of(force), d = 1e-6;
      ASSERT_GT(Contacts(nullptr, &term).state_at(x).contacts, 10u);
      Vector3d sum(0, 0, 0), torque(0, 0, 0);
      for (std::size_t i = 0; i < x.size(); ++i) {
        sum += force[i];
        torque += x[i].cross(force[i]);
      }
      EXPECT_LE(sum.norm(), 1e-15 * size);
      EXPECT_LE(torque.norm(), 2e-15 * size);
      SplitMix64 random(7);
      std::vector<Vector3d> w(x.size());
      for (Vector3d& v : w)
        for (double& c : v) c = random.next_signed();
      const auto slope = [&](double step) {
        return (term.energy(moved(x, w, -step)) - term.energy(moved(x, w, step))) / (2 * step);
      };
      EXPECT_NEAR((4 * slope(d) - slope(2 * d)) / 3, dot(force, w), 1e-8 * size) << p << ' ' << seed;
      // half way there, the same places
      std::vector<Vector3d> on_the_way(x.size(), Vector3d(0, 0, 0));
      term.add_forces({x, w, 0.01}, on_the_way);
      const auto there = forces_of(term, moved(x, w, 0.01));
      for (std::size_t i = 0; i < x.size(); ++i) EXPECT_LE((on_the_way[i] - there[i]).norm(), 1e-12 * size);
    }
}

TEST(BodyContact, HasChangesSharesSizesAndPowersThatAddUp) {
  for (const int p : {2, 3, 4}) {
    const TwoBodies balls = overlapping_balls(p, 4);
    const BodyContact& term = *balls.contact;
    const auto& x = balls.x;
    const auto force = forces_of(term, x);
    const double size = size_of(force), before = term.energy(x);
    SplitMix64 random(9);
    std::vector<Vector3d> w(x.size());
    for (Vector3d& v : w)
      for (double& c : v) c = random.next_signed();
    for (const double t : {1e-7, 0.05, 10.0}) {  // the last of them takes all apart, and into each other again
      const double after = term.energy(moved(x, w, t));
      const EnergyChange change = term.energy_change({x}, w, t);
      EXPECT_NEAR(change.value, after - before, 1e-14 * (before + after)) << t;
      EXPECT_GE(change.sizes, std::abs(change.value));
    }
    double shares = 0.0;
    for (std::size_t first = 0; first < 3; ++first) shares += term.energy(x, first, 3);
    EXPECT_NEAR(shares, before, 1e-14 * before);
    std::vector<double> sizes(x.size(), 0.0);
    term.add_force_sizes({x}, sizes);
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_GE(sizes[i], force[i].norm() * (1 - 1e-12));

    std::vector<std::uint32_t> all(term.size()), of_samples(balls.skin->samples.size());
    for (std::uint32_t k = 0; k < all.size(); ++k) all[k] = k;
    for (std::uint32_t k = 0; k < of_samples.size(); ++k) of_samples[k] = k;
    EXPECT_NEAR(term.power(all, x, w), dot(force, w), 1e-12 * size);
    double own = 0.0;
    for (const BodyTouch& t : term.touching({x}))
      for (const std::uint32_t i : balls.skin->samples[t.sample].corners())
        own += term.laws()[0].force(t.area, t.depth) * t.normal.dot(w[i]) / balls.skin->samples[t.sample].count;
    EXPECT_NEAR(term.power(of_samples, x, w), own, 1e-12 * size);
    std::vector<Vector3d> none(x.size());
    EXPECT_THROW(term.add_discrete_forces({x, w, 0.1}, none), SolverError);
  }
}

// Each side by itself twice, which is no less than both together.
TEST(BodyContact, HasTangentsOfEachSideTwice) {
  for (const int p : {2, 3}) {
    const TwoBodies balls = overlapping_balls(p, 5);
    const BodyContact& term = *balls.contact;
    SplitMix64 random(9);
    std::vector<Vector3d> w(balls.x.size());
    for (Vector3d& v : w)
      for (double& c : v) c = random.next_signed();
    double both = 0.0, apart = 0.0;
    for (const BodyTouch& t : term.touching({balls.x})) {
      const double k = term.laws()[0].stiffness(t.area, t.depth);
      Vector3d sample(0, 0, 0), nearest(0, 0, 0);
      for (const std::uint32_t i : balls.skin->samples[t.sample].corners())
        sample += w[i] / balls.skin->samples[t.sample].count;
      for (std::size_t a = 0; a < 3; ++a)
        nearest += t.nearest[a] * w[balls.skin->solids.triangles()[t.triangle].nodes[a]];
      both += k * std::pow((sample - nearest).dot(t.normal), 2);
      apart += 2 * k * (std::pow(sample.dot(t.normal), 2) + std::pow(nearest.dot(t.normal), 2));
    }
    for (const Compression kind : {Compression::exact, Compression::projected})
      EXPECT_NEAR(dot(product_of(term, balls.x, w, kind), w), apart, 1e-12 * apart);
    EXPECT_GT(apart, both);
    std::size_t pieces = 0;
    term.for_each_constant_tangent([&](ForceTerm::Nodes n, std::span<const Eigen::Matrix3d> blocks) {
      EXPECT_EQ(n.data(), term.nodes(pieces).data());
      EXPECT_EQ(blocks.size(), n.size() * (n.size() + 1) / 2);
      ++pieces;
    });
    EXPECT_EQ(pieces, term.size());
  }
}

void expect_same(std::span<const BodyTouch> a, std::span<const BodyTouch> b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].sample, b[k].sample);
    EXPECT_EQ(a[k].tetrahedron, b[k].tetrahedron);
    EXPECT_EQ(a[k].triangle, b[k].triangle);
    EXPECT_EQ(a[k].law, b[k].law);
    EXPECT_EQ(a[k].area, b[k].area);
    EXPECT_EQ(a[k].depth, b[k].depth);
    EXPECT_EQ(a[k].normal, b[k].normal);
    EXPECT_EQ(a[k].nearest, b[k].nearest);
    EXPECT_EQ(a[k].inside, b[k].inside);
  }
}

// Bodies that move through each other and are deformed, with cells turned inside out: the lists find the same contacts
// as a comparison of every pair, to the last bit.
TEST(BodyContact, FindsByListsWhatEveryPairAskedForFinds) {
  for (const double margin : {0.01, 0.25, 20.0}) {
    TwoBodies balls(tetrahedron_ball(2, 0.5), shifted(tetrahedron_ball(3, 0.4), {0.3, 0.5, 0.35}),
                    {{0, 1, law_between(3, 1000.0, 0.1)}, {1, 1, law_between(2, 500.0, 0.1)}});
    balls.contact->set_margin(margin);
    SplitMix64 random(3);
    std::size_t contacts = 0, inverted = 0;
    std::vector<Vector3d> speed(balls.x.size());
    for (int step = 0; step < 120; ++step) {
      if (step % 40 == 0)
        for (std::size_t i = 0; i < speed.size(); ++i) {
          for (double& c : speed[i]) c = 0.005 * random.next_signed();
          if (i >= speed.size() / 3) speed[i] -= Vector3d(0.005, 0.0075, 0.005);
        }
      for (std::size_t i = 0; i < speed.size(); ++i) balls.x[i] += speed[i];
      inverted += Contacts(nullptr, balls.contact.get()).state_at(balls.x).inverted;
      if (step % 4 != 0) continue;  // lists are kept up to date in every step, and compared in some
      const auto found = balls.contact->touching({balls.x});
      expect_same(found, balls.contact->touching_by_brute_force({balls.x}, nullptr));
      contacts += found.size();
    }
    EXPECT_GT(contacts, 200u);
    EXPECT_GT(inverted, 0u);
    EXPECT_GT(balls.contact->candidates().times_made(), margin < 1.0 ? 20u : 0u);
    EXPECT_LT(balls.contact->candidates().times_made(), margin > 0.1 ? 60u : 121u);
  }
}

// Each vertex goes less than half of the room, in the worst directions: towards the other body.
TEST(BodyContact, HasRoomForWaysOnWhichNothingTouches) {
  for (const double gap : {0.01, 0.03, 0.06}) {
    TwoBodies boxes = stacked(2, -gap, law_between(3, 1000.0, 0.1));
    EXPECT_EQ(boxes.contact->room_at(boxes.x), 0.0);  // nothing has been looked for
    EXPECT_TRUE(boxes.contact->touching({boxes.x}).empty());
    const double room = boxes.contact->room_at(boxes.x);
    EXPECT_GT(room, 0.5 * gap);
    EXPECT_LE(room, gap);
    for (const double share : {0.3, 0.499, 0.6, 1.2}) {
      std::vector<Vector3d> nearer = boxes.x;
      for (std::size_t i = 0; i < nearer.size(); ++i)
        nearer[i][2] += i < nearer.size() / 2 ? share * gap : -share * gap;
      if (boxes.contact->room_at(nearer) > 0.0) {
        EXPECT_LT(2.0 * share * gap, room);
      }
      EXPECT_EQ(boxes.contact->touching_by_brute_force({nearer}, nullptr).empty(), share < 0.5);
      EXPECT_EQ(boxes.contact->touching({nearer}).empty(), share < 0.5);
    }
  }
}

TEST(BodyContact, WatchesEveryVertex) {
  const TwoBodies boxes = stacked(2, -0.02, law_between(3, 1000.0, 0.1));
  const std::size_t half = boxes.x.size() / 2;
  Vector3d lower(0, 0, 0), upper(0, 0, 0);
  for (std::size_t i = 0; i < half; ++i) {
    lower += boxes.x[i] / static_cast<double>(half);
    upper += boxes.x[half + i] / static_cast<double>(half);
  }
  for (std::size_t i = 0; i < boxes.x.size(); ++i) {
    EXPECT_TRUE(boxes.contact->touching({boxes.x}).empty());
    std::vector<Vector3d> places = boxes.x;
    places[i] = (i < half ? upper : lower) + Vector3d(0.011, 0.017, 0.013);
    expect_same(boxes.contact->touching({places}), boxes.contact->touching_by_brute_force({places}, nullptr));
  }
}

// No vertex comes nearer to another.
TEST(BodyContact, KeepsItsListWhileBodiesMoveTogether) {
  TwoBodies boxes = stacked(2, -0.02, law_between(3, 1000.0, 0.1));
  boxes.contact->touching({boxes.x});
  const double room = boxes.contact->room_at(boxes.x);
  const std::uint64_t made = boxes.contact->candidates().times_made();
  for (Vector3d& x : boxes.x) x += Vector3d(3, -4, 5);
  EXPECT_TRUE(boxes.contact->touching({boxes.x}).empty());
  EXPECT_NEAR(boxes.contact->room_at(boxes.x), room, 1e-14);
  EXPECT_EQ(boxes.contact->candidates().times_made(), made);
  for (std::size_t i = 0; i < boxes.x.size() / 2; ++i) boxes.x[i][2] += 1.0;
  boxes.contact->touching({boxes.x});
  EXPECT_EQ(boxes.contact->candidates().times_made(), made + 1);
}

// As in a run: each place a little further than the last, and the nearest triangle another one now and then. Most are
// known to be the nearest still, and the others are found.
TEST(BodyContact, KnowsTheWaysOutOfPlacesThatHaveMovedALittle) {
  struct Case {
    double way;
    std::size_t least_others;
    double most_searched;
  };
  for (const auto [way, least_others, most_searched] :
       {Case{1e-6, 0, 0.1}, Case{1e-4, 4, 0.4}, Case{2e-3, 100, 0.95}}) {
    TwoBodies balls = overlapping_balls(3, 6);
    SplitMix64 random(5);
    std::vector<Vector3d> speed(balls.x.size(), Vector3d(0, 0, 0));
    std::size_t ways = 0, others = 0;
    std::vector<std::uint32_t> last(balls.skin->samples.size(), BodyTouch::none);
    const auto known = [&](const BodyTouch& touch) {
      ++ways;
      if (last[touch.sample] != BodyTouch::none && last[touch.sample] != touch.triangle) ++others;
      last[touch.sample] = touch.triangle;
    };
    const std::uint64_t before = balls.contact->ways_searched();
    std::uint64_t by_brute_force = 0;
    for (int step = 0; step < 150; ++step) {
      for (std::size_t i = 0; i < speed.size(); ++i)
        for (int c = 0; c < 3; ++c) balls.x[i][c] += way * (speed[i][c] += 0.2 * random.next_signed());
      const auto found = balls.contact->touching({balls.x});
      for (const BodyTouch& touch : found) known(touch);
      const std::vector<BodyTouch> kept(found.begin(), found.end());
      const std::uint64_t searched = balls.contact->ways_searched();
      expect_same(kept, balls.contact->touching_by_brute_force({balls.x}, nullptr));
      by_brute_force += balls.contact->ways_searched() - searched;
    }
    const std::uint64_t searched = balls.contact->ways_searched() - before - by_brute_force;
    EXPECT_GT(ways, 1000u);
    EXPECT_GE(others, least_others) << way;
    EXPECT_LT(static_cast<double>(searched), most_searched * static_cast<double>(ways)) << way;
  }
}

// A box that touches another, hops, and sinks far into it: what was the nearest side before the hop is so no more.
TEST(BodyContact, KnowsNoWayOutOfBodiesThatWereApart) {
  const TwoBodies boxes = stacked(2, 0.001, law_between(3, 1000.0, 0.1));
  const std::size_t upper = kuhn_box(2, 2, 2, 0.5).points.size();
  const auto lifted = [&](const Vector3d& by) {
    std::vector<Vector3d> x = boxes.x;
    for (std::size_t i = upper; i < x.size(); ++i) x[i] += by;
    return x;
  };
  SplitMix64 random(7);
  std::size_t contacts = 0;
  for (int hop = 0; hop < 40; ++hop) {
    const double x = 0.4 * random.next_signed(), y = 0.4 * random.next_signed();
    EXPECT_FALSE(boxes.contact->touching({lifted({x, y, 0})}).empty());
    EXPECT_FALSE(boxes.contact->touching({lifted({x, y, 0.0001})}).empty());
    EXPECT_TRUE(boxes.contact->touching({lifted({x, y, 0.002})}).empty());
    const std::vector<Vector3d> sunk = lifted({x, y, -0.2 + 0.15 * random.next_signed()});
    const auto found = boxes.contact->touching({sunk});
    contacts += found.size();
    const std::vector<BodyTouch> kept(found.begin(), found.end());
    expect_same(kept, boxes.contact->touching_by_brute_force({sunk}, nullptr));
  }
  EXPECT_GT(contacts, 100u);
}

// Vertices that are NaN, or far from everything, are nowhere inside, and their lists hold nothing.
TEST(BodyContact, LooksAtNothingThatIsNoNumber) {
  TwoBodies balls = overlapping_balls(3, 6);
  const std::size_t contacts = Contacts(nullptr, balls.contact.get()).state_at(balls.x).contacts;
  const std::uint32_t inside = Contacts(nullptr, balls.contact.get()).state_at(balls.x).sample;
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
    auto x = balls.x;
    x[balls.skin->samples[inside].nodes[0]][1] = bad;
    const auto found = balls.contact->touching({x});
    EXPECT_LT(found.size(), contacts);
    EXPECT_EQ(found.size(), balls.contact->touching_by_brute_force({x}, nullptr).size());
    EXPECT_TRUE(std::isfinite(balls.contact->energy(x)));
  }
}

// Three bodies, two of which do not touch; of the others each pair has its own law.
TEST(BodyContact, TouchesWhatItMayByTheLawOfThePair) {
  const Mesh box = kuhn_box(2, 2, 2, 0.5);
  const Mesh mesh = together(box, shifted(box, {0.9, 0, 0}));
  const ContactLaw stiff = law_between(3, 1000.0, 0.1), soft = law_between(3, 10.0, 0.1);
  const auto force = [&](const std::vector<ContactPair>& pairs) {
    const TwoBodies two(box, shifted(box, {0.9, 0, 0}), pairs);
    return size_of(forces_of(*two.contact, two.x));
  };
  EXPECT_GT(force({{0, 1, stiff}}), 0.0);
  EXPECT_EQ(force({{1, 0, stiff}}), force({{0, 1, stiff}}));
  EXPECT_NEAR(force({{0, 1, soft}, {1, 1, stiff}}), force({{0, 1, stiff}}) / 100, 1e-10);
  EXPECT_EQ(force({{0, 0, stiff}, {1, 1, stiff}}), 0.0);
  EXPECT_EQ(force({{0, 2, stiff}}), 0.0);
  EXPECT_THROW(force({{0, 1, stiff}, {1, 0, soft}}), InputError);
  EXPECT_THROW(force({{0, 1, law_between(3, -1.0, 0.1)}}), InputError);
  const TwoBodies two(box, shifted(box, {0.9, 0, 0}), {{0, 1, stiff}});
  EXPECT_THROW(two.contact->set_margin(0.0), InputError);
  EXPECT_EQ(mesh.points.size(), two.x.size());
}

/// A bar bent to a ring whose ends overlap by `overlap` of its length.
TwoBodies ring(double overlap) {
  TwoBodies bar(kuhn_box(24, 2, 2, 0.1), empty_mesh(), {{0, 0, law_between(3, 1000.0, 0.1)}});
  const double length = 2.4 * (1 - overlap), radius = length / 6.283185307179586;
  for (Vector3d& x : bar.x) {
    const double angle = x[0] / radius;
    x = Vector3d((radius - x[1]) * std::cos(angle), (radius - x[1]) * std::sin(angle), x[2]);
  }
  return bar;
}

// A body touches itself where its cells are not neighbours, and nowhere else, however it is bent.
TEST(BodyContact, TouchesItselfBeyondTheNeighboursOfNeighbours) {
  EXPECT_EQ(Contacts(nullptr, ring(-0.05).contact.get()).state_at(ring(-0.05).x).contacts, 0u);
  const TwoBodies closed = ring(0.02);
  const ContactState state = Contacts(nullptr, closed.contact.get()).state_at(closed.x);
  EXPECT_GT(state.contacts, 10u);
  EXPECT_NEAR(state.deepest, 0.02 * 2.4, 0.02);
  for (const BodyTouch& t : closed.contact->touching({closed.x})) {
    const double from = closed.mesh.points[closed.skin->samples[t.sample].nodes[0]][0],
                 into = closed.mesh.points[closed.skin->solids.tetrahedra()[t.tetrahedron].nodes[0]][0];
    EXPECT_GT(std::abs(from - into), 2.0);
  }
  // folded flat onto itself within two cells, which does not count as a contact
  TwoBodies box(kuhn_box(2, 2, 2, 0.5), empty_mesh(), {{0, 0, law_between(3, 1000.0, 0.1)}});
  box.contact->set_margin(5.0);
  SplitMix64 random(4);
  for (Vector3d& x : box.x)
    for (double& c : x) c += 0.4 * random.next_signed();
  EXPECT_EQ(Contacts(nullptr, box.contact.get()).state_at(box.x).contacts, 0u);
}

/// A tetrahedron of this size with a corner at the origin, pointing down.
Mesh tip(double size) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {size, 0, size}, {-size, size, size}, {-size, -size, size}};
  mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  return mesh;
}

// Every place in a cell with a corner on the boundary has a way out.
TEST(BodyContact, ReachesEveryPlaceAlongTheBoundary) {
  for (const Mesh& box : {kuhn_box(4, 4, 4, 0.25), hexahedron_box(4, 4, 4, 0.25)}) {
    TwoBodies two(box, tip(0.001), between(law_between(3, 1000.0, 0.1)));
    const std::vector<Vector3d> at = two.x;
    SplitMix64 random(8);
    for (int k = 0; k < 300; ++k) {
      Vector3d by(0, 0, 0);
      for (double& c : by) c = 0.5 + 0.499 * random.next_signed();
      for (std::size_t i = at.size() - 4; i < at.size(); ++i) two.x[i] = at[i] + by;
      const double depth = std::min({by[0], by[1], by[2], 1 - by[0], 1 - by[1], 1 - by[2]});
      const auto touches = two.contact->touching({two.x});
      EXPECT_TRUE(two.contact->out_of_reach().empty());
      const auto of_tip = std::ranges::find_if(touches, [&](const BodyTouch& t) {
        return two.skin->samples[t.sample].count == 1 && two.skin->samples[t.sample].nodes[0] == at.size() - 4;
      });
      if (depth > 0.249) continue;
      ASSERT_NE(of_tip, touches.end()) << by.transpose();
      EXPECT_NEAR(of_tip->depth, depth, 1e-15);
    }
  }
}

// Two tetrahedra, of which one has lost its triangles: a sample in it feels nothing, and is reported.
TEST(BodyContact, TellsWhatIsOutOfReach) {
  const std::vector<Vector3d> x{{0, 0, 0},       {1, 0, 0},       {0, 1, 0},       {0, 0, 1},
                                {0.2, 0.2, 0.2}, {0.9, 0.9, 0.9}, {0.9, 1.9, 0.9}, {0.9, 0.9, 1.9}};
  const std::vector<SkinSample> samples{{{4}, 1, 0.1}};
  SkinSolids solids;
  solids.resize(8, 1, 2);
  solids.add(SkinTetrahedron{{0, 1, 2, 3}, 0, 0});
  solids.add(SkinTetrahedron{{4, 5, 6, 7}, 1, 1});
  BodyContact contact(samples, solids, between(law_between(3, 1000.0, 0.1)));
  const Contacts contacts(nullptr, &contact);
  const ContactState state = contacts.state_at(x);
  EXPECT_EQ(state.contacts, 0u);
  EXPECT_EQ(state.energy, 0.0);
  EXPECT_EQ(state.out_of_reach, 1u);
  EXPECT_EQ(state.lost, 0u);
  solids.add(SkinTriangle{{0, 2, 1}, 0, 0});
  EXPECT_EQ(contacts.state_at(x).contacts, 1u);
  EXPECT_NEAR(contacts.state_at(x).deepest, 0.2, 1e-15);
  EXPECT_EQ(contacts.state_at(x).out_of_reach, 0u);
}

// A tip that goes on inwards out of the cells along the boundary is reported when it leaves them, with its last depth;
// one that is drawn out again is not.
TEST(BodyContact, TellsWhatGoesOnInwards) {
  TwoBodies two(kuhn_box(6, 6, 6, 0.1), shifted(tip(0.01), {0.31, 0.32, 0.61}), between(law_between(3, 1000.0, 0.1)));
  const auto move = [&](double by) {
    for (std::size_t k = two.x.size() - 4; k < two.x.size(); ++k) two.x[k][2] += by;
  };
  for (int k = 0; k < 5; ++k) {
    move(-0.01);
    EXPECT_TRUE(two.contact->find_lost(two.x).empty());
  }
  EXPECT_GT(Contacts(nullptr, two.contact.get()).state_at(two.x).contacts, 0u);
  for (int k = 0; k < 6; ++k) {
    move(0.01);
    EXPECT_TRUE(two.contact->find_lost(two.x).empty());
  }
  double last = 0.0;
  std::size_t reported = 0;
  for (int k = 0; k < 30; ++k) {
    move(-0.01);
    const auto lost = two.contact->find_lost(two.x);
    reported += lost.size();
    for (const BodyTouch& t : lost) last = std::max(last, t.depth);
  }
  EXPECT_GE(reported, 4u);  // the vertices and middles of the tip, each once
  EXPECT_LE(reported, 8u);
  EXPECT_GT(last, 0.08);
}

// The plane of the face that a tip was nearest to goes on beyond the edge: behind it there is no body.
TEST(BodyContact, LosesNothingThatLeavesOverAnEdge) {
  TwoBodies two(kuhn_box(4, 4, 4, 0.25), shifted(tip(0.01), {0.9, 0.52, 0.999}), between(law_between(3, 1000.0, 0.1)));
  bool touched = false;
  for (int k = 0; k < 20; ++k) {
    touched = touched || Contacts(nullptr, two.contact.get()).state_at(two.x).contacts > 0;
    EXPECT_TRUE(two.contact->find_lost(two.x).empty()) << k;
    for (std::size_t j = two.x.size() - 4; j < two.x.size(); ++j) two.x[j] += Vector3d(0.01, 0, -0.0005);
  }
  EXPECT_TRUE(touched);
  EXPECT_EQ(Contacts(nullptr, two.contact.get()).state_at(two.x).contacts, 0u);
}

TEST(BodyContact, SkipsCellsThatAreTurnedInsideOut) {
  TwoBodies two(one_tetrahedron(), shifted(tip(0.01), {0.2, 0.2, 0.2}), between(law_between(3, 1000.0, 0.5)));
  EXPECT_GT(Contacts(nullptr, two.contact.get()).state_at(two.x).contacts, 0u);
  EXPECT_EQ(Contacts(nullptr, two.contact.get()).state_at(two.x).inverted, 0u);
  std::swap(two.x[0], two.x[1]);
  EXPECT_EQ(Contacts(nullptr, two.contact.get()).state_at(two.x).contacts, 0u);
  EXPECT_GT(Contacts(nullptr, two.contact.get()).state_at(two.x).inverted, 0u);
}

// The longest face of a cell of six in a cube is a diagonal of the cube wide: h^3 / 2 over h sqrt(2) h / 2.
TEST(BodyContact, KnowsTheLeastAltitude) {
  const TwoBodies boxes = stacked(4, 0.01, law_between(3, 1000.0, 0.1));
  EXPECT_NEAR(boxes.contact->least_altitude(boxes.x), 0.25 / std::sqrt(2.0), 1e-15);
}

// The largest rows, compared with the largest quotient that a power iteration finds on the contacts themselves: with
// masses of all kinds an upper bound, and not a bad one. Before the run it is a bound of that, too.
TEST(BodyContact, BoundsTheFrequenciesThatItAdds) {
  for (const int p : {2, 3}) {
    const ContactLaw law = law_between(p, 1000.0, 0.02);
    const TwoBodies boxes = stacked(4, 0.01, law);
    std::vector<double> inverse_mass(boxes.x.size());
    SplitMix64 random(2);
    for (double& m : inverse_mass) m = 1.0 + 0.2 * random.next_signed();
    std::vector<Vector3d> w(boxes.x.size());
    for (Vector3d& v : w)
      for (double& c : v) c = random.next_signed();
    double largest = 0.0;
    for (int k = 0; k < 300; ++k) {
      std::vector<Vector3d> product(w.size(), Vector3d(0, 0, 0));
      for (const BodyTouch& t : boxes.contact->touching({boxes.x})) {
        const ContactSite site = boxes.contact->normal_site(t);
        site.add_to(product, law.stiffness(t.area, t.depth) * site.difference(w).dot(t.normal) * t.normal);
      }
      double norm = 0.0;
      for (std::size_t i = 0; i < w.size(); ++i) norm += (w[i] = inverse_mass[i] * product[i]).squaredNorm();
      largest = std::sqrt(norm);
      for (Vector3d& v : w) v /= largest;
    }
    const double bound = boxes.contact->frequency_squared_at(boxes.x, inverse_mass),
                 before = boxes.contact->frequency_squared(inverse_mass, 0.5);
    EXPECT_GE(bound, largest * (1 - 1e-9)) << p;
    EXPECT_LE(bound, 4 * largest) << p;
    EXPECT_GE(before, bound * (1 - 1e-12)) << p;
    EXPECT_LE(before, 4 * bound) << p;
  }
}

// The deepest of all with the names of both bodies.
TEST(BodyContact, TellsItsDepths) {
  const TwoBodies boxes = stacked(4, 0.01, law_between(3, 1000.0, 0.02));
  const ContactState state = Contacts(nullptr, boxes.contact.get()).state_at(boxes.x);
  EXPECT_NEAR(state.deepest, 0.01, 1e-15);
  EXPECT_NEAR(state.deepest_share, 0.5, 1e-13);
  EXPECT_EQ(state.from + state.into, 1u);
  EXPECT_NEAR(state.energy, boxes.contact->energy(boxes.x), 0.0);
}

// Contacts are kept for the places where they were found: other places, and other calls, do not get them.
TEST(BodyContact, FindsTheContactsOfThesePlacesAfterItHasLookedAtOthers) {
  TwoBodies balls = overlapping_balls(3, 2);
  const BodyContact& term = *balls.contact;
  const auto& x = balls.x;
  const auto expected = term.touching_by_brute_force({x}, nullptr);
  const std::vector<Vector3d> w(x.size(), Vector3d(0.01, 0, 0));
  ASSERT_FALSE(expected.empty());
  expect_same(term.touching({x}), expected);
  term.touching({x, w, 1.0});
  expect_same(term.touching({x}), expected);
  term.energy_change({x}, w, 1.0);
  expect_same(term.touching({x}), expected);
  std::vector<Vector3d> elsewhere = moved(x, w, 1.0);
  expect_same(term.touching({elsewhere}), term.touching_by_brute_force({elsewhere}, nullptr));
  elsewhere.back()[2] += 1e-12;  // the last bits of one vertex
  expect_same(term.touching({elsewhere}), term.touching_by_brute_force({elsewhere}, nullptr));
  const std::uint64_t lists = term.candidates().times_made();
  balls.contact->set_margin(term.candidates().margin_share());
  expect_same(term.touching({elsewhere}), term.touching_by_brute_force({elsewhere}, nullptr));
  EXPECT_EQ(term.candidates().times_made(), lists + 1);
}

}  // namespace
}  // namespace dartboard::body_contact_test
