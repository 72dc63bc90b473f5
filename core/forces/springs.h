#pragma once
// The springs of a body, by edge number. Where no spring is damped, damping takes no memory.

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

namespace dartboard {

/// The numbers of the vertices at the two ends of a spring.
using SpringEnds = std::array<std::uint32_t, 2>;

/// The embedding of an edge: one spring.
struct Spring {
  double rest_length;  // [m]
  double stiffness;    // [N/m], the sum of the contributions of the incident cells
  double damping;      // [N s/m], likewise
  template <class Archive>
  void state(Archive& archive) {
    archive(rest_length, stiffness, damping);
  }
};

/// A spring where none is damped.
struct UndampedSpring {
  double rest_length;  // [m]
  double stiffness;    // [N/m]
  template <class Archive>
  void state(Archive& archive) {
    archive(rest_length, stiffness);
  }
};

/// A view of springs with or without damping; valid until they change their number, or the first of them is damped.
///
/// Either way a spring is one row: in a column of its own, damping would be a second stream for the damped loops. A
/// loop that has to be fast is compiled for both (`visit`), others read springs by value.
class SpringSpan {
 public:
  class Iterator;

  SpringSpan() = default;
  SpringSpan(std::span<const Spring> damped) : damped_(damped) {}
  SpringSpan(std::span<const UndampedSpring> undamped) : undamped_(undamped) {}
  SpringSpan(const std::vector<Spring>& damped) : damped_(damped) {}
  SpringSpan(const std::vector<UndampedSpring>& undamped) : undamped_(undamped) {}

  std::size_t size() const { return damped_.size() + undamped_.size(); }
  bool empty() const { return size() == 0; }
  Spring operator[](std::size_t k) const {
    return damped_.empty() ? Spring{undamped_[k].rest_length, undamped_[k].stiffness, 0.0} : damped_[k];
  }
  Iterator begin() const;
  Iterator end() const;

  /// Empty where the springs have no damping.
  std::span<const Spring> damped() const { return damped_; }
  /// Empty where the springs have damping.
  std::span<const UndampedSpring> undamped() const { return undamped_; }
  /// f(undamped()) or f(damped()).
  template <class F>
  decltype(auto) visit(F&& f) const {
    return damped_.empty() ? f(undamped_) : f(damped_);
  }

 private:
  std::span<const Spring> damped_;  // one of the two is empty
  std::span<const UndampedSpring> undamped_;
};

class SpringSpan::Iterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = Spring;
  using difference_type = std::ptrdiff_t;
  using pointer = void;
  using reference = Spring;

  Iterator() = default;
  Iterator(const SpringSpan& springs, std::size_t k) : springs_(springs), k_(k) {}
  Spring operator*() const { return springs_[k_]; }
  Iterator& operator++() {
    ++k_;
    return *this;
  }
  Iterator operator++(int) {
    const Iterator old = *this;
    ++k_;
    return old;
  }
  friend bool operator==(const Iterator& a, const Iterator& b) { return a.k_ == b.k_; }

 private:
  SpringSpan springs_;
  std::size_t k_ = 0;
};

inline SpringSpan::Iterator SpringSpan::begin() const { return {*this, 0}; }
inline SpringSpan::Iterator SpringSpan::end() const { return {*this, size()}; }

/// The springs themselves. They hold damping from the first damped one on: every row then has a place for it, also the
/// rows of undamped springs.
class Springs {
 public:
  operator SpringSpan() const { return damped_.empty() ? SpringSpan(undamped_) : SpringSpan(damped_); }

  std::size_t size() const { return damped_.size() + undamped_.size(); }
  bool empty() const { return size() == 0; }
  Spring operator[](std::size_t k) const { return SpringSpan(*this)[k]; }
  Spring back() const { return (*this)[size() - 1]; }
  SpringSpan::Iterator begin() const { return SpringSpan(*this).begin(); }
  SpringSpan::Iterator end() const { return SpringSpan(*this).end(); }
  std::vector<Spring> list() const { return {begin(), end()}; }

  void push_back(const Spring& s) {
    make_room_for(s);
    if (holds_damping_)
      damped_.push_back(s);
    else
      undamped_.push_back({s.rest_length, s.stiffness});
  }
  void set(std::size_t k, const Spring& s) {
    make_room_for(s);
    if (holds_damping_)
      damped_[k] = s;
    else
      undamped_[k] = {s.rest_length, s.stiffness};
  }
  /// f(spring), which may change it.
  template <class F>
  void change(std::size_t k, F&& f) {
    Spring s = (*this)[k];
    std::forward<F>(f)(s);
    set(k, s);
  }
  void pop_back() { holds_damping_ ? damped_.pop_back() : undamped_.pop_back(); }
  void shrink_to_fit() {
    damped_.shrink_to_fit();
    undamped_.shrink_to_fit();
  }

  /// Bytes of the elements, of which `damping_bytes` are for damping.
  std::size_t bytes() const { return damped_.size() * sizeof(Spring) + undamped_.size() * sizeof(UndampedSpring); }
  std::size_t damping_bytes() const { return damped_.size() * sizeof(Spring::damping); }
  template <class Archive>
  void state(Archive& archive) {
    archive(holds_damping_, damped_, undamped_);
  }

 private:
  void make_room_for(const Spring& s) {
    if (!holds_damping_ && s.damping != 0.0) hold_damping();
  }
  void hold_damping() {
    damped_.reserve(undamped_.capacity());
    for (const UndampedSpring& s : undamped_) damped_.push_back({s.rest_length, s.stiffness, 0.0});
    undamped_ = {};
    holds_damping_ = true;
  }

  bool holds_damping_ = false;
  std::vector<Spring> damped_;  // one of the two is empty
  std::vector<UndampedSpring> undamped_;
};

}  // namespace dartboard
