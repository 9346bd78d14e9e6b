// An experiment run by several processes, on one machine or many, each a part of its runs.
//
// A shard writes a row file into the folder of each of its runs as soon as that has ended. Merging reads them: the rows
// are those of a single process, to the last bit. A shard that is killed costs those of its runs that had not ended.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/experiments/experiment.hpp"
#include "framework/experiments/shards/ranks.hpp"

namespace cairn {

struct Shard {
  std::size_t number = 1;  // from 1
  std::size_t of = 1;

  // Every of-th run is this shard's, so that each gets some of all missions and variants.
  [[nodiscard]] bool has(std::size_t job) const { return job % of == number - 1; }
};
// "K/N", 1 <= K <= N <= 100000. Throws std::invalid_argument with a sentence.
[[nodiscard]] Shard shard_of(const std::string& text);

// Of the files of the experiment and its missions, and of the settings given over them.
[[nodiscard]] std::string experiment_fingerprint(const std::filesystem::path& file, const ExperimentConfig& config,
                                                 const std::vector<std::string>& overrides);

// Removes the row files of its runs that an earlier start has left. Throws ConfigError.
void forget_rows(const ExperimentConfig& config, const std::filesystem::path& out, const Shard& shard);

// The filter for run_experiment() with which it runs that shard and writes its row files.
[[nodiscard]] RunFilter runs_of(const Shard& shard, const std::string& fingerprint);
// The same for a process of mpirun: each run is begun by whoever is free first. runs must outlive it.
[[nodiscard]] RunFilter runs_of(const RankedRuns& runs, const ExperimentConfig& config,
                                const std::filesystem::path& out, const std::string& fingerprint);

struct MergedRows {
  std::vector<ExperimentRow> rows;   // of all runs; those that are missing as run_experiment() has cancelled ones
  std::vector<std::string> missing;  // a sentence each, with the run's folder and why
};
[[nodiscard]] MergedRows merged_rows(const ExperimentConfig& config, const std::filesystem::path& out,
                                     const std::string& fingerprint);

}  // namespace cairn
