#include "framework/experiments/config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace cairn {
namespace {

using testing::ElementsAre;

class ExperimentFile : public testing::Test {
 protected:
  ExperimentFile() { std::filesystem::create_directories(folder_); }
  ~ExperimentFile() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] ExperimentConfig load(const std::string& text) const {
    std::ofstream(folder_ / "e.yaml") << text;
    return load_experiment(folder_ / "e.yaml");
  }
  // Without the folder.
  [[nodiscard]] std::string error_of(const std::string& text) const {
    try {
      (void)load(text);
    } catch (const ConfigError& error) {
      return std::string(error.what()).substr(folder_.string().size() + 1);
    }
    return "no error";
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("cairn_experiment_file_" + std::to_string(getpid()));
};

const std::string kTrials = "experiment: trials\ntrials: {robots: [r.yaml], templates: t}\n";
const std::string kVariants = "variants:\n  - {name: plain}\n  - {name: office, world: office.yaml}\n";

TEST_F(ExperimentFile, HomesHaveRangesThatFitTogether) {
  const std::string homes = "experiment: homes\nmissions: [m.yaml]\n";
  EXPECT_EQ(error_of(homes + "homes: {min_rooms: 4, max_rooms: 5}\n"), "no error");
  EXPECT_EQ(error_of(homes + "homes: {min_rooms: 7}\n"),
            "e.yaml:3:20: min_rooms must be at most max_rooms, found 7 and 6");
  EXPECT_EQ(error_of(homes + "homes: {max_door_m: 0.5}\n"),
            "e.yaml:3:21: min_door_m must be at most max_door_m, found 0.75 and 0.5");
  EXPECT_EQ(error_of(homes + "variants: [{name: office, world: office.yaml}]\n"),
            "e.yaml:3:34: variant \"office\" names a world, but each run of homes has its own");
}

TEST_F(ExperimentFile, AVariantNamesAWorldWhereTheMissionsHaveOne) {
  const ExperimentConfig config = load("experiment: missions\nmissions: [m.yaml]\n" + kVariants);
  ASSERT_EQ(config.variants.size(), 2U);
  EXPECT_THAT(config.variants[0].overrides, testing::IsEmpty());
  EXPECT_THAT(config.variants[1].overrides, ElementsAre("world=" + (folder_ / "office.yaml").string()));
}

TEST_F(ExperimentFile, AVariantNamesNoWorldWhereEachRunHasItsOwn) {
  EXPECT_EQ(error_of(kTrials + kVariants),
            "e.yaml:5:27: variant \"office\" names a world, but each run of trials has its own");
  EXPECT_EQ(error_of("experiment: recognition\nmissions: [m.yaml]\n" + kVariants),
            "e.yaml:5:27: variant \"office\" names a world, but each run of recognition has its own");
  EXPECT_EQ(load(kTrials).variants.size(), 1U);
}

TEST_F(ExperimentFile, AnExperimentOfBuildingsRunsNoMissions) {
  EXPECT_EQ(load("experiment: buildings\nbuildings: {landmarks: 50}\n").buildings.landmarks, 50);
  EXPECT_EQ(error_of("experiment: buildings\nmissions: [m.yaml]\n"),
            "e.yaml:2:11: an experiment of buildings runs no missions");
  EXPECT_EQ(error_of("experiment: missions\nmissions: [m.yaml]\nbuildings: {landmarks: 50}\n"),
            "e.yaml:3:12: buildings goes with experiment: buildings");
  EXPECT_EQ(error_of("experiment: buildings\nbuildings: {sides_m: []}\n"),
            "e.yaml:2:12: sides_m must list at least one side");
}

}  // namespace
}  // namespace cairn
