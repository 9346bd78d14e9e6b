// Printed tags, from outside: a home explored by sonars and a camera; shapes and tags in one graph.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "framework/files/world_file.hpp"
#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

// The shipped mission with a camera of a quarter of the pixels, which takes less time to draw.
std::filesystem::path tagged_home(const std::filesystem::path& out) {
  const std::string config = source_folder() + "/config/";
  write_text(out / "robot.yaml", replaced(text_of_file(config + "robots/pioneer3dx_camera.yaml"),
                                          "width_px: 640, height_px: 480, focal_px: [525, 525], rate_hz: 5",
                                          "width_px: 320, height_px: 240, focal_px: [262.5, 262.5], rate_hz: 2"));
  std::string mission = text_of_file(config + "missions/tagged_home.yaml");
  mission = replaced(mission, "../robots/pioneer3dx_camera.yaml", (out / "robot.yaml").string());
  mission = replaced(mission, "../worlds/", config + "worlds/");
  mission = replaced(mission, "../templates", config + "templates");
  write_text(out / "tagged_home.yaml", mission);
  return out / "tagged_home.yaml";
}

TEST(MarkerMission, TagsAndShapesAreLandmarksOfOneGraphAndTagsArePlaces) {
  const auto out = fresh_folder("markers");
  const Finished run = run_cairn({"run", tagged_home(out).string(), "--out", out.string(), "--json"});
  ASSERT_EQ(run.exit_status, 0) << run.err << run.out;
  EXPECT_EQ(json::parse(run.out)["outcome"], "done") << run.out;

  const SavedMap map = load_map((out / "tagged_home.cairn").string());
  const World world = load_world(source_folder() + "/config/worlds/tagged_home.yaml", map.shapes);
  int found = 0;
  for (const WorldTag& tag : world.tags) {
    const Landmark* const landmark = map.graph.find_marker(tag.marker);
    if (landmark == nullptr) continue;
    ++found;
    EXPECT_LT((landmark->T_map_landmark.position() - tag.T_map_tag.position()).norm(), 0.15) << tag.marker.number;
    EXPECT_LT(degrees(std::abs(wrap_angle(landmark->T_map_landmark.theta_rad - tag.T_map_tag.theta_rad))), 8.0)
        << tag.marker.number;
    ASSERT_TRUE(landmark->access) << tag.marker.number;
    EXPECT_GT((landmark->access->position() - tag.T_map_tag.position()).dot(unit_vector(tag.T_map_tag.theta_rad)), 0.0)
        << "a robot stands in front of it";
    EXPECT_FALSE(map.graph.routes_from(landmark->id).empty()) << tag.marker.number;
  }
  EXPECT_GE(found, 6);
  int markers = 0;
  for (const auto& [id, landmark] : map.graph.landmarks()) markers += landmark.marker ? 1 : 0;
  EXPECT_EQ(markers, found) << "a tag that is not there";
  EXPECT_EQ(map.graph.of_category("square").size(), 1U);
  EXPECT_EQ(map.graph.of_category("circle").size(), 1U);
  EXPECT_EQ(map.graph.of_category("hall end").size(), 2U);
  EXPECT_EQ(map.clusters.cluster_of.size(), map.graph.landmarks().size()) << "tags are in clusters as shapes are";

  const std::string file = (out / "tagged_home.cairn").string();
  const Finished plan = run_cairn({"plan", file, "--from", "tag 3", "--to", "tag 7", "--json"});
  ASSERT_EQ(plan.exit_status, 0) << plan.err;
  EXPECT_EQ(json::parse(plan.out)["outcome"], "solved") << plan.out;
  EXPECT_THAT(run_cairn({"map", "info", file}).out, HasSubstr("tag 7"));
}

// Put down in the hall, where it sees tag 4 at once.
TEST(MarkerMission, AKidnappedRobotKnowsWhereItIsByATag) {
  const auto out = fresh_folder("markers_lost");
  SavedMap map;
  map.grid = OccupancyGrid(0.05);
  map.grid.include({{0, 0}, {140, 120}});
  for (int x = 1; x < 139; ++x)
    for (int y = 43; y < 61; ++y) map.grid.set_log_odds({x, y}, LogOdds{-500});
  Landmark tag;
  tag.marker = MarkerId{MarkerFamily::tag36h11, 4};
  tag.T_map_landmark = {7.0, 2.6, radians(180.0)};
  map.graph.add(tag);
  save_map(out / "hall.cairn", map);
  const Finished run =
      run_cairn({"run", tagged_home(out).string(), "--out", out.string(), "--json", "--set", "start.at_m=[5.2, 2.8]",
                 "--set", "start.angle_deg=-6", "--set", "steps=[{find_myself: }]", "--set",
                 "robot=" + source_folder() + "/config/robots/pioneer3dx_camera.yaml", "--localize-in",
                 (out / "hall.cairn").string()});
  ASSERT_EQ(run.exit_status, 0) << run.err << run.out;
  const json summary = json::parse(run.out);
  EXPECT_EQ(summary["localisation"]["trust"], "tracking") << run.out;
  EXPECT_LT(summary["localisation"]["driven_m"].get<double>(), 1.0) << "shapes of walls take metres";
  EXPECT_LT(summary["pose_error"]["worst_m"].get<double>(), 0.2);
}

// Without the tag the error along the corridor stays: its walls say nothing of it.
TEST(MarkerMission, ATagClosesALoopThatTheWallsOfACorridorLeaveOpen) {
  const auto out = fresh_folder("markers_ring");
  const std::string mission = source_folder() + "/config/missions/ring_corridor.yaml";
  const std::string world = text_of_file(source_folder() + "/config/worlds/ring_corridor.yaml");
  write_text(out / "bare.yaml", world.substr(0, world.find("tags:")));
  const auto error_m = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> words{"run", mission, "--out", (out / name).string(), "--json", "--seed", "1"};
    words.insert(words.end(), more.begin(), more.end());
    const Finished run = run_cairn(words);
    EXPECT_EQ(run.exit_status, 0) << run.err << run.out;
    return json::parse(run.out)["pose_error"]["last_m"].get<double>();
  };
  const double bare_m = error_m("bare", {"--set", "world=" + (out / "bare.yaml").string()});
  const double tagged_m = error_m("tagged", {});
  EXPECT_GT(bare_m, 0.35) << "the corridor's walls close it by themselves: it shows nothing";
  EXPECT_LT(tagged_m, 0.25);
}

TEST(MarkerMission, ARobotWithoutCamerasSeesNoTags) {
  const auto out = fresh_folder("markers_blind");
  const Finished run = run_cairn({"run", tagged_home(out).string(), "--out", out.string(), "--set",
                                  "robot=" + source_folder() + "/config/robots/pioneer3dx.yaml"});
  EXPECT_EQ(run.exit_status, 2);
  EXPECT_THAT(run.err, HasSubstr("markers: the robot file has no `cameras` to see them by"));
}

TEST(MarkerMission, ACategoryThatIsNoListIsRefusedWithItsPlace) {
  const auto out = fresh_folder("markers_categories");
  const std::filesystem::path mission = tagged_home(out);
  write_text(mission, replaced(text_of_file(mission), "hall end: [3, 4]", "hall end: [3, 7]"));
  const Finished run = run_cairn({"mission", "check", mission.string()});
  EXPECT_NE(run.exit_status, 0);
  EXPECT_THAT(run.out + run.err, HasSubstr("categories.dock: the id 7 is of category hall end already"));
}

TEST(MarkerMission, TagsThatCannotBeAreFoundByTheCheckWithTheirPlaces) {
  const auto out = fresh_folder("markers_check");
  const std::filesystem::path mission = tagged_home(out);
  const std::string good = text_of_file(mission);
  const auto found_with = [&](const std::string& from, const std::string& to) {
    write_text(mission, replaced(good, from, to));
    const Finished check = run_cairn({"mission", "check", mission.string()});
    EXPECT_NE(check.exit_status, 0) << to;
    return check.out + check.err;
  };
  const std::string families = found_with("size_m: 0.16", "families: [36h12]");
  EXPECT_THAT(families, HasSubstr("tagged_home.yaml:15:45: families must be one of 36h11, 25h9, standard41h12"));
  EXPECT_THAT(families, Not(HasSubstr("no template"))) << "nearest hall end";
  EXPECT_THAT(found_with("size_m: 0.16", "sizes: [{first: 500, last: 600, size_m: 0.1}]"),
              HasSubstr("tagged_home.yaml:15:13: sizes: 500 to 600: there are no such tags: 36h11 has 0 to 586"));
  EXPECT_THAT(
      found_with("dock: [7]", "dock: [587]"),
      HasSubstr("tagged_home.yaml:16:41: categories.dock: there is no tag with the id 587: 36h11 has 0 to 586"));
  EXPECT_THAT(found_with("goto: tag 7", "goto: tag 9999"), HasSubstr("landmark: \"tag 9999\": there is no such tag"));
}

}  // namespace
}  // namespace cairn::testing_program
