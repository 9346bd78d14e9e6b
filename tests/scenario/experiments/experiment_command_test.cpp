// Experiments as the program runs them, and the files that ship.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "framework/experiments/experiment.hpp"
#include "framework/mission/mission.hpp"
#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using testing::HasSubstr;

TEST(ShippedFiles, EveryExperimentLoadsWithAllItsMissionsAndVariants) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_folder() + "/config/experiments")) {
    const ExperimentConfig config = load_experiment(entry.path());
    for (const std::filesystem::path& mission : config.missions)
      for (const ExperimentVariant& variant : config.variants)
        EXPECT_NO_THROW((void)load_mission(mission, variant.overrides)) << mission << " as " << variant.name;
    ++files;
  }
  EXPECT_GE(files, 2);
}

TEST(ShippedFiles, EveryMissionLoads) {
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source_folder() + "/config/missions")) {
    if (entry.is_directory()) continue;
    EXPECT_NO_THROW((void)load_mission(entry.path())) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 26);
}

// A short drive along a wall in a corner of the hallway.
std::filesystem::path small_experiment(const std::filesystem::path& folder, const std::string& baseline) {
  const std::string config = source_folder() + "/config";
  write_text(folder / "drive.yaml", "mission: drive\nrobot: " + config +
                                        "/robots/pioneer1_true_pose.yaml\nworld: " + config +
                                        "/worlds/mapping_smooth_hallway.yaml\nstart: {at_m: [1.727, 1.774]}\n"
                                        "sensor: {plugin: simulated_robot}\nlocalizer: {plugin: odometry_compass}\n"
                                        "map: {plugin: bayes}\nsteps:\n  - drive: [[3.2, 1.9]]\n");
  write_text(
      folder / "maps.yaml",
      "experiment: maps\nmissions: [drive.yaml]\nseeds: {from: 5, count: 2}\nhold_out_every: 5\nbaseline: " + baseline +
          "\nvariants:\n  - {name: textbook, set: [map.clamp_nat=100]}\n  - {name: clamped, set: "
          "[map.clamp_nat=3]}\n");
  return folder / "maps.yaml";
}

TEST(Experiment, OfMapsJudgesEveryVariantOnEverySeed) {
  const auto folder = fresh_folder("experiment");
  const std::vector<std::string> command{"experiment", small_experiment(folder, "textbook").string(), "--out",
                                         (folder / "out").string(), "--json"};
  const Finished finished = run_cairn(command);
  ASSERT_EQ(finished.exit_status, 0) << finished.err;
  const auto rows = nlohmann::json::parse(finished.out)["rows"];
  ASSERT_EQ(rows.size(), 4U);
  for (const auto& row : rows) {
    EXPECT_EQ(row["outcome"], "done") << row;
    EXPECT_GT(row["log loss"], 0.0);
    EXPECT_LT(row["log loss"], 3.0);
    EXPECT_GT(row["held_out"], 10);
    EXPECT_LT(row["held-out log-likelihood"], 0.0);
  }
  EXPECT_EQ(rows[0]["variant"], "textbook");
  EXPECT_NE(rows[0]["log loss"], rows[1]["log loss"]) << "another seed is another drive";
  EXPECT_NE(rows[0]["log loss"], rows[2]["log loss"]) << "another variant is another map";
  EXPECT_TRUE(std::filesystem::exists(folder / "out/drive/clamped/seed_6/drive.cairn"));
  EXPECT_THAT(text_of_file(folder / "out/table.md"), HasSubstr("| clamped |"));
  EXPECT_EQ(run_cairn(command).out, finished.out) << "the same again";
}

// Half an orbit round the square of the lone-square world, with two places.
std::filesystem::path two_places(const std::filesystem::path& folder, const std::string& second_looks_at) {
  const std::string config = source_folder() + "/config";
  write_text(folder / "round.yaml", "mission: round\nrobot: " + config + "/robots/pioneer1.yaml\nworld: " + config +
                                        "/worlds/lone_square.yaml\nstart: {at_m: [1.1, 1.2], angle_deg: 90}\n"
                                        "sensor: {plugin: simulated_robot}\nlocalizer: {plugin: odometry_compass}\n"
                                        "map: {plugin: muriel}\ndetector: {plugin: template_matcher, templates: " +
                                        config +
                                        "/templates}\nsteps:\n  - drive: [[1.1, 2.0]]\n"
                                        "  - drive: [[1.1, 2.9], [2.9, 2.9]]\n");
  write_text(folder / "places.yaml",
             "experiment: places\nmissions: [round.yaml]\nseeds: {from: 5, count: 2}\ncategories: [circle, square]\n"
             "expected_matchings: 10\nplaces:\n  - {name: P1, looks_at: square, expected: [0.2, 0.3]}\n"
             "  - {name: P2, looks_at: " +
                 second_looks_at + "}\n");
  return folder / "places.yaml";
}

TEST(Experiment, OfPlacesReportsTheDegreesThere) {
  const auto folder = fresh_folder("experiment_places");
  const std::vector<std::string> command{"experiment", two_places(folder, "square").string(), "--out",
                                         (folder / "out").string(), "--json"};
  const Finished finished = run_cairn(command);
  ASSERT_EQ(finished.exit_status, 0) << finished.err;
  const auto rows = nlohmann::json::parse(finished.out)["rows"];
  ASSERT_EQ(rows.size(), 2U);
  for (const auto& row : rows) {
    ASSERT_EQ(row["places"].size(), 2U);
    EXPECT_GT(row["places"][1]["square"], row["places"][0]["square"]) << "confidence grows";
    EXPECT_GT(row["places"][1]["square"], row["places"][1]["circle"]);
  }
  EXPECT_THAT(text_of_file(folder / "out/table.md"), HasSubstr("| P2 | square | 0."));
  EXPECT_EQ(run_cairn(command).out, finished.out) << "the same again";
}

TEST(Experiment, OfAnOrbitDrawsCategoriesAndTemplates) {
  const auto folder = fresh_folder("experiment_orbit");
  (void)two_places(folder, "square");
  write_text(folder / "orbit.yaml",
             "experiment: orbit\nmissions: [round.yaml]\nseeds: {from: 5, count: 1}\ncategories: [circle, square]\n"
             "orbit: {around: square, bin_deg: 45}\nset: [detector.degrees=each_template]\n");
  const Finished finished =
      run_cairn({"experiment", (folder / "orbit.yaml").string(), "--out", (folder / "out").string(), "--json"});
  ASSERT_EQ(finished.exit_status, 0) << finished.err;
  const auto orbit = nlohmann::json::parse(finished.out)["rows"][0]["orbit"];
  ASSERT_GT(orbit.size(), 3U);
  for (const auto& sample : orbit) {
    double best = 0.0;
    for (const auto& [key, degree] : sample.items())
      if (key.starts_with("square ")) best = std::max(best, degree.get<double>());
    EXPECT_DOUBLE_EQ(best, sample["square"]) << "the best template makes the category's degree: " << sample;
    EXPECT_TRUE(sample.contains("square 75 deg")) << "however bad it is";
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "out/orbit_categories.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "out/orbit_templates.png"));
}

// Evidence, landmarks and drive: nothing depends on how much a matching reports.
TEST(Matching, EveryWayToAskAndToSearchSavesTheSameMap) {
  const auto folder = fresh_folder("ways_to_ask");
  std::string first;
  for (const std::string way :
       {"degrees=above_threshold", "degrees=all", "degrees=each_template", "search=exhaustive"}) {
    const Finished run =
        run_cairn({"run", source_folder() + "/config/missions/office.yaml", "--seed", "5", "--set",
                   "steps.0.explore.at_most_s=150", "--set", "detector." + way, "--out", folder.string()});
    ASSERT_TRUE(std::filesystem::exists(folder / "office.cairn")) << run.err;
    const std::string map = text_of_file(folder / "office.cairn");
    if (first.empty()) first = map;
    EXPECT_TRUE(map == first) << way;
    EXPECT_FALSE(load_map(folder / "office.cairn").graph.landmarks().empty());
  }
}

TEST(Experiment, OfRecognitionLeavesAWorldThatRunsAgain) {
  const auto folder = fresh_folder("experiment_recognition");
  (void)two_places(folder, "square");
  write_text(
      folder / "recognition.yaml",
      "experiment: recognition\nmissions: [round.yaml]\nseeds: {from: 5, count: 1}\n"
      "worlds: {start_m: [1.1, 1.2], max_landmarks: 2, start_gap_m: 0.5}\nset: [\"steps=[{wait: {for_s: 1}}]\"]\n");
  const Finished finished =
      run_cairn({"experiment", (folder / "recognition.yaml").string(), "--out", (folder / "out").string(), "--json"});
  ASSERT_EQ(finished.exit_status, 0) << finished.err;
  const auto verdicts = nlohmann::json::parse(finished.out)["rows"][0]["verdicts"];
  ASSERT_GE(verdicts.size(), 1U);
  EXPECT_EQ(verdicts[0]["found"], "") << "a robot that stands still has found nothing";
  EXPECT_THAT(text_of_file(folder / "out/table.md"), HasSubstr("| variant | precision | recall | F1 |"));
  const Finished again =
      run_cairn({"run", (folder / "round.yaml").string(), "--set", "steps=[{wait: 1}]", "--seed", "5", "--set",
                 "world=" + (folder / "out/seed_5/world.yaml").string(), "--out", (folder / "again").string()});
  EXPECT_EQ(again.exit_status, 0) << again.err;
}

// The recognition mission in one small random world, judged by two detectors beside its own.
std::filesystem::path small_curves(const std::filesystem::path& folder, const std::string& detectors) {
  (void)two_places(folder, "square");
  write_text(folder / "curves.yaml",
             "experiment: curves\nmissions: [round.yaml]\nseeds: {from: 5, count: 1}\ntolerance_m: 0.3\n"
             "worlds: {start_m: [1.1, 1.2], min_landmarks: 1, max_landmarks: 1, max_distractors: 0, "
             "smallest_room_m: [3.5, 3.5], largest_room_m: [3.5, 3.5], gap_m: 0.8}\n"
             "set: [\"steps=[{explore: {until_known_ratio: 0.95, at_most_s: 300}}]\"]\n"
             "detectors:\n" +
                 detectors);
  return folder / "curves.yaml";
}

TEST(Experiment, OfCurvesRunsEveryDetectorOnTheSameGrid) {
  const auto folder = fresh_folder("experiment_curves");
  const std::vector<std::string> command{
      "experiment",
      small_curves(folder,
                   "  - {name: ours, plugin: template_matcher, min_margin: 0, min_above_unseen: 0}\n"
                   "  - {name: theirs, plugin: match_template}\n  - {name: picky, plugin: match_template, "
                   "tau_match: 0.999}\n")
          .string(),
      "--out", (folder / "out").string(), "--json"};
  const Finished finished = run_cairn(command);
  ASSERT_EQ(finished.exit_status, 0) << finished.err;
  const auto row = nlohmann::json::parse(finished.out)["rows"][0];
  EXPECT_GE(row["verdicts"].size(), 1U);
  ASSERT_EQ(row["detectors"].size(), 3U);
  for (const auto& detector : row["detectors"]) EXPECT_EQ(detector["truly"], 1) << detector;
  const auto& ours = row["detectors"][0]["counts"];
  ASSERT_GE(ours.size(), 1U);
  EXPECT_EQ(ours[0][1], 1) << "the best detection alone";
  EXPECT_EQ(ours[0][2], 1) << "and it is right, in a room with one landmark seen from all around";
  EXPECT_EQ(row["detectors"][1]["counts"][0][2], 1);
  EXPECT_GT(row["detectors"][1]["counts"].size(), 10U) << "its threshold is 0 unless given";
  EXPECT_TRUE(row["detectors"][2]["counts"].empty()) << "here it is given";
  EXPECT_THAT(text_of_file(folder / "out/table.md"), HasSubstr("| the mission itself | |"));
  EXPECT_THAT(finished.err, HasSubstr("| detector | ms a grid |")) << "times are for people only";
  EXPECT_TRUE(std::filesystem::exists(folder / "out/curves.png"));
  EXPECT_EQ(run_cairn(command).out, finished.out) << "the same again";
}

TEST(Experiment, OfCurvesReportsWhatIsWrongWithADetector) {
  const auto folder = fresh_folder("experiment_curves_fault");
  const auto error_of = [&](const std::string& detectors) {
    const Finished finished =
        run_cairn({"experiment", small_curves(folder, detectors).string(), "--out", (folder / "out").string()});
    EXPECT_EQ(finished.exit_status, 2);
    return finished.err;
  };
  EXPECT_THAT(error_of("  - {name: a, plugin: match_templat}\n"),
              HasSubstr("curves.yaml:8:5: unknown detector plugin \"match_templat\""));
  EXPECT_THAT(error_of("  - {name: a, plugin: chamfer, truncation: 0.1}\n"),
              HasSubstr("curves.yaml:8:32: unknown key \"truncation\" in plugin chamfer (did you mean "
                        "\"truncation_m\"?)"));
  EXPECT_THAT(error_of("  - {plugin: chamfer}\n"), HasSubstr("curves.yaml:8:5: detectors lacks the key \"name\""));
  EXPECT_THAT(error_of("  - {name: a}\n"), HasSubstr("curves.yaml:8:5: detectors lacks the key \"plugin\""));
  EXPECT_THAT(error_of("  - {name: a, plugin: chamfer}\n  - {name: a, plugin: match_template}\n"),
              HasSubstr("curves.yaml:9:12: two detectors are called \"a\""));
  EXPECT_THAT(error_of("  []\n"), HasSubstr("must list the detectors to compare under detectors"));
}

TEST(Experiment, APlaceThatLooksAtNothingInTheWorldIsRefused) {
  const auto folder = fresh_folder("experiment_places_fault");
  const Finished finished =
      run_cairn({"experiment", two_places(folder, "circle").string(), "--out", (folder / "out").string()});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, HasSubstr("round.yaml: the mission's world must have one landmark of the category "
                                      "\"circle\" that place P2 looks at, but has 0"));
  const Finished unknown =
      run_cairn({"experiment", two_places(folder, "sqare").string(), "--out", (folder / "out").string()});
  EXPECT_EQ(unknown.exit_status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("places.yaml:8:26: \"sqare\" is not among the categories (did you mean "
                                     "\"square\"?)"));
}

TEST(Experiment, AnUnknownBaselineNamesTheNearestVariant) {
  const auto folder = fresh_folder("experiment_baseline");
  const Finished finished =
      run_cairn({"experiment", small_experiment(folder, "clampd").string(), "--out", (folder / "out").string()});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, HasSubstr("maps.yaml:5:11: no variant is called \"clampd\" (did you mean \"clamped\"?)"));
}

TEST(Experiment, TwoVariantsOfOneNameAreRefused) {
  const auto folder = fresh_folder("experiment_twice");
  const std::filesystem::path file = small_experiment(folder, "textbook");
  std::string text = text_of_file(file);
  text.replace(text.find("name: clamped"), 13, "name: textbook");
  write_text(file, text);
  const Finished finished = run_cairn({"experiment", file.string(), "--out", (folder / "out").string()});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, HasSubstr("two variants are called \"textbook\""));
}

TEST(Experiment, AFaultInTheLastVariantIsReportedBeforeAnythingRuns) {
  const auto folder = fresh_folder("experiment_fault");
  const std::filesystem::path file = small_experiment(folder, "textbook");
  std::string text = text_of_file(file);
  text.replace(text.find("map.clamp_nat=3"), 15, "map.plugin=bays");
  write_text(file, text);
  const Finished finished = run_cairn({"experiment", file.string(), "--out", (folder / "out").string()});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, HasSubstr("unknown map plugin \"bays\""));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/drive"));
}

}  // namespace
}  // namespace cairn::testing_program
