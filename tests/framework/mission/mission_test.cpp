#include "framework/mission/mission.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace cairn {
namespace {

using testing::HasSubstr;

class MissionFile : public testing::Test {
 protected:
  MissionFile() { std::filesystem::create_directories(folder_); }
  ~MissionFile() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::filesystem::path write(const std::string& more) const {
    std::ofstream(folder_ / "m.yaml") << "mission: small\nrobot: " << CAIRN_SOURCE_DIR
                                      << "/config/robots/pioneer1.yaml\nsensor: {plugin: a}\n"
                                         "localizer: {plugin: b}\nmap: {plugin: c}\n"
                                      << more;
    return folder_ / "m.yaml";
  }
  [[nodiscard]] std::string error_of(const std::string& more) const {
    try {
      (void)load_mission(write(more));
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "no error";
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("cairn_mission_" + std::to_string(getpid()) + "_" +
                                                   testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(MissionFile, NamesItsModulesItsRobotAndItsSteps) {
  const Mission mission = load_mission(write("seed: 5\nsteps: [wait, {name: home, goto: {to: start}}]\n"));
  EXPECT_EQ(mission.config.mission, "small");
  EXPECT_EQ(mission.config.map.name, "c");
  EXPECT_EQ(mission.robot.sonars.size(), 7U);
  ASSERT_EQ(mission.steps.size(), 2U);
  EXPECT_EQ(mission.steps[1].name, "home");
  EXPECT_FALSE(mission.world.has_value());
  EXPECT_EQ(mission.world_fingerprint, "");
}

TEST_F(MissionFile, TheSeedOfTheCommandWinsOverThatOfTheFileAndOfOverrides) {
  EXPECT_EQ(load_mission(write("seed: 5\n")).config.seed, 5);
  EXPECT_EQ(load_mission(write("seed: 5\n"), {"seed=6"}).config.seed, 6);
  EXPECT_EQ(load_mission(write("seed: 5\n"), {"seed=6"}, 7).config.seed, 7);
}

TEST_F(MissionFile, AnUnknownKeyIsAnErrorWithItsPlaceAndTheNearestName) {
  EXPECT_THAT(error_of("sed: 5\n"), HasSubstr("m.yaml:6:1: "));
  EXPECT_THAT(error_of("sed: 5\n"), HasSubstr("did you mean \"seed\"?"));
}

TEST_F(MissionFile, AnAutosaveIsAPlainMapFileOfAnotherNameThanTheLastMap) {
  EXPECT_EQ(autosave_file_of(load_mission(write("")).config), "small.autosave.cairn");
  EXPECT_EQ(autosave_file_of(load_mission(write("autosave: {file: mine.cairn}\n")).config), "mine.cairn");
  EXPECT_THAT(error_of("autosave: {file: ../mine.cairn}\n"), HasSubstr("is not a plain file name"));
  EXPECT_THAT(error_of("autosave: {file: mine.map}\n"), HasSubstr("does not end in .cairn"));
  EXPECT_THAT(error_of("autosave: {file: small.cairn}\n"), HasSubstr("is the name of the map that the mission saves"));
}

TEST_F(MissionFile, ALandmarkThatIsLargerThanTheWorldIsAnError) {
  std::filesystem::create_directories(folder_ / "templates");
  std::ofstream(folder_ / "templates" / "silo.yaml") << "category: silo\ncircle: {diameter_m: 9}\n";
  std::ofstream(folder_ / "world.yaml") << "bounds_m: [[0, 0], [6, 5]]\n";
  EXPECT_THAT(error_of("world: world.yaml\ndetector: {plugin: d, templates: templates}\n"),
              HasSubstr("the template \"silo\" is 9 m across, larger than the mission's world of 6 x 5 m"));
}

TEST_F(MissionFile, AllThatIsWrongIsReportedNotOnlyTheFirst) {
  const ReadMission read = read_mission(write("world: nowhere.yaml\nsteps: [{repeat: 3}, {retry: {times: -1}}]\n"));
  EXPECT_EQ(read.errors.size(), 1U);
  EXPECT_GE(read.step_errors.size(), 1U);
  EXPECT_THAT(error_of("world: nowhere.yaml\n"), HasSubstr("nowhere.yaml"));
}

// `make demo` builds some modules only.
TEST(Demo, BuildsTheModulesOfItsMission) {
  const std::filesystem::path project = CAIRN_SOURCE_DIR;
  const MissionConfig config = load_mission(project / "config/missions/office.yaml").config;
  std::ifstream file(project / "Makefile");
  const std::string makefile{std::istreambuf_iterator<char>(file), {}};
  const std::size_t begin = makefile.find("\ndemo:");
  const std::string demo = makefile.substr(begin, makefile.find("office.yaml", begin) - begin);
  // hybrid's own defaults are the last two.
  for (const std::string& module :
       {config.sensor.name, config.localizer.name, config.map.name, config.detector.name, config.planner.name,
        config.controller.name, std::string("behaviours"), std::string("landmark_search"), std::string("ompl")})
    EXPECT_THAT(demo, HasSubstr(" " + module)) << "the mission cannot run without it";
}

}  // namespace
}  // namespace cairn
