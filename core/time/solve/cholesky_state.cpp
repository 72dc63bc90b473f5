#include <algorithm>
#include <memory>
#include <new>

#include "core/base/archive.h"
#include "core/time/solve/cholesky_implementation.h"

// The factor written into a checkpoint, or read from one. CHOLMOD's objects are plain arrays, whose lengths its header
// documents.

namespace dartboard {
namespace {

/// The arrays of a factor, each made with its length where the factor is read.
class FactorArrays {
 public:
  FactorArrays(Archive& archive, cholmod_common& common) : archive_(archive), common_(common) {}

  /// An array that may be absent.
  template <class Element>
  void array(void*& data, std::size_t length) {
    bool is_there = data != nullptr;
    archive_(is_there);
    if (!is_there) return;
    if (archive_.reads()) data = allocate<Element>(length);
    archive_.bytes(data, length * sizeof(Element));
  }

  /// Columns with room to grow, which holds nothing.
  void columns(cholmod_factor& L) {
    bool is_there = L.i != nullptr;
    archive_(is_there);
    if (!is_there) return;
    if (archive_.reads()) {
      if (L.p == nullptr || L.nz == nullptr) archive_.fail("columns without their places");
      L.i = allocate<int>(L.nzmax);
      L.x = allocate<double>(L.nzmax);
      std::fill_n(static_cast<int*>(L.i), L.nzmax, 0);
      std::fill_n(static_cast<double*>(L.x), L.nzmax, 0.0);
    }
    const int *start = static_cast<const int*>(L.p), *count = static_cast<const int*>(L.nz);
    for (std::size_t j = 0; j < L.n; ++j) {
      if (start[j] < 0 || count[j] < 0 ||
          static_cast<std::size_t>(start[j]) + static_cast<std::size_t>(count[j]) > L.nzmax)
        archive_.fail("a column outside of the factor");
      archive_.bytes(static_cast<int*>(L.i) + start[j], static_cast<std::size_t>(count[j]) * sizeof(int));
      archive_.bytes(static_cast<double*>(L.x) + start[j], static_cast<std::size_t>(count[j]) * sizeof(double));
    }
  }

 private:
  // An array is stored whole, and columns have room for at most four times their entries.
  template <class Element>
  void* allocate(std::size_t length) {
    constexpr std::size_t room = 64;
    if (length / room > archive_.left()) archive_.fail("an array longer than the file");
    void* data = cholmod_malloc(std::max<std::size_t>(length, 1), sizeof(Element), &common_);
    if (data == nullptr) throw std::bad_alloc();
    return data;
  }

  Archive& archive_;
  cholmod_common& common_;
};

void factor_state(Archive& archive, cholmod_common& common, cholmod_factor*& factor) {
  bool is_there = factor != nullptr;
  archive(is_there);
  if (archive.reads() && factor != nullptr) cholmod_free_factor(&factor, &common);
  if (!is_there) return;
  std::size_t n = factor != nullptr ? factor->n : 0;
  archive(n);
  if (archive.reads()) {
    if (n > archive.left()) archive.fail("a factor longer than the file");
    factor = cholmod_allocate_factor(n, &common);
    if (factor == nullptr) throw std::bad_alloc();
  }
  cholmod_factor& L = *factor;
  archive(L.minor, L.nzmax, L.nsuper, L.ssize, L.xsize, L.maxcsize, L.maxesize);
  archive(L.ordering, L.is_ll, L.is_super, L.is_monotonic, L.itype, L.xtype, L.dtype);
  if (L.itype != CHOLMOD_INT || L.dtype != CHOLMOD_DOUBLE || (L.xtype != CHOLMOD_PATTERN && L.xtype != CHOLMOD_REAL))
    archive.fail("a factor of another kind of number");
  archive.bytes(L.Perm, n * sizeof(int));
  archive.bytes(L.ColCount, n * sizeof(int));
  FactorArrays arrays(archive, common);
  if (L.is_super) {
    arrays.array<int>(L.super, L.nsuper + 1);
    arrays.array<int>(L.pi, L.nsuper + 1);
    arrays.array<int>(L.px, L.nsuper + 1);
    arrays.array<int>(L.s, L.ssize);
    arrays.array<double>(L.x, L.xsize);
  } else {
    arrays.array<int>(L.p, n + 1);
    arrays.array<int>(L.nz, n);
    arrays.array<int>(L.next, n + 2);
    arrays.array<int>(L.prev, n + 2);
    arrays.columns(L);
  }
}

}  // namespace

void Cholesky::Implementation::state(Archive& archive) {
  archive(column_start, row, rows_per_node, order, inverse, order_nodes, order_nonzeros, nonzeros, flops);
  archive(spare, failed, updates, factored, pattern_kept, counters);
  factor_state(archive, common, L);
  factor_state(archive, common, symbolic);
  if (!archive.reads()) return;
  if (factored && L == nullptr) archive.fail("a factor is missing");
  // its numbers are those of the next factorisation
  NodePattern pattern;
  pattern.column_start = column_start;
  pattern.row = row;
  if (!column_start.empty() && !order.empty() && !shape(pattern)) throw std::bad_alloc();
}

void Cholesky::state(Archive& archive) {
  archive.part("factor");
  if (archive.reads()) implementation_ = std::make_shared<Implementation>(CholeskyOptions(implementation_->options));
  archive(generation_, *implementation_);
}

}  // namespace dartboard
