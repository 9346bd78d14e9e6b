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
  EXPECT_EQ(summary["start_check"]["verdict"], "stayed");
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
  EXPECT_EQ(summary["start_check"]["verdict"], "carried");
  EXPECT_LT(summary["start_check"]["looks"].back()["driven_m"].get<double>(), 5.0);
  EXPECT_EQ(summary["localisation"]["trust"], "tracking");
  EXPECT_LT(summary["pose_error"]["last_m"].get<double>(), 0.2);
  EXPECT_THAT(events_of(folder), testing::HasSubstr("it was carried while it was off"));
  EXPECT_THAT(events_of(folder), testing::HasSubstr("found itself"));
  const SavedMap after = load_map(folder / "office.cairn");
  EXPECT_EQ(after.graph.landmarks().size(), landmarks) << "nothing is drawn or recognised in the wrong place";
}

TEST(Carried, ARobotWhoseNewPlaceIsGivenGoesOnThereUnchecked) {
  const auto folder = fresh_folder("carried_and_told");
  SavedMap moved = load_map(map_left());
  const std::size_t landmarks = moved.graph.landmarks().size();
  moved.progress->true_T_map_robot = Pose2{4.6, 1.2, 2.2};
  save_map(folder / "moved.cairn", moved);
  const Finished finished =
      run_office(folder, {"--resume", (folder / "moved.cairn").string(), "--pose", "4.65,1.2,126"});
  ASSERT_EQ(finished.exit_status, 0) << finished.err;
  const auto summary = nlohmann::json::parse(finished.out);
  EXPECT_FALSE(summary.contains("start_check"));
  EXPECT_FALSE(summary.contains("localisation"));
  EXPECT_LT(summary["pose_error"]["worst_m"].get<double>(), 0.2);
  EXPECT_EQ(load_map(folder / "office.cairn").graph.landmarks().size(), landmarks);
}

TEST(Carried, APoseWithoutAMapIsRefused) {
  const Finished finished = run_office(fresh_folder("pose_without_map"), {"--pose", "1,2,90"});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, testing::HasSubstr("it goes with --localize-in or --resume"));
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
  ASSERT_EQ(summary["start_check"]["verdict"], "carried");
  ASSERT_EQ(summary["localisation"]["trust"], "lost");
  EXPECT_FALSE(std::filesystem::exists(folder / "office.cairn")) << "the map of the mission's end";
  EXPECT_EQ(text_of_file(folder / "moved.cairn"), before);
}

// Whether all is free within 0.2 m of there.
bool is_in_the_open(const OccupancyGrid& map, const Cell& at) {
  for (int y = at.y - 4; y <= at.y + 4; ++y)
    for (int x = at.x - 4; x <= at.x + 4; ++x)
      if (map.state({x, y}) != CellState::free) return false;
  return true;
}

// Cells that are occupied in the open of the other map: walls drawn in a wrong place.
int walls_in_the_open(const OccupancyGrid& map, const OccupancyGrid& before) {
  int cells = 0;
  const CellBox box = map.bounds();
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      cells += map.state({x, y}) == CellState::occupied && is_in_the_open(before, {x, y}) ? 1 : 0;
  return cells;
}

TEST(CarriedUnderWay, TheRobotNoticesItFindsItselfAndItsMapHasNoWallsTwice) {
  const auto folder = fresh_folder("carried_under_way");
  const SavedMap before = load_map(map_left());
  const std::string carried_s = std::to_string(before.progress->time_s + 60.0);
  const Finished finished =
      run_office(folder, {"--resume", map_left().string(), "--set",
                          "sensor.faults=[{at_s: " + carried_s + ", kidnap: {to_m: [4.9, 1.0], angle_deg: 100}}]"});
  ASSERT_EQ(finished.exit_status, 0) << finished.err;
  const auto summary = nlohmann::json::parse(finished.out);
  EXPECT_EQ(summary["start_check"]["verdict"], "stayed");
  ASSERT_EQ(summary["carried"].size(), 1U) << finished.out;
  EXPECT_TRUE(summary["carried"][0].contains("found_s"));
  EXPECT_EQ(summary["doubts"].back()["verdict"], "carried");
  EXPECT_EQ(summary["localisation"]["trust"], "tracking");
  EXPECT_LT(summary["pose_error"]["last_m"].get<double>(), 0.2);
  EXPECT_THAT(events_of(folder), testing::HasSubstr("not where it was believed to be"));
  const SavedMap after = load_map(folder / "office.cairn");
  EXPECT_LT(walls_in_the_open(after.grid, before.grid), 8);
  EXPECT_EQ(after.graph.landmarks().size(), before.graph.landmarks().size());
}

TEST(CarriedUnderWay, IsNotWatchedWhereTheMissionSaysSo) {
  const auto folder = fresh_folder("carried_not_watched");
  const double carried_s = load_map(map_left()).progress->time_s + 60.0;
  const std::string fault =
      "sensor.faults=[{at_s: " + std::to_string(carried_s) + ", kidnap: {to_m: [4.9, 1.0], angle_deg: 100}}]";
  const Finished finished =
      run_office(folder, {"--resume", map_left().string(), "--set", fault, "--set", "check_pose_under_way=false",
                          "--set", "at_most_s=" + std::to_string(carried_s + 60.0)});
  const auto summary = nlohmann::json::parse(finished.out);
  EXPECT_EQ(summary["start_check"]["verdict"], "stayed") << "that is another check";
  EXPECT_FALSE(summary.contains("doubts")) << finished.out;
  EXPECT_FALSE(summary.contains("carried"));
}

// It has been on its way for long: what it knew before is not lost with the place.
TEST(CarriedUnderWay, ARunThatEndsWhileItsRobotIsLostSavesTheMapFromBefore) {
  const auto folder = fresh_folder("carried_under_way_lost");
  const SavedMap before = load_map(map_left());
  const double carried_s = before.progress->time_s + 60.0;
  const std::string fault =
      "sensor.faults=[{at_s: " + std::to_string(carried_s) + ", kidnap: {to_m: [4.9, 1.0], angle_deg: 100}}]";
  const auto noticed = nlohmann::json::parse(run_office(folder, {"--resume", map_left().string(), "--set", fault}).out);
  ASSERT_EQ(noticed["carried"].size(), 1U);
  const double begun_s = noticed["doubts"].back()["begun_s"].get<double>();
  const Finished open = run_office(
      fresh_folder("carried_under_way_open"),
      {"--resume", map_left().string(), "--set", fault, "--set", "at_most_s=" + std::to_string(begun_s + 1.0)});
  const auto doubt = nlohmann::json::parse(open.out)["doubts"].back();
  EXPECT_EQ(doubt["begun_s"], begun_s);
  EXPECT_EQ(doubt["verdict"], "open") << "the run has ended before";
  const double end_s = noticed["carried"][0]["noticed_s"].get<double>() + 3.0;
  const Finished finished = run_office(
      folder, {"--resume", map_left().string(), "--set", fault, "--set", "at_most_s=" + std::to_string(end_s)});
  EXPECT_EQ(nlohmann::json::parse(finished.out)["localisation"]["trust"], "lost");
  const SavedMap after = load_map(folder / "office.cairn");
  EXPECT_LT(walls_in_the_open(after.grid, before.grid), 8);
  EXPECT_EQ(after.graph.landmarks().size(), before.graph.landmarks().size());
}

TEST(CarriedUnderWay, PeopleAndDoorsDoNotMakeARobotBelieveThatItWasCarried) {
  const auto folder = fresh_folder("carried_under_way_not");
  const Finished finished =
      run_cairn({"run", source_folder() + "/config/missions/busy_office.yaml", "--out", folder.string(), "--json",
                 "--set", "at_most_s=700", "--set",
                 "steps=[{force_success: {explore: {until_known_ratio: 0.9, at_most_s: 400}}}, "
                 "{repeat: {times: 9, do: [{force_success: {patrol: {rounds: 1, skip: true}}}]}}]"});
  const auto summary = nlohmann::json::parse(finished.out);
  EXPECT_GT(summary["distance_m"].get<double>(), 25.0);
  EXPECT_FALSE(summary.contains("carried")) << finished.out;
  EXPECT_LT(summary["pose_error"]["worst_m"].get<double>(), 0.3);
}

}  // namespace
}  // namespace cairn::testing_program
