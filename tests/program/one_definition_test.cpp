// A name has one meaning in the whole program: two types of one name, in two sources that never see one another,
// compile and link, and then share constructors, destructors and whatever else the linker takes for the same.

#include "tests/program/one_definition.h"
#include "benchmarks/checkout/source_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace dartboard::one_definition_test {
namespace {

namespace fs = std::filesystem;

Definitions of(const std::string& text) {
  Definitions found;
  add_definitions(text, "one.h", found);
  return found;
}

std::string names(const Definitions& definitions) {
  std::string text;
  for (const auto& [name, files] : definitions) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// The names that two files or more define, each in its own way.
std::string repeated(const Definitions& definitions) {
  std::string text;
  for (const auto& [name, files] : definitions) {
    if (files.size() < 2 || name.starts_with("main(")) continue;  // each program has one
    text += name + ":";
    for (const auto& file : files) text += " " + file;
    text += "\n";
  }
  return text;
}

Definitions of_project() {
  Definitions found;
  for (const char* room : {"core", "reference", "validation", "benchmarks", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(source_folder() / room)) {
      const auto extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ostringstream text;
      text << std::ifstream(entry.path()).rdbuf();
      add_definitions(text.str(), fs::relative(entry.path(), source_folder()).generic_string(), found);
    }
  return found;
}

TEST(OneDefinition, OfEveryNameInTheProject) { EXPECT_EQ(repeated(of_project()), ""); }

TEST(OneDefinition, IsLookedForAmongAllTypes) {
  const Definitions found = of_project();
  for (const char* known : {"dartboard::Mesh", "dartboard::CellCounts", "dartboard::reference::CgalCounts",
                            "dartboard::CellKind", "dartboard::CountsByKind", "dartboard::MassSpringBody"})
    EXPECT_TRUE(found.contains(known)) << known;
  EXPECT_GT(found.size(), 1000u);
}

TEST(OneDefinition, IsMissedByATypeInTwoFiles) {
  Definitions found;
  add_definitions("namespace a {\nstruct Table { int rows; };\n}", "one.h", found);
  add_definitions("namespace a {\nstruct Table { double rows; };\n}", "other.cpp", found);
  EXPECT_EQ(repeated(found), "a::Table: one.h other.cpp\n");
}

TEST(OneDefinition, IsMissedByAnAliasAndAType) {
  Definitions found;
  add_definitions("namespace a { using Counts = std::array<double, 6>; }", "one.h", found);
  add_definitions("namespace a { class Counts final : public B<int> {}; }", "other.h", found);
  EXPECT_EQ(repeated(found), "a::Counts: one.h other.h\n");
}

TEST(OneDefinition, IsMissedByAnInlineFunctionInTwoFiles) {
  Definitions found;
  add_definitions("namespace a { inline int f(int x) { return x; } }", "one.h", found);
  add_definitions("namespace a { template <class T>\nint f(int x) { return x + 1; } }", "other.h", found);
  EXPECT_EQ(repeated(found), "a::f(int x): one.h other.h\n");
}

TEST(OneDefinition, IsKeptByNamespacesOfTheirOwn) {
  EXPECT_EQ(
      names(of("namespace a { struct T {}; namespace b { struct T {}; } } namespace a::c { enum class T : int {}; }")),
      "a::T, a::b::T, a::c::T");
}

TEST(OneDefinition, IsKeptByWhatAFileHasForItself) {
  EXPECT_EQ(names(of("namespace a { namespace { struct T {}; int f() { return 1; } } static int g() { return 2; } }")),
            "");
}

TEST(OneDefinition, IsNotMadeByADeclaration) {
  EXPECT_EQ(
      names(
          of("namespace a { struct T; class U; enum class E : int; void f(struct T*); template <class V> struct W; }")),
      "");
}

TEST(OneDefinition, IsNotMadeByWhatIsQuotedOrACommentOrWithinAFunction) {
  EXPECT_EQ(
      names(of("// struct A {};\n/* struct B {}; */ const char* c = \"struct C {};\"; auto d = R\"x(struct D {\n)x\";\n"
               "#define E struct E {}; \\\n struct F {};\nint f() { struct G {}; return 1'000; }")),
      "f()");
}

TEST(OneDefinition, OfATemplateAndOfItsSpecialisationsAreDifferent) {
  EXPECT_EQ(names(of("template <class T> struct H { struct I {}; }; template <> struct H<int> {}; template <class T>\n"
                     "  requires(sizeof(T) > 1)\nstruct J {};")),
            "H, H<int>, J");
}

TEST(OneDefinition, OfOverloadsAndMembersAreDifferent) {
  EXPECT_EQ(names(of("int f(int x) { return x; } int f(double x) { return 1; } int A::f(int x) const { return x; }\n"
                     "A::A(int x) : x_(x), y_{x} { g(); } bool operator==(A a, A b) { return true; }\n"
                     "void A::operator()(int x) { g(x); } template <class T> int B<T>::f(C<int> c) { return 2; }")),
            "A::A(int x), A::f(int x)const, A::operator()(int x), B<T>::f(C<int>c), f(double x), f(int x), "
            "operator==(A a,A b)");
}

}  // namespace
}  // namespace dartboard::one_definition_test
