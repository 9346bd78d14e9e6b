#include "framework/experiments/trials/random_mission.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "framework/experiments/trials/random_world.hpp"
#include "framework/experiments/trials/true_space.hpp"
#include "framework/files/robot_file.hpp"
#include "framework/files/template_file.hpp"
#include "framework/files/world_file.hpp"
#include "framework/mission/mission.hpp"
#include "tests/framework/config/config_test_support.hpp"

namespace cairn {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kConfig = std::string(CAIRN_SOURCE_DIR) + "/config";

struct Drawn {
  std::string text;
  Mission mission;
};

Drawn draw(const TrialsConfig& config, std::uint64_t seed) {
  const config_test::TestFolder folder;
  RandomWorldConfig worlds;
  worlds.max_movers = 3;
  worlds.max_doors = 2;
  const std::vector<LandmarkShape> shapes = load_landmark_shapes(kConfig + "/templates");
  const auto world = folder.write("world.yaml", random_world_yaml(worlds, shapes, 0.1, seed));
  const RobotModel robot = load_robot(kConfig + "/robots/pioneer1.yaml");
  const MissionFiles files{kConfig + "/robots/pioneer1.yaml", "world.yaml", kConfig + "/templates"};
  Drawn drawn;
  drawn.text = random_mission_yaml(config, files, robot, load_world(world, shapes), seed);
  drawn.mission = load_mission(folder.write("mission.yaml", drawn.text));
  return drawn;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(RandomMission, IsWholeOnEverySeedAndAsRandomAsItSays) {
  TrialsConfig config;
  config.faults_per_hour = {6, 6, 2, 2, 6, 1};
  config.battery_ratio = 0.2;
  std::set<std::string> nodes;
  std::size_t silent = 0;
  std::size_t batteries = 0;
  constexpr int kSeeds = 60;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Drawn drawn = draw(config, seed);
    for (const TreeNode* leaf : behaviours_of(drawn.mission.steps)) nodes.insert(leaf->choice.name);
    EXPECT_GE(drawn.mission.steps.size(), 2U + static_cast<std::size_t>(config.min_goals));
    const TrueSpace space(*drawn.mission.world, drawn.mission.robot.radius_m + config.clearance_m - 0.001);
    EXPECT_TRUE(space.has_room(drawn.mission.config.start.at_m)) << "seed " << seed;
    silent += count(drawn.text, "silent: true");
    batteries += count(drawn.text, "battery:");
  }
  EXPECT_THAT(nodes, testing::IsSupersetOf({"explore", "goto", "tour", "patrol", "wait", "return_home"}));
  EXPECT_NEAR(static_cast<double>(silent), 6.0 * kSeeds, 4.0 * std::sqrt(6.0 * kSeeds)) << "a Poisson process";
  EXPECT_NEAR(static_cast<double>(batteries), 0.2 * kSeeds, 13.0);
}

TEST(RandomMission, TheSameSeedGivesTheSameText) {
  TrialsConfig config;
  config.faults_per_hour = {6, 6, 2, 2, 6, 1};
  const std::string text = draw(config, 7).text;
  EXPECT_EQ(draw(config, 7).text, text);
  EXPECT_NE(draw(config, 8).text, text);
}

TEST(RandomMission, NeighbouringSeedsShareNoTimeOfAFault) {
  TrialsConfig config;
  config.faults_per_hour = {6, 6, 6, 6, 6, 6};
  std::multiset<std::string> times;
  const std::regex time("at_s: ([0-9.]+)");
  for (std::uint64_t seed = 8; seed < 16; ++seed) {
    const std::string text = draw(config, seed).text;
    for (std::sregex_iterator found(text.begin(), text.end(), time), end; found != end; ++found)
      times.insert((*found)[1]);
  }
  const std::set<std::string> distinct(times.begin(), times.end());
  EXPECT_GT(times.size(), 200U);
  EXPECT_LE(times.size() - distinct.size(), 2U) << "to a hundredth of a second two may happen to be the same";
}

TEST(RandomMission, AnotherRateOfOneFaultLeavesTheOthersAsTheyWere) {
  TrialsConfig config;
  config.faults_per_hour = {6, 0, 0, 0, 6, 0};
  const std::string few = draw(config, 7).text;
  config.faults_per_hour.stuck = 60;
  const std::string many = draw(config, 7).text;
  EXPECT_THAT(few, Not(HasSubstr("stuck")));
  EXPECT_EQ(std::regex_replace(many, std::regex("    - [^\n]*stuck[^\n]*\n"), ""), few);
}

TEST(RandomMission, DeafRingsAreWholeHalvesAndPartsAndEndSomeTime) {
  TrialsConfig config;
  config.faults_per_hour.deaf = 30;
  std::string text;
  for (std::uint64_t seed = 0; seed < 4; ++seed) text += draw(config, seed).text;
  for (const char* part : {"deaf: whole", "deaf: left", "deaf: right", "dead: ["}) EXPECT_GT(count(text, part), 5U);
  EXPECT_EQ(count(text, "at_s:"), count(text, "for_s:"));
}

TEST(RandomMission, WithoutRatesThereAreNoFaults) {
  EXPECT_THAT(draw({}, 7).text, Not(HasSubstr("faults")));
}

TEST(RandomMission, ARobotWithoutRoomIsRefused) {
  World world;
  world.max_m = {0.4, 0.4};
  world.walls = {{{{0, 0}, {0.4, 0}, {0.4, 0.4}, {0, 0.4}, {0, 0}}}};
  RobotModel robot;
  robot.name = "Pioneer 1";
  try {
    (void)random_mission_yaml({}, {}, robot, world, 3);
    FAIL() << "there is no room";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("the robot and 0.12 m beside it have room nowhere in the random world of seed 3"));
  }
}

}  // namespace
}  // namespace cairn
