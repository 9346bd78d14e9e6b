// A run recorded as MCAP, played back by mcap_log.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

std::string replay_of(const std::string& sensor) {
  return "mission: replay\nrobot: " + source_folder() +
         "/config/robots/pioneer1.yaml\nstart: {at_m: [0.6, 0.6], angle_deg: 0}\nsensor: " + sensor +
         "\nlocalizer: {plugin: odometry_compass}\nmap: {plugin: muriel, cell_m: 0.05}\n";
}

TEST(McapLogReplay, ARunRecordedAsMcapGivesTheSameMap) {
  const auto out = fresh_folder("mcap_log");
  const Finished first =
      run_cairn({"run", source_folder() + "/config/missions/office.yaml", "--set", "record_mcap=run.mcap", "--set",
                 "steps.0.explore.at_most_s=20", "--out", out.string(), "--json"});
  ASSERT_TRUE(std::filesystem::exists(out / "run.mcap")) << first.err;
  write_text(out / "replay.yaml", replay_of("{plugin: mcap_log, file: ./run.mcap, compass: /ros/compass}"));
  const Finished second = run_cairn({"run", (out / "replay.yaml").string(), "--out", out.string(), "--json"});
  ASSERT_EQ(second.exit_status, 0) << second.err << second.out;
  EXPECT_EQ(nlohmann::json::parse(first.out)["readings"], nlohmann::json::parse(second.out)["readings"]);
  const SavedMap recorded = load_map((out / "office.cairn").string());
  const SavedMap replayed = load_map((out / "replay.cairn").string());
  EXPECT_GT(recorded.grid.bounds().width(), 20);
  EXPECT_TRUE(recorded.grid == replayed.grid) << "OG1 differs";
}

TEST(McapLogReplay, AFileCutOffByAKillStillBecomesAMap) {
  const auto out = fresh_folder("mcap_log_cut");
  const std::string bag = text_of_file(source_folder() + "/tests/data/bag.mcap");
  write_text(out / "bag.mcap", bag.substr(0, bag.size() / 2));
  write_text(out / "replay.yaml", replay_of("{plugin: mcap_log, file: ./bag.mcap, ranges: [/scan]}"));
  const Finished run = run_cairn({"run", (out / "replay.yaml").string(), "--out", out.string(), "--json"});
  ASSERT_EQ(run.exit_status, 0) << run.err;
  EXPECT_THAT(nlohmann::json::parse(run.out)["reason"].get<std::string>(),
              testing::HasSubstr("the file ends early: it was read up to its last whole chunk"));
}

TEST(McapLogReplay, TopicsThatMustBeChosenEndTheRunWithStatusTwo) {
  const auto out = fresh_folder("mcap_log_topics");
  write_text(out / "replay.yaml", replay_of("{plugin: mcap_log, file: " + source_folder() + "/tests/data/bag.mcap}"));
  const Finished run = run_cairn({"run", (out / "replay.yaml").string(), "--out", out.string()});
  EXPECT_EQ(run.exit_status, 2);
  EXPECT_THAT(run.err, testing::HasSubstr("choose by `ranges` among /scan, /sonar/left, /sonar/right"));
}

}  // namespace
}  // namespace cairn::testing_program
