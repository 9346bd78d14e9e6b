// docs/own-flat.md: its commands run as they are printed, and the mission does what the page says.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::filesystem::path kSource = CAIRN_SOURCE_DIR;

std::string page() {
  return text_of_file(kSource / "docs/own-flat.md");
}

// The lines of the page that are commands.
std::vector<std::string> commands() {
  std::vector<std::string> commands;
  std::istringstream lines(page());
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("    ")) commands.push_back(line.substr(4));
  return commands;
}

// The folder that the page calls the folder of the clone, after its commands were run there in their order.
class MyFlat : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder() = fresh_folder("my_flat");
    std::filesystem::create_directories(folder() / "build");
    std::filesystem::create_directory_symlink(CAIRN_BINARY_DIR, folder() / "build/release");
    std::filesystem::create_directory_symlink(kSource / "config", folder() / "config");
    for (const std::string& command : commands()) {
      const std::string line = "cd '" + folder().string() + "' && " + command + " >> output.txt 2>&1";
      if (const int status = std::system(line.c_str()); status != 0) failed() += command + "\n";
    }
  }
  static std::filesystem::path& folder() {
    static std::filesystem::path path;
    return path;
  }
  static std::string& failed() {
    static std::string commands;
    return commands;
  }
  static std::string output() { return text_of_file(folder() / "output.txt"); }
};

TEST_F(MyFlat, EveryCommandOfThePageRunsAsPrinted) {
  EXPECT_GE(commands().size(), 9U);
  EXPECT_EQ(failed(), "") << output();
  for (const char* picture : {"out/my_flat_bedroom.png", "out/my_flat/map.png", "out/my_flat/plan.png"})
    EXPECT_TRUE(std::filesystem::exists(folder() / picture)) << picture;
}

TEST_F(MyFlat, EveryRoomIsEnteredAndItsLandmarkHasTheNameOfTheRoom) {
  const SavedMap map = load_map(folder() / "out/my_flat/my_flat.cairn");
  const auto expect_at = [&](const std::string& name, const std::string& category, const Point& at_m) {
    const Landmark* const landmark = map.graph.find_by_name(name);
    ASSERT_NE(landmark, nullptr) << name;
    EXPECT_EQ(landmark->category, category) << name;
    EXPECT_LT((landmark->T_map_landmark.position() - at_m).norm(), 0.25) << name;
  };
  expect_at("living room", "square", {2.6, 1.4});
  expect_at("bedroom", "circle", {6.5, 2.1});
  expect_at("kitchen", "triangle", {2.1, 6.3});
}

TEST_F(MyFlat, ThePatrolVisitsTheRoomsByTheirNamesAndTheRobotTouchesNothing) {
  const json report = json::parse(text_of_file(folder() / "out/my_flat/report.json"));
  EXPECT_EQ(report["outcome"], "done") << report["reason"];
  EXPECT_EQ(report["collisions"], 0);
  EXPECT_THAT(report["steps"][5]["reason"].get<std::string>(), HasSubstr("2 rounds, 6 places visited"));
  EXPECT_THAT(output(), HasSubstr("at kitchen (triangle)"));
  EXPECT_THAT(output(), HasSubstr("bedroom -> kitchen: solved"));
}

// The floor plan is what the first commands plan on.
TEST_F(MyFlat, OnTheFloorPlanBothDoorsArePassedWithTheUsualMargin) {
  const std::string text = output();
  for (const char* question : {"0.8,0.8 -> 6,0.7: solved", "0.8,0.8 -> 2,7: solved"}) {
    const std::size_t at = text.find(question);
    ASSERT_NE(at, std::string::npos) << question << "\n" << text;
    EXPECT_THAT(text.substr(at, text.find('\n', at) - at), HasSubstr("(margin 0.12 m)"));
  }
}

// What the page shows of files is in them.
TEST(OwnFlatPage, ShowsPartsOfTheFilesThatAreRun) {
  std::string files;
  for (const char* file : {"floor_plans/my_flat.yaml", "worlds/my_flat.yaml", "missions/my_flat.yaml"})
    files += text_of_file(kSource / "config" / file);
  const std::string begin = "\n```yaml\n";
  std::size_t blocks = 0;
  const std::string text = page();
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at), ++blocks) {
    at += begin.size();
    std::string block = text.substr(at, text.find("\n```", at) + 1 - at);
    if (block.starts_with("walls:\n") || block.starts_with("objects:\n")) block.erase(0, block.find('\n') + 1);
    EXPECT_THAT(files, HasSubstr(block));
  }
  EXPECT_EQ(blocks, 4U);
}

}  // namespace
}  // namespace cairn::testing_program
