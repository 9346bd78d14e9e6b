#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

const std::string kReplay = R"(mission: replay
robot: )" + source_folder() +
                            R"(/config/robots/pioneer1.yaml
sensor: {plugin: carmen_log, file: ./recorded.log}
localizer: {plugin: odometry_compass}
map: {plugin: muriel, cell_m: 0.05}
record: again.log
)";

TEST(Recording, ARecordedMissionPlayedBackGivesTheSameMapBitForBit) {
  const auto out = fresh_folder("recording");
  // 20 s of exploring; the step ends then, unfinished, and so does the mission.
  const Finished first =
      run_cairn({"run", source_folder() + "/config/missions/office.yaml", "--set", "record=recorded.log", "--set",
                 "steps.0.explore.at_most_s=20", "--out", out.string(), "--json"});
  ASSERT_TRUE(std::filesystem::exists(out / "recorded.log")) << first.err;
  write_text(out / "replay.yaml", kReplay);
  const Finished second = run_cairn({"run", (out / "replay.yaml").string(), "--out", out.string(), "--json"});
  ASSERT_EQ(second.exit_status, 0) << second.err;
  const SavedMap recorded = load_map((out / "office.cairn").string());
  const SavedMap replayed = load_map((out / "replay.cairn").string());
  EXPECT_GT(recorded.grid.bounds().width(), 20);
  EXPECT_TRUE(recorded.grid == replayed.grid) << "OG1 differs";
  EXPECT_EQ(nlohmann::json::parse(first.out)["readings"], nlohmann::json::parse(second.out)["readings"]);
  EXPECT_TRUE(text_of_file(out / "recorded.log") == text_of_file(out / "again.log")) << "a replay records itself";
}

TEST(Recording, ChangesNothingOfTheRunItself) {
  const auto with = fresh_folder("recording_with");
  const auto without = fresh_folder("recording_without");
  std::vector<std::string> arguments{"run",   source_folder() + "/config/missions/office.yaml",
                                     "--set", "steps.0.explore.at_most_s=5",
                                     "--out", without.string()};
  (void)run_cairn(arguments);
  arguments.back() = with.string();
  arguments.insert(arguments.end(), {"--set", "record=a.log"});
  (void)run_cairn(arguments);
  for (const char* file : {"report.json", "office.cairn", "map.png"})
    EXPECT_TRUE(text_of_file(with / file) == text_of_file(without / file)) << file << " differs";
}

TEST(Recording, AFileThatCannotBeWrittenIsReportedBeforeTheRun) {
  const auto out = fresh_folder("recording_nowhere");
  std::filesystem::create_directories(out / "a.log");
  const Finished run = run_cairn(
      {"run", source_folder() + "/config/missions/office.yaml", "--set", "record=a.log", "--out", out.string()});
  EXPECT_NE(run.exit_status, 0);
  EXPECT_THAT(run.err, testing::HasSubstr("a.log: the recording cannot be written"));
  EXPECT_FALSE(std::filesystem::exists(out / "office.cairn"));
}

TEST(Recording, AnUnknownKindThatIsNoTextStillLeavesAReport) {
  const auto out = fresh_folder("recording_bytes");
  write_text(out / "recorded.log", "FLASER 1 1 0 0 0 0 0 0 1 h 1\n\xff\xfe\x80 1 2\n");
  write_text(out / "replay.yaml", kReplay);
  const Finished run = run_cairn({"run", (out / "replay.yaml").string(), "--out", out.string(), "--json"});
  EXPECT_EQ(run.exit_status, 0) << run.err;
  EXPECT_THAT(nlohmann::json::parse(run.out)["reason"].get<std::string>(),
              testing::HasSubstr("1 line of kinds not read"));
}

}  // namespace
}  // namespace cairn::testing_program
