// A robot that is carried between two runs of a mission notices it, and finds itself before it draws on.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

Finished run_office(const std::filesystem::path& folder, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{
      "run",
      source_folder() + "/config/missions/office.yaml",
      "--out",
      folder.string(),
      "--json",
      "--set",
      "steps=[{explore: {until_known_ratio: 0.95, at_most_s: 900}}, {save: left.cairn}, {repeat: {times: 2, do: "
      "[{patrol: {rounds: 1}}, {return_home: }]}}]"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_cairn(arguments);
}

// As the robot has left it when all was explored, once for all tests.
const std::filesystem::path& map_left() {
  static const std::filesystem::path map = [] {
    const auto folder = fresh_folder("carried_map");
    (void)run_office(folder, {});
    return folder / "left.cairn";
  }();
  return map;
}

std::string events_of(const std::filesystem::path& folder) {
  return nlohmann::json::parse(text_of_file(folder / "report.json"))["events"].dump();
}

TEST(Carried, ARobotThatGoesOnWhereItWasLeftIsBelieved) {
  const auto folder = fresh_folder("carried_not");
  const Finished finished = run_office(folder, {"--resume", map_left().string()});
  ASSERT_EQ(finished.exit_status, 0) << finished.err;
  const auto summary = nlohmann::json::parse(finished.out);
  EXPECT_EQ(summary["start_check"]["trust"], "stayed");
  EXPECT_FALSE(summary.contains("localisation"));
  EXPECT_LT(summary["pose_error"]["worst_m"].get<double>(), 0.2);
  EXPECT_THAT(events_of(folder), testing::Not(testing::HasSubstr("carried")));
}

TEST(Carried, ARobotThatWasCarriedNoticesItAndFindsItself) {
  const auto folder = fresh_folder("carried_away");
  SavedMap moved = load_map(map_left());
  const std::size_t landmarks = moved.graph.landmarks().size();
  moved.progress->true_T_map_robot = Pose2{4.6, 1.2, 2.2};
  save_map(folder / "moved.cairn", moved);
  const Finished finished = run_office(folder, {"--resume", (folder / "moved.cairn").string()});
  ASSERT_EQ(finished.exit_status, 0) << finished.err;
  const auto summary = nlohmann::json::parse(finished.out);
  EXPECT_EQ(summary["start_check"]["trust"], "carried");
  EXPECT_LT(summary["start_check"]["looks"].back()["driven_m"].get<double>(), 5.0);
  EXPECT_EQ(summary["localisation"]["trust"], "tracking");
  EXPECT_LT(summary["pose_error"]["last_m"].get<double>(), 0.2);
  EXPECT_THAT(events_of(folder), testing::HasSubstr("it was carried while it was off"));
  EXPECT_THAT(events_of(folder), testing::HasSubstr("found itself"));
  const SavedMap after = load_map(folder / "office.cairn");
  EXPECT_EQ(after.graph.landmarks().size(), landmarks) << "nothing is drawn or recognised in the wrong place";
}

// What it has drawn in the wrong place until then is in no file.
TEST(Carried, TheMapIsLeftAloneUntilTheRobotHasFoundItself) {
  const auto folder = fresh_folder("carried_still_lost");
  SavedMap moved = load_map(map_left());
  moved.progress->true_T_map_robot = Pose2{4.6, 1.2, 2.2};
  save_map(folder / "moved.cairn", moved);
  const std::string before = text_of_file(folder / "moved.cairn");
  const double begin_s = moved.progress->time_s;
  const Finished finished = run_office(
      folder, {"--resume", (folder / "moved.cairn").string(), "--set", "at_most_s=" + std::to_string(begin_s + 30.0)});
  const auto summary = nlohmann::json::parse(finished.out);
  ASSERT_EQ(summary["start_check"]["trust"], "carried");
  ASSERT_EQ(summary["localisation"]["trust"], "lost");
  EXPECT_FALSE(std::filesystem::exists(folder / "office.cairn")) << "the map of the mission's end";
  EXPECT_EQ(text_of_file(folder / "moved.cairn"), before);
}

}  // namespace
}  // namespace cairn::testing_program
