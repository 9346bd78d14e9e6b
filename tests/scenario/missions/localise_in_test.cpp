// A robot that is put down anywhere in a mapped office finds itself, and leaves the map alone.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

const std::string kMission = source_folder() + "/config/missions/office.yaml";

// The office as the demo maps it, once for all tests.
const std::filesystem::path& office_map() {
  static const std::filesystem::path map = [] {
    const auto folder = fresh_folder("localise_in_map");
    (void)run_cairn({"run", kMission, "--out", folder.string()});
    return folder / "office.cairn";
  }();
  return map;
}

// The office's mission without its exploring.
Finished visit(const std::filesystem::path& folder, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"run",
                                     kMission,
                                     "--out",
                                     folder.string(),
                                     "--json",
                                     "--set",
                                     "steps=[{goto: {landmark: nearest square}}, {save: visit.cairn}]",
                                     "--localize-in",
                                     office_map().string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_cairn(arguments);
}

TEST(LocaliseIn, AKidnappedRobotFindsItselfAndTheMapIsLeftAlone) {
  const std::string before = text_of_file(office_map());
  const auto folder = fresh_folder("localise_in_lost");
  const Finished finished = visit(folder, {"--set", "start.at_m=[3, 2.5]", "--set", "start.angle_deg=130"});
  ASSERT_EQ(finished.exit_status, 0) << finished.err;
  const auto summary = nlohmann::json::parse(finished.out);
  EXPECT_EQ(summary["localisation"]["trust"], "tracking");
  EXPECT_LT(summary["localisation"]["driven_m"].get<double>(), 15.0);
  EXPECT_LT(summary["pose_error"]["worst_m"].get<double>(), 0.2) << "from the moment on at which it was believed";
  EXPECT_EQ(summary["collisions"], 0);
  EXPECT_EQ(summary["map"], "") << "nothing is saved";
  EXPECT_EQ(text_of_file(office_map()), before);
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    EXPECT_NE(entry.path().extension(), ".cairn") << entry.path();
  const auto report = nlohmann::json::parse(text_of_file(folder / "report.json"));
  EXPECT_EQ(report["steps"][0]["step"], "find_myself");
  EXPECT_EQ(report["steps"][1]["step"], "goto");
}

TEST(LocaliseIn, TheSameSeedFindsTheSame) {
  const auto report_of = [](const std::string& name) {
    const auto folder = fresh_folder(name);
    (void)visit(folder, {"--set", "start.at_m=[3, 2.5]"});
    return text_of_file(folder / "report.json");
  };
  EXPECT_EQ(report_of("localise_in_once"), report_of("localise_in_again"));
}

TEST(LocaliseIn, AGivenPoseIsBelievedAtOnce) {
  const Finished finished =
      visit(fresh_folder("localise_in_given"), {"--set", "start.at_m=[3, 2.5]", "--pose", "3,2.5,0"});
  ASSERT_EQ(finished.exit_status, 0) << finished.err;
  const auto summary = nlohmann::json::parse(finished.out);
  EXPECT_EQ(summary["localisation"], (nlohmann::json{{"trust", "tracking"}, {"pose_given", true}}));
  EXPECT_LT(summary["pose_error"]["worst_m"].get<double>(), 0.2);
}

TEST(LocaliseIn, WhatNeedsAPoseWaitsWhileTheRobotIsLost) {
  const Finished finished =
      run_cairn({"run", kMission, "--out", fresh_folder("localise_in_waits").string(), "--json", "--localize-in",
                 office_map().string(), "--set",
                 "steps=[{parallel: {succeed_when: any, do: [{goto: {at_m: [5, 1]}}, {wait: 3}]}}, "
                 "{find_myself: {at_most_m: 0.5}}]"});
  EXPECT_EQ(finished.exit_status, 1);
  const auto summary = nlohmann::json::parse(finished.out);
  EXPECT_THAT(summary["reason"].get<std::string>(), testing::HasSubstr("find_myself"));
  EXPECT_EQ(summary["localisation"]["trust"], "lost");
  EXPECT_LT(summary["distance_m"].get<double>(), 1.0) << "goto has not driven";
}

TEST(LocaliseIn, APoseThatIsNoneIsRefused) {
  for (const std::string pose : {"1,2", "1,2,3,4", "1,two,3", "1,2,nan", "1,2,3,"}) {
    const Finished finished = visit(fresh_folder("localise_in_refused"), {"--pose", pose});
    EXPECT_EQ(finished.exit_status, 2) << pose;
    EXPECT_THAT(finished.err, testing::HasSubstr("is not X,Y,DEGREES")) << pose;
  }
}

}  // namespace
}  // namespace cairn::testing_program
