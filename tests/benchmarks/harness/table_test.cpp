#include "benchmarks/harness/table.h"

#include <gtest/gtest.h>

#include "core/plain/error.h"

namespace dartboard::table_test {
namespace {

Table times() {
  Table table({{"walk"}, {"ms", Align::right}});
  table.add_row({"coverage", "12"});
  table.add_row({"cell arrays", "2.04"});
  return table;
}

TEST(Table, PrintsAlignedColumnsUnderARule) {
  EXPECT_EQ(to_text(times()),
            "walk           ms\n"
            "-----------  ----\n"
            "coverage       12\n"
            "cell arrays  2.04\n");
}

TEST(Table, KeepsLineBreaksInsideTheirCell) {
  Table table({{"norm"}});
  table.add_row({"|v|\nmax"});
  EXPECT_EQ(to_text(table),
            "norm\n"
            "-------\n"
            "|v| max\n");
}

TEST(Table, CountsCodePointsNotBytes) {
  Table table({{"bound"}, {"x"}});
  table.add_row({"≤ 1.10", "y"});
  EXPECT_EQ(to_text(table),
            "bound   x\n"
            "------  -\n"
            "≤ 1.10  y\n");
}

TEST(Table, WithoutRowsStillHasItsHeader) { EXPECT_EQ(to_text(Table({{"a"}, {"b"}})), "a  b\n-  -\n"); }

TEST(Table, RefusesARowOfAnotherLength) {
  Table table = times();
  EXPECT_THROW(table.add_row({"lists"}), InputError);
  EXPECT_EQ(table.rows().size(), 2u);
  EXPECT_THROW(Table({}), InputError);
}

}  // namespace
}  // namespace dartboard::table_test
