#include "benchmarks/pages/player_page.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "benchmarks/pages/page.h"
#include "core/plain/error.h"
#include "tests/support/folder_for_tests.h"
#include "tests/support/moving_box.h"

namespace dartboard::player_page_test {
namespace {

class PlayerPageTest : public FolderTest {
 protected:
  static nlohmann::json page_of(const std::string& name) {
    nlohmann::json json = moving::moving_box();
    json["name"] = name;
    const SceneFile scene = moving::parse(json);
    const Simulation simulation(scene);
    const RecordedFrames frames(simulation, {0}, scene);
    const Look look = look_of(scene);
    return player_page(frames, {scene, look, {"name", "verlet"}, {"it is too stiff"}, "mass [kg]  1"});
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
};

TEST_F(PlayerPageTest, HoldsItsDataWhateverTheyAreCalled) {
  const std::string name = "</script><script>&\"'\\ \u00e9";
  const nlohmann::json page = page_of(name);
  ASSERT_EQ(write_page("player", page, folder_ / "page.html"), "");
  const std::string html = text("page.html"), begin = R"(<script type="application/json" id="page">)";
  const std::size_t from = html.find(begin) + begin.size();
  EXPECT_EQ(nlohmann::json::parse(html.substr(from, html.find("</script>", from) - from)), page);
  EXPECT_NE(html.find("<h1>&lt;/script&gt;&lt;script&gt;&amp;&#34;&#39;\\ \u00e9</h1>"), std::string::npos);
  EXPECT_NE(html.find("warning: it is too stiff"), std::string::npos);
  EXPECT_TRUE(is_page(folder_ / "page.html", "player"));
}

TEST_F(PlayerPageTest, IsSeenFromWherePicturesAre) {
  const nlohmann::json page = page_of("box");
  EXPECT_EQ(page["up"], (std::vector{0.0, 0.0, 1.0}));
  const Eigen::Vector3d from(page["towards"][0], page["towards"][1], page["towards"][2]);
  EXPECT_LT((from - Eigen::Vector3d(0.45, -0.8, 0.4).normalized()).norm(), 1e-14);
}

TEST_F(PlayerPageTest, IsWrittenOverAPageAloneAndOnlyWhereThatIsAsked) {
  write("page.html", "<!DOCTYPE html><!-- Made by Dartboard: player. -->\n");
  write("other.html", "<!DOCTYPE html>\n<!-- Made by Dartboard: player. -->\n");
  EXPECT_THROW(require_writable_page(folder_ / "page.html", "player", false, ""), IoError);
  EXPECT_NO_THROW(require_writable_page(folder_ / "page.html", "player", true, ""));
  EXPECT_THROW(require_writable_page(folder_ / "page.html", "report", true, ""), IoError);
  EXPECT_THROW(require_writable_page(folder_ / "other.html", "player", true, ""), IoError);
  EXPECT_THROW(require_writable_page(folder_ / "none" / "page.html", "player", false, ""), IoError);
  EXPECT_NO_THROW(require_writable_page(folder_ / "none" / "page.html", "player", false, folder_ / "none/"));
}

}  // namespace
}  // namespace dartboard::player_page_test
