#include "framework/host/mission_experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "framework/host/mission.hpp"

namespace cairn {
namespace {

ExperimentRow run_seed(const ExperimentConfig& config, const ModuleLibrary& library, const std::filesystem::path& out,
                       const std::atomic<bool>& cancel, std::int64_t seed) {
  const auto begin = std::chrono::steady_clock::now();
  const Mission mission = load_mission(config.mission, config.overrides, seed);
  const std::filesystem::path folder = out / ("seed_" + std::to_string(seed));
  std::filesystem::create_directories(folder);
  MissionRunner runner(mission, library, {folder, false, &cancel});
  RunReport report;
  runner.subscribe(report);
  ExperimentRow row;
  row.seed = seed;
  row.result = runner.run();
  std::ofstream(folder / "report.json") << report.report_json(mission, row.result, runner.graph(), {});
  if (mission.world) row.score = score_against(*mission.world, runner.graph(), config.tolerance_m);
  for (const LandmarkTruth& matched : row.score.matched)
    row.worst_error_m = std::max(row.worst_error_m, matched.error_m);
  row.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return row;
}

int good_rows(const std::vector<ExperimentRow>& rows) {
  return static_cast<int>(std::count_if(rows.begin(), rows.end(), [](const ExperimentRow& r) { return r.is_good(); }));
}

}  // namespace

void SeedRange::describe(Fields<SeedRange>& fields) {
  fields.integer("from", &SeedRange::from, {0.0, 9.0e15}, "first seed");
  fields.integer("count", &SeedRange::count, {1.0, 100000.0}, "how many seeds");
}

void ExperimentConfig::describe(Fields<ExperimentConfig>& fields) {
  using C = ExperimentConfig;
  fields.choice("experiment", &C::experiment, {{"missions", ExperimentKind::missions}}, "what is done").required = true;
  fields.file("mission", &C::mission, "mission file").required = true;
  fields.group("seeds", &C::seeds, "which seeds");
  fields.number("tolerance_m", &C::tolerance_m, {0.0, 100.0}, "m", "a landmark further from the truth counts as false");
  fields.number("at_least_ratio", &C::at_least_ratio, {0.0, 1.0}, "",
                "share of good runs that makes the experiment a success");
  fields.texts("set", &C::overrides, "settings of the mission to override, each `key=value`");
}

bool ExperimentRow::is_good() const {
  return result.outcome == MissionOutcome::done && score.missed_objects == 0 && score.false_landmarks == 0 &&
         result.collisions == 0;
}

ExperimentConfig load_experiment(const std::filesystem::path& file) {
  return load_config<ExperimentConfig>(read_config_file(file), "experiment");
}

std::vector<ExperimentRow> run_experiment(const ExperimentConfig& config, const ModuleLibrary& library,
                                          const std::filesystem::path& out, const std::atomic<bool>& cancel) {
  const auto count = static_cast<std::size_t>(config.seeds.count);
  std::vector<ExperimentRow> rows(count);
  for (std::size_t i = 0; i < count; ++i) {
    rows[i].seed = config.seeds.from + static_cast<std::int64_t>(i);
    rows[i].result.outcome = MissionOutcome::cancelled;  // until it has run
  }
  std::vector<std::exception_ptr> errors(count);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < count && !cancel.load(); i = next++) {
      try {
        rows[i] = run_seed(config, library, out, cancel, config.seeds.from + static_cast<std::int64_t>(i));
      } catch (...) {
        errors[i] = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> workers;
    const std::size_t threads = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, count);
    for (std::size_t i = 0; i < threads; ++i) workers.emplace_back(work);
  }
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  return rows;
}

std::string table_of(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::string text =
      "| seed | outcome | found | missed | false | worst error m | driven m | time s | matchings | collisions | good "
      "|\n"
      "|---:|---|---:|---:|---:|---:|---:|---:|---:|---:|---|\n";
  for (const ExperimentRow& row : rows)
    text += fmt::format("| {} | {} | {} | {} | {} | {:.3f} | {:.1f} | {:.0f} | {} | {} | {} |\n", row.seed,
                        name_of(row.result.outcome), row.score.matched.size(), row.score.missed_objects,
                        row.score.false_landmarks, row.worst_error_m, row.result.distance_m, row.result.time_s,
                        row.result.matchings, row.result.collisions, row.is_good() ? "yes" : "no");
  return text + fmt::format(
                    "\n{} of {} runs found every landmark with the right category within {:.2f} m and nothing "
                    "else, without a collision.\n",
                    good_rows(rows), rows.size(), config.tolerance_m);
}

std::string json_of(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ExperimentRow& row : rows)
    list.push_back({{"seed", row.seed},
                    {"outcome", std::string(name_of(row.result.outcome))},
                    {"found", row.score.matched.size()},
                    {"missed", row.score.missed_objects},
                    {"false", row.score.false_landmarks},
                    {"worst_error_m", row.worst_error_m},
                    {"distance_m", row.result.distance_m},
                    {"time_s", row.result.time_s},
                    {"matchings", row.result.matchings},
                    {"collisions", row.result.collisions},
                    {"good", row.is_good()}});
  const nlohmann::ordered_json all = {{"experiment", "missions"},
                                      {"tolerance_m", config.tolerance_m},
                                      {"good", good_rows(rows)},
                                      {"runs", rows.size()},
                                      {"rows", list}};
  return all.dump();
}

}  // namespace cairn
