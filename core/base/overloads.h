#pragma once
// Functions as one visitor of a variant; a kind without one does not compile.

namespace dartboard {

template <class... Functions>
struct Overloads : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloads(Functions...) -> Overloads<Functions...>;

}  // namespace dartboard
