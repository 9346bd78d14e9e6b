// An experiment in shards, each a process of its own, against the same in one.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class ShardsScenario : public ::testing::Test {
 protected:
  ShardsScenario() {
    const std::string config = source_folder() + "/config";
    write_text(folder_ / "drive.yaml", "mission: drive\nrobot: " + config +
                                           "/robots/pioneer1_true_pose.yaml\nworld: " + config +
                                           "/worlds/mapping_smooth_hallway.yaml\nstart: {at_m: [1.727, 1.774]}\n"
                                           "sensor: {plugin: simulated_robot}\nlocalizer: {plugin: odometry_compass}\n"
                                           "map: {plugin: bayes}\nsteps:\n  - drive: [[2.4, 1.8]]\n");
    write_text(folder_ / "maps.yaml",
               "experiment: maps\nmissions: [drive.yaml]\nseeds: {from: 5, count: 2}\nhold_out_every: 5\n"
               "baseline: textbook\nvariants:\n  - {name: textbook, set: [map.clamp_nat=100]}\n"
               "  - {name: clamped, set: [map.clamp_nat=3]}\n");
  }
  [[nodiscard]] Finished experiment(const std::string& out, const std::vector<std::string>& more) const {
    std::vector<std::string> all{"experiment", (folder_ / "maps.yaml").string(), "--out", (folder_ / out).string()};
    all.insert(all.end(), more.begin(), more.end());
    return run_cairn(all);
  }
  [[nodiscard]] std::string text(const std::string& file) const { return text_of_file(folder_ / file); }

  const fs::path folder_ = fresh_folder("shards");
};

TEST_F(ShardsScenario, MergedTablesAreTheBytesOfOneProcess) {
  ASSERT_EQ(experiment("whole", {}).exit_status, 0);
  for (const char* shard : {"1/3", "2/3", "3/3"}) {
    const Finished finished = experiment("parts", {"--shard", shard});
    ASSERT_EQ(finished.exit_status, 0) << finished.err;
    EXPECT_FALSE(fs::exists(folder_ / "parts/table.md")) << "a shard has no table of its own";
  }
  const Finished merged = experiment("parts", {"--merge"});
  ASSERT_EQ(merged.exit_status, 0) << merged.err;
  EXPECT_EQ(text("parts/table.md"), text("whole/table.md"));
  EXPECT_EQ(text("parts/table.json"), text("whole/table.json"));
  EXPECT_THAT(text("parts/table.json"), HasSubstr("clamped"));
}

TEST_F(ShardsScenario, AShardThatIsMissingCostsItsRunsOnlyAndTheyAreNamed) {
  ASSERT_EQ(experiment("parts", {"--shard", "1/2"}).exit_status, 0);
  const Finished merged = experiment("parts", {"--merge"});
  EXPECT_EQ(merged.exit_status, 1);
  EXPECT_THAT(merged.err, HasSubstr("missing: " + (folder_ / "parts/drive/textbook/seed_6/row.json").string() +
                                    ": it is not there: this run has not ended"));
  EXPECT_THAT(merged.err, HasSubstr("2 of 4 runs are missing"));
  EXPECT_TRUE(fs::exists(folder_ / "parts/table.md"));
}

TEST_F(ShardsScenario, RowsOfOtherSettingsAreNotMerged) {
  ASSERT_EQ(experiment("parts", {"--shard", "1/1"}).exit_status, 0);
  const Finished merged = experiment("parts", {"--merge", "--set", "hold_out_every=6"});
  EXPECT_EQ(merged.exit_status, 2);
  EXPECT_THAT(merged.err, HasSubstr("it is of another experiment, or of this one with other settings"));
}

TEST_F(ShardsScenario, WhatIsNoShardIsAnError) {
  const Finished finished = experiment("parts", {"--shard", "5/4"});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, HasSubstr("--shard: \"5/4\" is no shard: K/N with K from 1 to N"));
  EXPECT_EQ(experiment("parts", {"--shard", "1/2", "--merge"}).exit_status, 2);
}

}  // namespace
}  // namespace cairn::testing_program
