#include "framework/experiments/shards/shards.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "framework/experiments/shards/row_file.hpp"
#include "maps/base/fingerprint.hpp"
#include "maps/base/output_file.hpp"
#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

constexpr std::size_t kMaxShards = 100'000;

// Empty when it cannot be read.
std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::function<void(const ExperimentRow&)> row_writer(const std::string& fingerprint) {
  return [fingerprint](const ExperimentRow& row) {
    if (row.result.outcome != MissionOutcome::cancelled) write_file(row.folder / kRowFile, row_text(row, fingerprint));
  };
}

}  // namespace

Shard shard_of(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash != std::string::npos) {
    const auto number = number_from<std::size_t>(text.substr(0, slash));
    const auto of = number_from<std::size_t>(text.substr(slash + 1));
    if (number && of && *number >= 1 && *number <= *of && *of <= kMaxShards) return {*number, *of};
  }
  throw std::invalid_argument(
      fmt::format("{} is no shard: K/N with K from 1 to N, and N at most {}", in_quotes(text), kMaxShards));
}

std::string experiment_fingerprint(const std::filesystem::path& file, const ExperimentConfig& config,
                                   const std::vector<std::string>& overrides) {
  std::string text = bytes_of(file);
  for (const std::filesystem::path& mission : config.missions) text += '\0' + bytes_of(mission);
  for (const std::string& setting : overrides) text += '\0' + setting;
  return fingerprint_of(text);
}

void forget_rows(const ExperimentConfig& config, const std::filesystem::path& out, const Shard& shard) {
  const std::vector<ExperimentJob> jobs = jobs_of(config, out);
  std::error_code error;
  for (std::size_t i = 0; i < jobs.size(); ++i)
    if (shard.has(i)) std::filesystem::remove(jobs[i].out / kRowFile, error);
}

RunFilter runs_of(const Shard& shard, const std::string& fingerprint) {
  RunFilter filter;
  filter.is_wanted = [shard](std::size_t job) { return shard.has(job); };
  filter.has_run = row_writer(fingerprint);
  return filter;
}

// A row of an earlier start goes when its run begins anew.
RunFilter runs_of(const RankedRuns& runs, const ExperimentConfig& config, const std::filesystem::path& out,
                  const std::string& fingerprint) {
  RunFilter filter;
  filter.may_begin = [&runs, jobs = jobs_of(config, out)](std::size_t job) {
    if (!runs.take(job)) return false;
    std::error_code error;
    std::filesystem::remove(jobs[job].out / kRowFile, error);
    return true;
  };
  filter.has_run = row_writer(fingerprint);
  return filter;
}

MergedRows merged_rows(const ExperimentConfig& config, const std::filesystem::path& out,
                       const std::string& fingerprint) {
  MergedRows merged;
  for (const ExperimentJob& job : jobs_of(config, out)) {
    merged.rows.push_back(row_before_run(job));
    const std::filesystem::path file = job.out / kRowFile;
    try {
      const std::string text = bytes_of(file);
      if (text.empty()) throw std::runtime_error("it is not there: this run has not ended");
      ExperimentRow row = row_from(text, fingerprint);
      row.folder = job.out;
      merged.rows.back() = std::move(row);
    } catch (const std::runtime_error& error) {
      merged.missing.push_back(file.string() + ": " + error.what());
    }
  }
  return merged;
}

}  // namespace cairn
