#include "validation/contact/ipctk/ipctk_questions.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/plain/error.h"

namespace dartboard::ipctk_questions_test {
namespace {

using Eigen::Vector3d;

/// Two triangles of two bodies at two places, with a sample in the second place.
IpctkQuestion question(bool in_motion) {
  IpctkQuestion q{.triangles = {{0, 1, 2}, {5, 4, 3}}, .bodies = {0, 7}, .in_motion = in_motion, .places = {}};
  for (const double z : {1.0, 0.1}) {
    IpctkPlace place;
    for (const double shift : {0.0, z})
      for (const Vector3d& p : {Vector3d(0, 0, shift), Vector3d(1, 0, shift), Vector3d(0, 1, shift / 3.0)})
        place.x.push_back(p);
    q.places.push_back(place);
  }
  q.places[1].samples = {{.nodes = {3, 4, 5}, .body = 0, .depth = 0.25}};
  q.places[1].felt = true;
  return q;
}

constexpr const char* right =
    R"({"answers": [{"crossing": [false, true], "squares": [[], [0.0625]], "free": [false]}]})";

std::string refusal(const std::string& text, bool in_motion = true) {
  const std::vector questions{question(in_motion)};
  try {
    answers_of(text, questions);
  } catch (const IoError& error) {
    return error.what();
  }
  return "no refusal";
}
/// The right answer, with another text at some place.
std::string refusal_with(const std::string& old, const std::string& other) {
  std::string text = right;
  return refusal(text.replace(text.find(old), old.size(), other));
}

TEST(IpctkQuestions, AreTextWithAllDigitsAndWithoutOurFindings) {
  const std::vector questions{question(false), question(true)};
  const nlohmann::json value = nlohmann::json::parse(text_of(questions));
  const nlohmann::json& second = value.at("questions").at(1);
  EXPECT_EQ(value.at("questions").size(), 2u);
  EXPECT_EQ(value.at("questions").at(0).at("in_motion"), false);
  EXPECT_EQ(second.at("in_motion"), true);
  EXPECT_EQ(second.at("triangles"), (nlohmann::json{{0, 1, 2}, {5, 4, 3}}));
  EXPECT_EQ(second.at("bodies"), (nlohmann::json{0, 7}));
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < 6; ++i)
      for (int c = 0; c < 3; ++c)
        EXPECT_EQ(second.at("places").at(k).at("x").at(i).at(static_cast<std::size_t>(c)).get<double>(),
                  questions[1].places[k].x[i][c]);
  EXPECT_TRUE(second.at("places").at(0).at("samples").empty());
  const nlohmann::json& sample = second.at("places").at(1).at("samples").at(0);
  EXPECT_EQ(sample.at("nodes"), (nlohmann::json{3, 4, 5}));
  EXPECT_EQ(sample.at("body"), 0);
  EXPECT_EQ(sample.size(), 2u);
  EXPECT_FALSE(second.at("places").at(1).contains("felt"));
}

TEST(IpctkAnswers, AreReadByPlaceSampleAndStep) {
  const std::vector questions{question(true)};
  const std::vector<IpctkAnswer> answers = answers_of(right, questions);
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_EQ(answers[0].crossing, (std::vector{false, true}));
  EXPECT_EQ(answers[0].squares, (std::vector<std::vector<double>>{{}, {0.0625}}));
  EXPECT_EQ(answers[0].free, (std::vector{false}));
}

TEST(IpctkAnswers, AreRefusedWhereSomethingIsMissingOrTooMuch) {
  EXPECT_EQ(refusal(right), "no refusal");
  EXPECT_EQ(refusal(""), "ipctk: its answers: 0 characters; expected JSON");
  EXPECT_EQ(refusal("{}"), "ipctk: its answers: no \"answers\"; expected 1 in a list");
  EXPECT_EQ(refusal("[]"), "ipctk: its answers: no \"answers\"; expected 1 in a list");
  EXPECT_EQ(refusal(R"({"answers": []})"), "ipctk: its answers: \"answers\" has 0; expected 1");
  EXPECT_EQ(refusal_with("false, true", "true"), "ipctk: its answers: \"crossing\" has 1; expected 2");
  EXPECT_EQ(refusal_with("[[], ", "["), "ipctk: its answers: \"squares\" has 1; expected 2");
  EXPECT_EQ(refusal_with("[0.0625]", "[]"), "ipctk: its answers: squares of a place: []; expected 1 of them");
  EXPECT_EQ(refusal_with("0.0625", "1, 2"), "ipctk: its answers: squares of a place: [1,2]; expected 1 of them");
  EXPECT_EQ(refusal_with("[false]", "[]"), "ipctk: its answers: \"free\" has 0; expected 1");
  EXPECT_EQ(refusal(right, false), "ipctk: its answers: \"free\" has 1; expected 0");
}

TEST(IpctkAnswers, AreRefusedWhereTheyAreNoVerdictsAndNoFiniteNumbers) {
  EXPECT_EQ(refusal_with("0.0625", "NaN"), "ipctk: its answers: 83 characters; expected JSON");
  EXPECT_EQ(refusal_with("0.0625", "null"),
            "ipctk: its answers: the square of a distance: null; expected a number >= 0");
  EXPECT_EQ(refusal_with("0.0625", "-1.0"),
            "ipctk: its answers: the square of a distance: -1.0; expected a number >= 0");
  EXPECT_NE(refusal_with("0.0625", "1e999"), "no refusal");
  EXPECT_EQ(refusal_with("true", "1"), "ipctk: its answers: \"crossing\" has 1; expected true or false");
  EXPECT_EQ(refusal_with("[false]", "[null]"), "ipctk: its answers: \"free\" has null; expected true or false");
}

}  // namespace
}  // namespace dartboard::ipctk_questions_test
