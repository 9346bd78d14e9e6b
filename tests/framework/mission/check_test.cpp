#include "framework/mission/check.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/framework/mission/still_modules.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class MissionCheckTest : public testing::Test {
 protected:
  MissionCheckTest()
      : folder_(std::filesystem::path(testing::TempDir()) / ("cairn_check_" + std::to_string(getpid()))),
        file_(folder_ / "mission.yaml") {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "robot.yaml") << "name: r\nradius_m: 0.2\nsonars: [{x_m: 0.1, y_m: 0, angle_deg: 0}]\n";
  }
  ~MissionCheckTest() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] MissionCheck check(const std::string& localizer, const std::string& steps,
                                   const std::vector<std::string>& overrides = {}) const {
    std::ofstream(file_) << "mission: m\nrobot: robot.yaml\nsensor: {plugin: still_sensor}\nlocalizer: {plugin: "
                         << localizer << "}\nmap: {plugin: still_map}\nsteps: " << steps << "\n";
    return check_mission(file_, overrides, still::library());
  }

  const std::filesystem::path folder_;
  const std::filesystem::path file_;
};

TEST_F(MissionCheckTest, AGoodMissionHasNoErrorsAndCountsItsSteps) {
  const MissionCheck good = check("still_localizer", "[{still_step: {}}, {sequence: [{still_step: {}}]}]");
  EXPECT_THAT(good.errors, IsEmpty());
  EXPECT_EQ(good.mission, "m");
  EXPECT_EQ(good.steps, 2U);
  EXPECT_EQ(good.nodes, 3U);
}

TEST_F(MissionCheckTest, AllErrorsAreFoundAtOnceEachWithItsPlace) {
  const MissionCheck bad = check("still_localiser", "[{still_stp: {}}]");
  EXPECT_THAT(bad.errors, ElementsAre(HasSubstr("mission.yaml:4:"), HasSubstr("did you mean \"still_step\"?")));
}

TEST_F(MissionCheckTest, ModulesAreNotMadeOfAFileThatCannotBeRead) {
  EXPECT_THAT(check("still_localiser", "[{still_step: {}}]", {"robot=nowhere.yaml"}).errors, SizeIs(1));
}

TEST_F(MissionCheckTest, ASlipAmongTheSettingsHidesNothingElse) {
  const MissionCheck bad = check("still_localiser", "[{still_stp: {}}, {repeat: 3}]",
                                 {"start.at_m=5", "seeed=1", "watchdog=2", "detector.plugin=still_detektor"});
  EXPECT_THAT(bad.errors,
              ElementsAre(HasSubstr("at_m must be a point [x, y]"), HasSubstr("did you mean \"seed\"?"),
                          HasSubstr("did you mean \"watchdog_s\"?"), HasSubstr("mission.yaml:6:"),
                          HasSubstr("still_localizer"), HasSubstr("still_detector"), HasSubstr("still_step")));
}

TEST_F(MissionCheckTest, FilesThatAreMissingAreAllNamedWhereTheMissionNamesThem) {
  const MissionCheck bad =
      check("still_localizer", "[{still_step: {}}]",
            {"world=nowhere/world.yaml", "detector.plugin=still_detector", "detector.templates=nowhere/templates"});
  const std::string here = std::filesystem::current_path().string();
  EXPECT_THAT(bad.errors, ElementsAre("--set detector.templates: templates: " + here +
                                          "/nowhere/templates: no such folder of templates",
                                      "--set world: world: " + here + "/nowhere/world.yaml: no such file"));
  std::filesystem::remove(folder_ / "robot.yaml");
  EXPECT_THAT(check("still_localizer", "[{still_step: {}}]").errors,
              ElementsAre(file_.string() + ":2:8: robot: " + (folder_ / "robot.yaml").string() + ": no such file"));
}

TEST_F(MissionCheckTest, ASlipUnderMarkersHidesNoCategoryAndMakesUpNoOtherError) {
  std::ofstream(folder_ / "robot.yaml", std::ios::app)
      << "cameras: [{x_m: 0.1, y_m: 0, height_m: 0.3, width_px: 64, height_px: 48, focal_px: [52, 52]}]\n";
  const std::string steps = "[{landmark_known: nearest dock}]";
  const auto errors_with = [&](const std::string& marker_setting) {
    return check("still_localizer", steps, {"markers.detector.plugin=still_tags", marker_setting}).errors;
  };
  EXPECT_THAT(errors_with("markers.categories={dock: [7]}"), IsEmpty());
  EXPECT_THAT(errors_with("markers={categories: {dock: [7]}, confirm: 3, detector: {plugin: still_tags}}"),
              ElementsAre(HasSubstr("confirm_sightings")));
  EXPECT_THAT(errors_with("markers.categories={dock: [7, 7]}"), ElementsAre(HasSubstr("is of category dock already")));
  EXPECT_THAT(errors_with("markers.categories={door: [7]}"),
              ElementsAre(HasSubstr("no template of category \"dock\"; it has door")));
}

TEST_F(MissionCheckTest, TagsThatTheDetectorNeverSeesAreRefused) {
  std::ofstream(folder_ / "robot.yaml", std::ios::app)
      << "cameras: [{x_m: 0.1, y_m: 0, height_m: 0.3, width_px: 64, height_px: 48, focal_px: [52, 52]}]\n";
  EXPECT_THAT(check("still_localizer", "[{landmark_known: tag 9999}, {still_step: {}}]",
                    {"markers.detector.plugin=still_tags", "markers.categories={dock: [40]}"})
                  .errors,
              ElementsAre(HasSubstr(":6:26: landmark_known: \"tag 9999\": there is no such tag: 36h11 has 0 to 586"),
                          HasSubstr("categories.dock: there is no tag with the id 40: 25h9 has 0 to 34")));
}

TEST_F(MissionCheckTest, WhatAModuleHasAgainstSeveralSettingsHasItsPlace) {
  EXPECT_THAT(check("still_refuser", "[{still_step: {}}]").errors,
              ElementsAre(HasSubstr("mission.yaml:4:12: these do not go together")));
}

TEST_F(MissionCheckTest, AMissingFileIsAnErrorLikeOthers) {
  const MissionCheck none = check_mission(folder_ / "none.yaml", {}, still::library());
  EXPECT_EQ(none.mission, "");
  EXPECT_THAT(none.errors, ElementsAre(HasSubstr("none.yaml")));
}

}  // namespace
}  // namespace cairn
