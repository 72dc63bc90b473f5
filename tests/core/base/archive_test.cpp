#include "core/base/archive.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/plain/error.h"

namespace dartboard::archive_test {
namespace {

struct Inner {
  std::uint32_t number = 0;
  bool flag = false;
  template <class SomeArchive>
  void state(SomeArchive& archive) {
    archive(number, flag);
  }
};

/// A value of every sort that is stored.
struct Outer {
  double real = 0.0;
  std::string text;
  std::vector<double> reals;
  std::vector<Eigen::Vector3d> vectors;
  std::vector<std::array<std::uint32_t, 2>> pairs;
  std::vector<Inner> inners;
  std::optional<Inner> maybe, nothing;
  template <class SomeArchive>
  void state(SomeArchive& archive) {
    archive(real, text, reals, vectors, pairs, inners, maybe, nothing);
  }
};

Outer telling() {
  return {.real = -0.0,
          .text = std::string("a\0b", 3),
          .reals = {1.5, std::numeric_limits<double>::denorm_min(), -3.0},
          .vectors = {{1, 2, 3}, {4, 5, 6}},
          .pairs = {{7, 8}, {9, 10}, {11, 12}},
          .inners = {{13, true}, {14, false}},
          .maybe = Inner{15, true},
          .nothing = {}};
}

std::string written(Outer value) {
  Archive archive;
  archive.part("outer");
  archive(value);
  return archive.written();
}

std::string complaint(const std::string& bytes, auto&& read) {
  Archive archive(bytes, "file");
  try {
    read(archive);
    archive.require_end();
    return "";
  } catch (const IoError& error) {
    return error.what();
  }
}

TEST(Archive, ReadsWhatWasWritten) {
  const std::string bytes = written(telling());
  Archive archive(bytes, "file");
  // the earlier content is gone
  Outer read = telling();
  read.real = 9.0;
  read.reals = {1, 2, 3, 4, 5};
  read.inners.resize(7);
  read.nothing = Inner{1, true};
  archive.part("outer");
  archive(read);
  archive.require_end();
  EXPECT_TRUE(std::signbit(read.real));
  EXPECT_EQ(read.text, telling().text);
  EXPECT_EQ(read.reals, telling().reals);
  EXPECT_EQ(read.vectors, telling().vectors);
  EXPECT_EQ(read.pairs, telling().pairs);
  ASSERT_EQ(read.inners.size(), 2u);
  EXPECT_EQ(read.inners[0].number, 13u);
  EXPECT_TRUE(read.inners[0].flag);
  EXPECT_EQ(read.inners[1].number, 14u);
  EXPECT_FALSE(read.inners[1].flag);
  ASSERT_TRUE(read.maybe);
  EXPECT_EQ(read.maybe->number, 15u);
  EXPECT_FALSE(read.nothing);
}

TEST(Archive, RefusesWhatEndsTooSoonWhereverThatIs) {
  const std::string bytes = written(telling());
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const std::string what = complaint(bytes.substr(0, length), [](Archive& archive) {
      Outer read;
      archive.part("outer");
      archive(read);
    });
    EXPECT_EQ(what.find("file: is damaged"), 0u) << length << ": " << what;
  }
}

TEST(Archive, RefusesWhatGoesOnAfterItsEnd) {
  EXPECT_EQ(complaint(written(telling()) + "!",
                      [](Archive& archive) {
                        Outer read;
                        archive.part("outer");
                        archive(read);
                      }),
            "file: is damaged, in 'outer': 1 bytes are left; expected 0");
}

// A length of 2^62 numbers: no machine has that much memory.
TEST(Archive, HoldsALengthAgainstWhatIsLeftBeforeItAsksForMemory) {
  Archive out;
  std::uint64_t length = std::uint64_t{1} << 62;
  double one = 1.0;
  out(length, one);
  EXPECT_EQ(complaint(out.written(),
                      [](Archive& archive) {
                        std::vector<double> column;
                        archive(column);
                      }),
            "file: is damaged: a column has 4611686018427387904 elements; expected no more than the 8 bytes left hold");
  EXPECT_NE(complaint(out.written(),
                      [](Archive& archive) {
                        std::vector<Inner> column;
                        archive(column);
                      }),
            "");
}

TEST(Archive, HoldsWhichKindOfSeveralThereIs) {
  using OneOf = std::variant<std::monostate, std::vector<double>, Inner>;
  for (const OneOf& value : {OneOf(), OneOf(std::vector<double>{1.5, 2.5}), OneOf(Inner{15, true})}) {
    Archive out;
    OneOf from = value, read = Inner{1, false};
    out(from);
    Archive in(out.written(), "file");
    in(read);
    in.require_end();
    ASSERT_EQ(read.index(), value.index());
  }
  EXPECT_EQ(complaint("\x03",
                      [](Archive& archive) {
                        OneOf read;
                        archive(read);
                      }),
            "file: is damaged: the number of a kind is 3; expected less than 3");
}

TEST(Archive, RefusesAnotherPartThanTheOneThatShouldFollow) {
  EXPECT_EQ(complaint(written(telling()), [](Archive& archive) { archive.part("inner"); }),
            "file: is damaged: 'inner' should follow");
}

TEST(Archive, RefusesAFlagThatIsNeitherYesNorNo) {
  EXPECT_EQ(complaint("\2",
                      [](Archive& archive) {
                        bool flag = false;
                        archive(flag);
                      }),
            "file: is damaged: a yes or no is 2; expected 0 or 1");
}

}  // namespace
}  // namespace dartboard::archive_test
