#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>

#include "framework/experiments/contacts.hpp"
#include "framework/experiments/homes/table.hpp"
#include "framework/experiments/recognition/curves_table.hpp"
#include "framework/experiments/report.hpp"
#include "framework/experiments/shards/ranks.hpp"
#include "framework/experiments/shards/shards.hpp"
#include "framework/experiments/trials/table.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/interrupt.hpp"
#include "framework/program/common/making_watch.hpp"
#include "framework/program/common/modules.hpp"
#include "framework/program/common/output_files.hpp"
#include "framework/program/common/refusal.hpp"
#include "framework/program/experiment/buildings_experiment.hpp"
#include "framework/program/experiment/experiment_charts.hpp"

namespace cairn {
namespace {

// Wall clock: differs from run to run, so it is in no file.
std::string times_text(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::string text =
      "| variant | times real time | detector s a run | detector us a matching, all its work included |\n"
      "|---|---:|---:|---:|\n";
  for (const ExperimentVariant& variant : config.variants) {
    double runs = 0.0;
    double speed = 0.0;
    double detector_s = 0.0;
    double matchings = 0.0;
    for (const ExperimentRow& row : rows) {
      if (row.variant != variant.name) continue;
      runs += 1.0;
      speed += row.result.time_s / std::max(row.wall_s, 1e-9);
      detector_s += row.detector_wall_s;
      matchings += static_cast<double>(row.result.matchings);
    }
    text += fmt::format("| {} | {:.0f} | {:.3f} | {} |\n", variant.name, speed / std::max(runs, 1.0),
                        detector_s / std::max(runs, 1.0),
                        matchings > 0.0 ? fmt::format("{:.0f}", 1e6 * detector_s / matchings) : "");
  }
  if (config.experiment == ExperimentKind::trials) text += "\n" + trial_times_table(config, rows);
  return text + "\n" + sweep_times_table(config, rows);
}

// Done when every run was, of missions when enough of them were good, of trials when all limits were kept.
int exit_status_of(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  const auto count = [&](auto is_so) { return std::count_if(rows.begin(), rows.end(), is_so); };
  const auto runs = static_cast<double>(rows.size());
  const bool cancelled =
      count([](const ExperimentRow& row) { return row.result.outcome == MissionOutcome::cancelled; }) > 0;
  const auto done = count([](const ExperimentRow& row) { return row.result.outcome == MissionOutcome::done; });
  const auto good = count([](const ExperimentRow& row) { return row.is_good(); });
  if (!keeps_contact_limit(config, rows)) return kExitNotSolved;
  if (config.experiment == ExperimentKind::trials)
    return !cancelled && broken_limits(config, rows).empty() && too_long(config, rows).empty() ? kExitDone
                                                                                               : kExitNotSolved;
  if (config.experiment == ExperimentKind::homes)
    return !cancelled && keeps_homes_limits(config, rows) ? kExitDone : kExitNotSolved;
  const bool enough = config.experiment != ExperimentKind::missions
                          ? static_cast<double>(done) == runs
                          : static_cast<double>(good) >= config.at_least_ratio * runs;
  return enough && !cancelled ? kExitDone : kExitNotSolved;
}

// The table and what belongs to it, from rows of all runs.
int write_results(const ExperimentCommand& command, const CommonOptions& common, const ExperimentConfig& config,
                  const std::vector<ExperimentRow>& rows) {
  const std::string table = table_of(config, rows);
  const std::string json = json_of(config, rows);
  write_file(command.out / "table.md", table);
  write_file(command.out / "table.json", json + "\n");
  for (const std::string& missing : write_charts(config, rows, command.out)) std::cerr << "cairn: " << missing << "\n";
  if (common.json) std::cout << json << "\n";
  std::ostream& people = common.json ? std::cerr : std::cout;
  people << table << times_text(config, rows) << "Table: " << (command.out / "table.md").string()
         << ", pictures beside it\n";
  return exit_status_of(config, rows);
}

// Of a shard: whether all its runs have ended, as good or bad as they may be.
int report_shard(const Shard& shard, const std::vector<ExperimentRow>& rows) {
  const auto ended = std::count_if(rows.begin(), rows.end(), [](const ExperimentRow& row) {
    return row.result.outcome != MissionOutcome::cancelled;
  });
  std::cerr << fmt::format("shard {}/{}: {} of {} runs have ended; --merge makes the table\n", shard.number, shard.of,
                           ended, rows.size());
  return static_cast<std::size_t>(ended) == rows.size() ? kExitDone : kExitNotSolved;
}

void report_rank(const Rank& rank, const std::vector<ExperimentRow>& rows) {
  const auto ended = std::count_if(rows.begin(), rows.end(), [](const ExperimentRow& row) {
    return row.result.outcome != MissionOutcome::cancelled;
  });
  std::cerr << fmt::format("rank {} of {}: no run is left; {} of {} were its own\n", rank.number, rank.of, ended,
                           rows.size());
}

// On a terminal a line that changes; of a rank, which has none, a line each ten seconds.
std::function<void(std::size_t, std::size_t)> progress(const std::optional<Rank>& rank) {
  if (rank)
    return [rank, last = std::chrono::steady_clock::now()](std::size_t ended, std::size_t runs) mutable {
      constexpr std::chrono::seconds kBetween(10);
      const auto now = std::chrono::steady_clock::now();
      if (now - last < kBetween) return;
      last = now;
      std::cerr << fmt::format("rank {} of {}: has run {} of the {} runs\n", rank->number, rank->of, ended, runs);
    };
  if (::isatty(STDERR_FILENO) == 0) return {};
  return [](std::size_t ended, std::size_t runs) {
    std::cerr << fmt::format("\r{} of {} runs{}", ended, runs, ended == runs ? "\n" : "") << std::flush;
  };
}

int merge(const ExperimentCommand& command, const CommonOptions& common, const ExperimentConfig& config,
          const MergedRows& merged) {
  if (merged.missing.size() == merged.rows.size() && !merged.missing.empty())
    throw std::runtime_error("experiment: there is nothing to merge: " + merged.missing.front());
  const int status = write_results(command, common, config, merged.rows);
  for (const std::string& sentence : merged.missing) std::cerr << "missing: " << sentence << "\n";
  if (!merged.missing.empty())
    std::cerr << fmt::format("{} of {} runs are missing; run their shards again\n", merged.missing.size(),
                             merged.rows.size());
  return merged.missing.empty() ? status : kExitNotSolved;
}

}  // namespace

int experiment(const ExperimentCommand& command, const CommonOptions& common) {
  const ExperimentConfig config = load_experiment(command.file, command.overrides);
  const bool is_shared = command.merge || !command.shard.empty();
  if (is_shared && config.experiment == ExperimentKind::buildings)
    throw std::runtime_error(
        "experiment: an experiment of buildings measures times, which no other machine knows: "
        "--shard and --merge are for the other kinds");
  make_folder(command.out);
  if (config.experiment == ExperimentKind::buildings) return buildings_experiment(config, command.out);
  const std::string fingerprint = experiment_fingerprint(command.file, config, command.overrides);
  if (command.merge) return merge(command, common, config, merged_rows(config, command.out, fingerprint));
  std::optional<Shard> shard;
  if (!command.shard.empty()) shard = refused_about("--shard", [&] { return shard_of(command.shard); });
  const std::optional<Rank> rank = shard ? std::nullopt : rank_of_launcher();
  std::optional<RankedRuns> ranked;
  RunFilter filter;
  if (shard) {
    forget_rows(config, command.out, *shard);
    filter = runs_of(*shard, fingerprint);
  } else if (rank) {
    filter = runs_of(ranked.emplace(command.out, *rank), config, command.out, fingerprint);
  }
  const ModuleLibrary library = module_library(common);
  const std::atomic<bool>& cancel = cancel_on_interrupt();
  const MakingWatch watch = watch_making(kMaxMaking_s, cancel);
  const std::vector<ExperimentRow> rows = run_experiment(config, library, command.out, cancel, progress(rank), filter);
  const auto finish = [&] {
    if (shard) return report_shard(*shard, rows);
    if (!ranked) return write_results(command, common, config, rows);
    report_rank(*rank, rows);
    // The last to end finds all rows there. When several do, they write the same bytes.
    if (!ranked->end()) return kExitDone;
    ranked->clear();
    return merge(command, common, config, merged_rows(config, command.out, fingerprint));
  };
  const int status = finish();
  if (std::any_of(rows.begin(), rows.end(), [](const ExperimentRow& row) { return row.gave_up; })) {
    // A lost call still runs: nothing that it may use can be torn down.
    std::cout.flush();
    std::cerr.flush();
    std::_Exit(status);
  }
  return status;
}

}  // namespace cairn
