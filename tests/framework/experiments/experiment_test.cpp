// Runs of an experiment at the same time, with shipped modules.
#include "framework/experiments/experiment.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace cairn {
namespace {

namespace fs = std::filesystem;

class ExperimentTest : public testing::Test {
 protected:
  ExperimentTest() { fs::create_directories(folder_); }
  ~ExperimentTest() override { fs::remove_all(folder_); }

  // A short drive along a wall, in two variants on two seeds.
  [[nodiscard]] ExperimentConfig config() const {
    const std::string shipped = CAIRN_SOURCE_DIR "/config";
    std::ofstream(folder_ / "drive.yaml")
        << "mission: drive\nrobot: " << shipped << "/robots/pioneer1_true_pose.yaml\nworld: " << shipped
        << "/worlds/mapping_smooth_hallway.yaml\nstart: {at_m: [1.727, 1.774]}\n"
           "sensor: {plugin: simulated_robot}\nlocalizer: {plugin: odometry_compass}\n"
           "map: {plugin: bayes}\nsteps:\n  - drive: [[2.2, 1.8]]\n";
    std::ofstream(folder_ / "maps.yaml") << "experiment: maps\nmissions: [drive.yaml]\nseeds: {from: 5, count: 2}\n"
                                            "hold_out_every: 5\nbaseline: textbook\nvariants:\n"
                                            "  - {name: textbook, set: [map.clamp_nat=100]}\n"
                                            "  - {name: clamped, set: [map.clamp_nat=3]}\n";
    return load_experiment(folder_ / "maps.yaml");
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / ("cairn_experiment_" + std::to_string(::getpid()));
  const ModuleLibrary library_{{fs::path(CAIRN_BINARY_DIR) / "lib" / "cairn"}};
};

TEST_F(ExperimentTest, RunsAtTheSameTimeGiveTheRowsOfRunsOneByOne) {
  const std::atomic<bool> cancel{false};
  const ExperimentConfig whole = config();
  const std::vector<ExperimentRow> rows = run_experiment(whole, library_, folder_ / "all", cancel);
  ASSERT_EQ(rows.size(), 4U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    SCOPED_TRACE(rows[i].variant + ", seed " + std::to_string(rows[i].seed));
    EXPECT_EQ(rows[i].result.outcome, MissionOutcome::done) << rows[i].result.reason;
    ExperimentConfig single = whole;
    single.variants = {whole.variants[i / 2]};
    single.seeds = {.from = rows[i].seed, .count = 1};
    const std::vector<ExperimentRow> alone = run_experiment(single, library_, folder_ / "alone", cancel);
    ASSERT_EQ(alone.size(), 1U);
    EXPECT_EQ(alone[0].held_out_log_likelihood, rows[i].held_out_log_likelihood);
  }
}

TEST_F(ExperimentTest, WhatHasNotRunWhenItIsCancelledIsCancelled) {
  const std::atomic<bool> cancel{true};
  for (const ExperimentRow& row : run_experiment(config(), library_, folder_ / "all", cancel))
    EXPECT_EQ(row.result.outcome, MissionOutcome::cancelled);
}

}  // namespace
}  // namespace cairn
