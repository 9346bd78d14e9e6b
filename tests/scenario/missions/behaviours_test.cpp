// Behaviours in the simulator, from outside: what they have come to, by the simulation's own truth.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "framework/files/template_file.hpp"
#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

std::string config(const std::string& path) {
  return source_folder() + "/config/" + path;
}

// In a room of 4 x 4 m with a square of 0.5 m in its middle.
std::filesystem::path mission_in(const std::filesystem::path& folder, const std::string& steps,
                                 const std::string& sensor = "") {
  write_text(folder / "mission.yaml",
             "mission: behaviours\nrobot: " + config("robots/pioneer1.yaml") +
                 "\nworld: " + config("worlds/lone_square.yaml") +
                 "\nstart: {at_m: [1, 2], angle_deg: 90}\nsensor: {plugin: simulated_robot" + sensor +
                 "}\nlocalizer: {plugin: odometry_compass}\nmap: {plugin: muriel, cell_m: 0.05}\n"
                 "detector: {plugin: template_matcher, templates: " +
                 config("templates") +
                 ", coarse_cells: 5}\n"
                 "planner: {plugin: hybrid, route: {plugin: ompl}}\nat_most_s: 1200\nsteps:\n" +
                 steps);
  return folder / "mission.yaml";
}

struct Ran {
  json report;
  SavedMap map;
};

Ran run(const std::filesystem::path& folder, const std::string& steps, const std::string& seed,
        const std::string& sensor = "") {
  const std::filesystem::path mission = mission_in(folder, steps, sensor);
  const Finished finished = run_cairn({"run", mission.string(), "--seed", seed, "--out", folder.string(), "--json"});
  EXPECT_EQ(finished.exit_status, 0) << finished.out << finished.err;
  return {json::parse(text_of_file(folder / "report.json")), load_map(folder / "behaviours.cairn")};
}

// Between the robot's footprint and the square, in truth.
double true_gap_m(const Ran& ran) {
  const Pose2 robot = ran.map.progress->true_T_map_robot.value();
  const LandmarkShape square = load_landmark_shape(config("templates/square.yaml"));
  return square.contour.signed_distance(robot.position() - Point(2.0, 2.0)) - 0.22;
}

std::string reason_of(const json& report, const std::string& name) {
  for (const json& step : report["nodes"])
    if (step["name"] == name) return step["reason"];
  return "no node " + name;
}

TEST(Behaviours, DockStopsAtItsDistanceInTruth) {
  for (const std::string seed : {"1", "2"}) {
    const Ran ran =
        run(fresh_folder("dock_" + seed),
            "  - search: square\n  - dock: {landmark: nearest square, side: left, distance_m: 0.4}\n", seed);
    EXPECT_EQ(ran.report["outcome"], "done") << ran.report["reason"];
    EXPECT_THAT(reason_of(ran.report, "search"), HasSubstr("found square: L"));
    EXPECT_THAT(reason_of(ran.report, "dock"), AllOf(HasSubstr("docked at the left side"), HasSubstr("by its echoes")));
    EXPECT_NEAR(true_gap_m(ran), 0.4, 0.04) << "seed " << seed;
    EXPECT_EQ(ran.report["collisions"], 0);
  }
}

TEST(Behaviours, DockFacesAwayWhenAskedTo) {
  const Ran ran = run(fresh_folder("dock_away"),
                      "  - search: square\n"
                      "  - dock: {landmark: nearest square, side_deg: 0, distance_m: 0.25, facing: away}\n",
                      "3");
  EXPECT_EQ(ran.report["outcome"], "done") << ran.report["reason"];
  EXPECT_NEAR(true_gap_m(ran), 0.25, 0.04);
  const Pose2 robot = ran.map.progress->true_T_map_robot.value();
  const Point outward = robot.position() - Point(2.0, 2.0);
  EXPECT_LT(std::abs(wrap_angle(robot.theta_rad - std::atan2(outward.y(), outward.x()))), radians(15.0));
}

TEST(Behaviours, InspectRaisesTheDegreeAndWhatItMappedMakesATemplate) {
  const auto folder = fresh_folder("inspect");
  const std::string steps =
      "  - search: square\n  - inspect: {landmark: nearest square, rounds_at_most: 2}\n"
      "  - capture_template: {at: nearest square, name: crate}\n"
      "  - plan_query: {to: \"3.5,3.5\", alternatives: 1, explain: true}\n  - plan_query: \"1,2\"\n"
      "  - log: \"{landmarks} landmark, {nearest}\"\n";
  const Ran ran = run(folder, steps, "5");
  EXPECT_EQ(ran.report["outcome"], "done") << ran.report["reason"];
  EXPECT_THAT(reason_of(ran.report, "inspect"), AllOf(HasSubstr("(square): degree 0."), HasSubstr(" -> 0.")));
  EXPECT_EQ(reason_of(ran.report, "log"), "1 landmark, L1 (square)");
  const LandmarkShape crate = load_landmark_shape(folder / "crate.yaml");
  EXPECT_NEAR(crate.contour.outer_diameter_m(), 0.5 * std::sqrt(2.0), 0.15);

  const std::string answers = text_of_file(folder / "answers.jsonl");
  ASSERT_EQ(std::ranges::count(answers, '\n'), 2);
  const json first = json::parse(answers.substr(0, answers.find('\n')));
  EXPECT_EQ(first["outcome"], "solved");
  EXPECT_TRUE(first.contains("alternatives") && first.contains("segments")) << first.dump();
  EXPECT_FALSE(first.contains("time_ms")) << "times differ from run to run";

  // The same once more, into the same folder: the same bytes, and nothing is left of the first run.
  const Ran again = run(folder, steps, "5");
  EXPECT_EQ(again.report, ran.report);
  EXPECT_EQ(text_of_file(folder / "answers.jsonl"), answers);
}

TEST(Behaviours, AMissionThatGoesOnReturnsToWhereItFirstBegan) {
  const auto folder = fresh_folder("home");
  const std::string steps = "  - drive: [[1, 3], [1.6, 3.2]]\n  - save: half.cairn\n  - return_home:\n";
  const Ran ran = run(folder, steps, "1");
  EXPECT_EQ(reason_of(ran.report, "return_home"), "home at (1.00, 2.00)");
  const auto second = fresh_folder("home_again");
  const Finished finished = run_cairn({"run", (folder / "mission.yaml").string(), "--resume",
                                       (folder / "half.cairn").string(), "--out", second.string(), "--seed", "1"});
  EXPECT_EQ(finished.exit_status, 0) << finished.out << finished.err;
  const json report = json::parse(text_of_file(second / "report.json"));
  EXPECT_EQ(reason_of(report, "return_home"), "home at (1.00, 2.00)");
  const SavedMap map = load_map(second / "behaviours.cairn");
  EXPECT_LT((map.progress->true_T_map_robot->position() - Point(1.0, 2.0)).norm(), 0.25);
}

TEST(Behaviours, APlaceThatOneStepFindsIsWhereALaterOneGoesAlsoAfterAResume) {
  const auto folder = fresh_folder("found");
  const std::string mission = config("missions/find_and_visit.yaml");
  const Finished finished = run_cairn({"run", mission, "--out", folder.string()});
  ASSERT_EQ(finished.exit_status, 0) << finished.out << finished.err;
  const json report = json::parse(text_of_file(folder / "report.json"));
  EXPECT_EQ(reason_of(report, "search"), "found square: L1");
  EXPECT_EQ(reason_of(report, "goto"), "at L1 (square)");

  const std::string steps =
      "  - search: {category: square, output: found}\n  - save: half.cairn\n  - goto: {input: found}\n";
  const auto first = fresh_folder("found_first");
  (void)run(first, steps, "1");
  const auto second = fresh_folder("found_again");
  const Finished again = run_cairn({"run", (first / "mission.yaml").string(), "--resume",
                                    (first / "half.cairn").string(), "--out", second.string(), "--seed", "1"});
  EXPECT_EQ(again.exit_status, 0) << again.out << again.err;
  EXPECT_EQ(reason_of(json::parse(text_of_file(second / "report.json")), "goto"), "at L1 (square)");
}

TEST(Behaviours, AnInputThatNoStepBeforeGivesIsAnErrorWithItsPlace) {
  const auto folder = fresh_folder("no_such_input");
  const std::string file =
      mission_in(folder, "  - search: {category: square, output: found}\n  - goto: {input: fond}\n").string();
  for (const char* command : {"check", "run"}) {
    const Finished finished = command == std::string("check") ? run_cairn({"mission", "check", file})
                                                              : run_cairn({"run", file, "--out", folder.string()});
    EXPECT_EQ(finished.exit_status, 2);
    EXPECT_THAT(finished.err + finished.out,
                HasSubstr(":13:19: input: no step before gives \"fond\" (did you mean \"found\"?); given are: found"));
  }
}

TEST(Behaviours, AnUnknownControllerIsReportedWithTheNearestName) {
  const auto folder = fresh_folder("no_such_controller");
  const std::string file = mission_in(folder, "  - wait: 1\n").string();
  const Finished finished = run_cairn({"mission", "check", file, "--set", "controller.plugin=plain_persuit"});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err + finished.out, HasSubstr("(did you mean \"plain_pursuit\"?)"));
}

TEST(Behaviours, ABatteryThatIsLowSendsTheRobotHome) {
  const Ran ran =
      run(fresh_folder("battery"),
          "  - fallback:\n      - reactive_sequence: [battery_above: 0.3, {tour: {places: [[1, 3], [3, 3]]}}]\n"
          "      - log: \"low: {battery}\"\n  - return_home:\n",
          "1", ", battery: {standing_s: 200, driving_s: 60, start_ratio: 0.4}");
  EXPECT_EQ(ran.report["outcome"], "done") << ran.report["reason"];
  EXPECT_THAT(reason_of(ran.report, "battery_above"), HasSubstr("of the battery is left"));
  EXPECT_EQ(reason_of(ran.report, "log"), "low: 30 %");
  EXPECT_EQ(reason_of(ran.report, "return_home"), "home at (1.00, 2.00)");
}

TEST(Behaviours, WrongSettingsAreReportedWithTheirPlaceAndTheNearestName) {
  const auto folder = fresh_folder("wrong_behaviours");
  const std::string file = mission_in(folder,
                                      "  - search: sqare\n  - inspect: {landmark: L1, gain: much}\n"
                                      "  - tour: {places: [L1], ordr: given}\n  - patrol: {rounds: never}\n"
                                      "  - return_home: {too: L1}\n  - dock: {landmark: L1, side: letf}\n"
                                      "  - capture_template: {at: L1, name: crate, file: ../x.yaml}\n"
                                      "  - plan_query: {to: L1, cost: lenght}\n  - log: \"{batery}\"\n"
                                      "  - battery_above: half\n  - ptrol: 3\n")
                               .string();
  const Finished finished = run_cairn({"mission", "check", file});
  EXPECT_EQ(finished.exit_status, 2);
  for (const char* reported :
       {":12:13: search: the mission has no template of category \"sqare\" (did you mean \"square\"?)",
        ":13:35: gain must be a number", ":14:26: unknown key \"ordr\" in plugin tour (did you mean \"order\"?)",
        ":15:22: rounds must be forever or a number",
        ":16:19: unknown key \"too\" in plugin return_home (did you mean \"to\"?)",
        ":17:32: side must be one of front, left, back, right, found \"letf\" (did you mean \"left\"?)",
        ":18:51: file must be a plain file name", ":19:32: cost must be one of", "(did you mean \"length\"?)",
        ":20:10: text: there is no {batery} (did you mean \"battery\"?)",
        ":21:20: battery_above: ratio must be a number",
        ":22:5: unknown behaviour plugin \"ptrol\" (did you mean \"patrol\"?)"})
    EXPECT_THAT(finished.err + finished.out, HasSubstr(reported));
}

// Somebody who has walked on leaves a ghost in the map; the path round it once ended where the robot stood, for ever:
// it had driven 12 m by then.
TEST(Behaviours, ExploreGetsOnWhereItHasArrivedAlready) {
  const auto folder = fresh_folder("behaviours_arrived");
  write_text(folder / "world.yaml", R"(
bounds_m: [[0, 0], [6.398, 5.510]]
walls:
  - {points_m: [[0.000, 0.000], [6.398, 0.000]], surface: rough}
  - {points_m: [[6.398, 0.000], [6.398, 5.510]], surface: rough}
  - {points_m: [[6.398, 5.510], [0.000, 5.510]], surface: rough}
  - {points_m: [[0.000, 5.510], [0.000, 0.000]], surface: rough}
objects:
  - {template: square, scale: 1.095, at_m: [3.940, 2.131], angle_deg: 310.3, surface: rough}
  - {polygon_m: [[0, 0], [0.997, 0], [0.997, 0.253], [0.253, 0.253], [0.253, 0.997], [0, 0.997]], at_m: [1.957, 3.438], angle_deg: 180.8, surface: rough}
  - {circle_diameter_m: 0.198, at_m: [4.746, 3.861], angle_deg: 165.5, surface: rough}
movers:
  - {name: person 1, circle_diameter_m: 0.4, path_m: [[3.088, 2.709], [2.973, 0.756]], speed_mps: 0.353, pause_s: 9.1}
  - {name: person 2, circle_diameter_m: 0.4, path_m: [[0.308, 5.091], [0.350, 2.563]], speed_mps: 0.333, pause_s: 6.2}
)");
  write_text(folder / "mission.yaml", "mission: on\nseed: 1007\nrobot: " + config("robots/pioneer3dx.yaml") + R"(
world: world.yaml
start: {at_m: [1.100, 1.772], angle_deg: 299.0}
sensor: {plugin: simulated_robot, faults: [{at_s: 53.36, for_s: 8, silent: true}]}
localizer: {plugin: odometry_compass}
map: {plugin: muriel, cell_m: 0.05, false_echo_per_m: 2}
detector: {plugin: template_matcher, sizes: [1, 1.07], coarse_cells: 5, degrees: above_threshold, templates: )" +
                                          config("templates") + R"(}
planner: {plugin: hybrid, route: {plugin: ompl}}
at_most_s: 240
steps: [explore: {until_known_ratio: 0.97, at_most_s: 400}]
)");
  const Finished run = run_cairn({"run", (folder / "mission.yaml").string(), "--out", folder.string(), "--json"});
  EXPECT_GT(json::parse(run.out)["distance_m"], 16.0) << run.err;
}

}  // namespace
}  // namespace cairn::testing_program
