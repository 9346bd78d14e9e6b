// The code and the files of guides are this folder's, and their missions do what the guides say.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using testing::HasSubstr;

const std::filesystem::path kSource = CAIRN_SOURCE_DIR;
const std::filesystem::path kFolder = kSource / "tests/guide/pillar_finder";
const std::filesystem::path kOwnMission = kSource / "tests/guide/own_mission";
const std::string kModules = std::string(CAIRN_BINARY_DIR) + "/tests/guide";

std::string guide() {
  return text_of_file(kSource / "docs/plugin-guide.md");
}

// The texts between ```LANGUAGE and ```.
std::vector<std::string> blocks_of(const std::string& language, const std::string& text = guide()) {
  const std::string begin = "\n```" + language + "\n";
  std::vector<std::string> blocks;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
    at += begin.size();
    blocks.push_back(text.substr(at, text.find("\n```", at) + 1 - at));
  }
  return blocks;
}

std::string all_files_with(const std::vector<std::string>& extensions, const std::filesystem::path& folder = kFolder) {
  std::string text;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    for (const std::string& extension : extensions)
      if (entry.path().extension() == extension) text += "\n" + text_of_file(entry.path());
  return text;
}

TEST(Guide, EveryBlockOfCodeStandsInACompiledFile) {
  const std::string code = all_files_with({".hpp", ".cpp"});
  EXPECT_GE(blocks_of("cpp").size(), 5U);
  for (const std::string& block : blocks_of("cpp")) EXPECT_THAT(code, HasSubstr("\n" + block));
}

TEST(Guide, EveryBlockOfConfigurationStandsInAFileThatIsRun) {
  const std::string files = all_files_with({".yaml"});
  EXPECT_GE(blocks_of("yaml").size(), 1U);
  for (const std::string& block : blocks_of("yaml")) EXPECT_THAT(files, HasSubstr("\n" + block));
}

TEST(Guide, TheDriveOfTheSensorGuideStandsInACompiledFile) {
  const std::string page = text_of_file(kSource / "docs/write-a-sensor.md");
  const std::string code = all_files_with({".hpp", ".cpp"}, kSource / "tests/guide/wheels");
  EXPECT_EQ(blocks_of("cpp", page).size(), 6U);
  for (const std::string& block : blocks_of("cpp", page)) EXPECT_THAT(code, HasSubstr("\n" + block));
  const std::vector<std::string> missions = blocks_of("yaml", page);
  EXPECT_EQ(missions, std::vector{text_of_file(kSource / "tests/guide/wheels/mission.yaml")});
}

TEST(Guide, TheBaseOfOnesOwnStandsInCompiledFiles) {
  const std::string page = text_of_file(kSource / "docs/your-robot.md");
  const std::string code = all_files_with({".hpp", ".cpp"}, kSource / "tests/guide/own_base");
  EXPECT_EQ(blocks_of("cpp", page).size(), 6U);
  for (const std::string& block : blocks_of("cpp", page)) EXPECT_THAT(code, HasSubstr("\n" + block));
  const std::vector<std::string> missions = blocks_of("yaml", page);
  EXPECT_EQ(missions, std::vector{text_of_file(kSource / "tests/guide/own_base/mission.yaml")});
}

TEST(Guide, TheMissionOfTheSensorGuideIsSoundAndSaysWhichLineCannotBeOpened) {
  const std::string mission = (kSource / "tests/guide/wheels/mission.yaml").string();
  const Finished finished = run_cairn({"run", mission, "--plugins", kModules, "--set", "sensor.device=/dev/no_board",
                                       "--out", fresh_folder("guide_board").string()});
  EXPECT_EQ(finished.exit_status, 2) << finished.out;
  EXPECT_THAT(finished.err, HasSubstr("/dev/no_board cannot be opened: No such file or directory"));
}

// Each way to describe a setting, as fields.hpp declares them.
TEST(Guide, TheTableOfFieldsHasEveryTypeOfSetting) {
  const std::string header = text_of_file(kSource / "framework/config/fields.hpp");
  std::set<std::string> types;
  for (const std::string begin : {"  FieldSpec& ", "  void "})
    for (std::size_t at = header.find("\n" + begin); at != std::string::npos; at = header.find("\n" + begin, at + 1)) {
      const std::size_t name = at + 1 + begin.size();
      types.insert(header.substr(name, header.find('(', name) - name));
    }
  types.erase("add");  // private
  EXPECT_GE(types.size(), 18U);
  for (const std::string& type : types) EXPECT_THAT(guide(), HasSubstr("\n| `" + type + "` |"));
}

TEST(Guide, TheFilesOfYourOwnMissionAreThoseThatAreRun) {
  const std::vector<std::string> blocks = blocks_of("yaml", text_of_file(kSource / "docs/your-own-mission.md"));
  std::vector<std::string> files;
  for (const char* file : {"world.yaml", "templates/crate.yaml", "robot.yaml", "mission.yaml"})
    files.push_back(text_of_file(kOwnMission / file));
  EXPECT_EQ(blocks, files);
}

TEST(Guide, YourOwnMissionFindsTheCrateAndReturns) {
  const std::filesystem::path out = fresh_folder("own_mission");
  const Finished finished =
      run_cairn({"run", (kOwnMission / "mission.yaml").string(), "--out", out.string(), "--json"});
  ASSERT_EQ(finished.exit_status, 0) << finished.err;
  const auto report = nlohmann::json::parse(finished.out);
  ASSERT_EQ(report["landmarks"].size(), 1U) << report["landmarks"].dump(1);
  EXPECT_EQ(report["landmarks"][0]["category"], "crate");
  EXPECT_NEAR(report["landmarks"][0]["x_m"].get<double>(), 3.4, 0.1);
  EXPECT_NEAR(report["landmarks"][0]["y_m"].get<double>(), 2.6, 0.1);
}

TEST(Guide, TheMissionFindsBothPillarsAndNothingElse) {
  const std::filesystem::path out = fresh_folder("guide");
  const Finished finished =
      run_cairn({"run", (kFolder / "mission.yaml").string(), "--plugins", kModules, "--out", out.string(), "--json"});
  ASSERT_EQ(finished.exit_status, 0) << finished.err;
  const auto report = nlohmann::json::parse(finished.out);
  ASSERT_EQ(report["landmarks"].size(), 2U) << report["landmarks"].dump(1);
  double left_m = report["landmarks"][0]["x_m"];
  double right_m = report["landmarks"][1]["x_m"];
  if (left_m > right_m) std::swap(left_m, right_m);
  EXPECT_NEAR(left_m, 1.8, 0.1);
  EXPECT_NEAR(right_m, 4.2, 0.1);
  for (const auto& landmark : report["landmarks"]) EXPECT_NEAR(landmark["y_m"].get<double>(), 2.0, 0.1);
}

// What the guide quotes of messages, so that readers find them by searching.
TEST(Guide, AMisspeltSettingIsAnsweredAsTheGuideSays) {
  const Finished finished = run_cairn({"run", (kFolder / "mission.yaml").string(), "--plugins", kModules, "--out",
                                       fresh_folder("guide_bad").string(), "--set", "detector.diametr_m=0.3"});
  EXPECT_EQ(finished.exit_status, 2);
  const std::string quoted =
      "unknown key \"diametr_m\" in plugin pillar_finder (did you mean \"diameter_m\"?); known: diameter_m, "
      "tolerance_m, tau_match, category";
  EXPECT_THAT(finished.err, HasSubstr(quoted));
  EXPECT_THAT(guide(), HasSubstr(quoted));
}

TEST(Guide, AForeignStampIsAnsweredAsTheGuideSays) {
  const Finished finished =
      run_cairn({"plugins", "--plugins", std::string(CAIRN_BINARY_DIR) + "/tests/plugin/wrong_stamp"});
  EXPECT_EQ(finished.exit_status, 1);
  for (const char* quoted : {"was built with another ABI.", "Build the module again against this program's headers."}) {
    EXPECT_THAT(finished.err, HasSubstr(quoted));
    EXPECT_THAT(guide(), HasSubstr(quoted));
  }
}

TEST(Guide, AModuleThatIsNotFoundIsAnsweredAsTheGuideSays) {
  const Finished finished =
      run_cairn({"run", (kFolder / "mission.yaml").string(), "--out", fresh_folder("guide_none").string()});
  EXPECT_EQ(finished.exit_status, 2);
  const std::string quoted = "unknown detector plugin \"pillar_finder\"";
  EXPECT_THAT(finished.err, HasSubstr(quoted));
  EXPECT_THAT(guide(), HasSubstr(quoted));
}

}  // namespace
}  // namespace cairn::testing_program
