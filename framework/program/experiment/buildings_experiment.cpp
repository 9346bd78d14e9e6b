#include "framework/program/experiment/buildings_experiment.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "framework/experiments/buildings/building.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/output_files.hpp"

extern char** environ;

namespace cairn {
namespace {

struct Run {
  double wall_s = 0.0;
  double peak_mb = 0.0;
};

// `cairn plan MAP ...` in a process of its own, its output to a file.
Run asked(std::vector<std::string> arguments, const std::filesystem::path& output) {
  arguments.insert(arguments.begin(), {"cairn", "plan"});
  arguments.emplace_back("--json");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t files{};
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  ::posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  const auto begin = std::chrono::steady_clock::now();
  pid_t child = 0;
  const int failed = ::posix_spawn(&child, "/proc/self/exe", &files, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&files);
  int status = 0;
  rusage used{};
  if (failed != 0 || ::wait4(child, &status, 0, &used) != child)
    throw std::runtime_error("experiment: the program cannot be started anew");
  // One that answers and finds no route ends with kExitNotSolved.
  if (!WIFEXITED(status) || WEXITSTATUS(status) > kExitNotSolved)
    throw std::runtime_error("experiment: cairn plan " + arguments[2] + " failed");
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
          static_cast<double>(used.ru_maxrss) / 1024.0};
}

struct Answer {
  bool is_solved = false;
  bool on_whole_grid = false;
  double length_m = 0.0;
  double total_ms = 0.0;
};

std::vector<Answer> answers_in(const std::filesystem::path& file) {
  std::vector<Answer> answers;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    const auto json = nlohmann::json::parse(line);
    const auto reason = json.at("reason").get<std::string>();
    answers.push_back({json.at("outcome") == "solved", reason.find("whole grid") != std::string::npos,
                       json.at("length_m").get<double>(), json.at("time_ms").at("total").get<double>()});
  }
  return answers;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const double at = std::ceil(share * static_cast<double>(values.size())) - 1.0;
  return values[static_cast<std::size_t>(std::max(at, 0.0))];
}

std::vector<double> times_of(const std::vector<Answer>& answers) {
  std::vector<double> times;
  for (const Answer& answer : answers) times.push_back(answer.total_ms);
  return times;
}

std::string text_of_place(const Point& at) {
  return fmt::format("{:.3f},{:.3f}", at.x(), at.y());
}

void write_questions(const std::filesystem::path& file, const std::vector<std::pair<Point, Point>>& pairs,
                     std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < std::min(count, pairs.size()); ++i)
    text += fmt::format("{{\"id\": {}, \"from\": \"{}\", \"to\": \"{}\"}}\n", i, text_of_place(pairs[i].first),
                        text_of_place(pairs[i].second));
  write_file(file, text);
}

class BuildingRow {
 public:
  BuildingRow(const BuildingsConfig& config, double side_m, std::uint64_t seed, const std::filesystem::path& out)
      : config_(config), side_m_(side_m), out_(out) {
    const double largest_m = *std::max_element(config.sides_m.begin(), config.sides_m.end());
    const double share = side_m * side_m / (largest_m * largest_m);
    const BuildingRules rules{side_m, static_cast<int>(std::lround(share * config.landmarks)), config.cell_m,
                              config.radius_m, seed};
    map_file_ = out / fmt::format("building_{:g}_m.cairn", side_m);
    const SavedMap map = building(rules);
    save_map(map_file_, map);
    landmarks_ = map.graph.landmarks().size();
    routes_ = map.graph.routes().size();
    pairs_ = random_pairs(map.grid, config.radius_m, config.pairs, seed);
  }

  void ask() {
    write_questions(out_ / "all.jsonl", pairs_, pairs_.size());
    over_ = asked({map_file_, "--queries", out_ / "all.jsonl", "--jobs", "1"}, out_ / "answers.jsonl");
    answers_ = answers_in(out_ / "answers.jsonl");
    for (int i = 0; i < std::min<int>(config_.first_answers, static_cast<int>(pairs_.size())); ++i) {
      const auto& [from, to] = pairs_[static_cast<std::size_t>(i)];
      firsts_.push_back(
          asked({map_file_, "--from", text_of_place(from), "--to", text_of_place(to)}, out_ / "one.json"));
    }
    if (config_.whole_pairs == 0) return;
    write_questions(out_ / "some.jsonl", pairs_, static_cast<std::size_t>(config_.whole_pairs));
    all_ = asked({map_file_, "--queries", out_ / "some.jsonl", "--jobs", "1", "--planner", "ompl", "--set",
                  "improve_iterations=0"},
                 out_ / "shortest.jsonl");
    shortest_ = answers_in(out_ / "shortest.jsonl");
  }

  [[nodiscard]] std::string text() const {
    std::vector<double> firsts_s;
    double first_mb = 0.0;
    for (const Run& run : firsts_) {
      firsts_s.push_back(run.wall_s);
      first_mb = std::max(first_mb, run.peak_mb);
    }
    const auto times = times_of(answers_);
    const auto solved = std::count_if(answers_.begin(), answers_.end(), [](const Answer& a) { return a.is_solved; });
    const auto whole = std::count_if(answers_.begin(), answers_.end(), [](const Answer& a) { return a.on_whole_grid; });
    std::string text =
        fmt::format("| {:g} x {:g} | {} | {} | {}/{} | {} | {:.1f} | {:.1f} | {:.0f} | {:.2f} | {:.2f} | {:.0f} |",
                    side_m_, side_m_, landmarks_, routes_, solved, answers_.size(), whole, quantile(times, 0.5),
                    quantile(times, 0.95), over_.peak_mb, quantile(firsts_s, 0.5), quantile(firsts_s, 1.0), first_mb);
    return text + whole_text(quantile(firsts_s, 0.5)) + "\n";
  }

  // Whether each question is solved by both or by neither.
  [[nodiscard]] bool is_as_it_must_be() const {
    for (std::size_t i = 0; i < shortest_.size(); ++i)
      if (shortest_[i].is_solved != answers_[i].is_solved) return false;
    return answers_.size() == pairs_.size();
  }

 private:
  [[nodiscard]] std::string whole_text(double first_s) const {
    if (shortest_.empty()) return " | | | | | | |";
    double sum = 0.0;
    double worst = 0.0;
    double count = 0.0;
    double whole_ms = 0.0;
    std::vector<double> over_ms;
    for (std::size_t i = 0; i < shortest_.size(); ++i) {
      whole_ms += shortest_[i].total_ms;
      over_ms.push_back(answers_[i].total_ms);
      if (!shortest_[i].is_solved || !answers_[i].is_solved) continue;
      const double ratio = answers_[i].length_m / shortest_[i].length_m;
      sum += ratio;
      worst = std::max(worst, ratio);
      count += 1.0;
    }
    const double shortest_ms = quantile(times_of(shortest_), 0.5);
    const double prepared_s = all_.wall_s - whole_ms / 1e3;
    return fmt::format(" {:.1f} | {:.1f} | {:.0f} | {:.1f} | {:.0f} | {:.3f} | {:.3f} |", prepared_s, shortest_ms,
                       all_.peak_mb, shortest_ms / std::max(quantile(over_ms, 0.5), 1e-9),
                       (prepared_s + shortest_ms / 1e3) / std::max(first_s, 1e-9), sum / std::max(count, 1.0), worst);
  }

  const BuildingsConfig& config_;
  double side_m_;
  std::filesystem::path out_;
  std::filesystem::path map_file_;
  std::size_t landmarks_ = 0;
  std::size_t routes_ = 0;
  std::vector<std::pair<Point, Point>> pairs_;
  Run over_;
  std::vector<Answer> answers_;
  std::vector<Run> firsts_;
  Run all_;
  std::vector<Answer> shortest_;
};

constexpr const char* kHead =
    "| m | landmarks | routes | solved | whole grid | hybrid, ms | p95 | MB | first answer, s | worst | MB | prepared, "
    "s "
    "| shortest, ms | MB | times faster | first, times faster | length ratio | worst |\n"
    "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";

}  // namespace

int buildings_experiment(const ExperimentConfig& config, const std::filesystem::path& out) {
  std::string table = kHead;
  std::cout << kHead;
  bool as_it_must_be = true;
  for (const double side_m : config.buildings.sides_m) {
    BuildingRow row(config.buildings, side_m, static_cast<std::uint64_t>(config.seeds.from), out);
    row.ask();
    as_it_must_be = row.is_as_it_must_be() && as_it_must_be;
    table += row.text();
    std::cout << row.text() << std::flush;
  }
  write_file(out / "table.md", table);
  return as_it_must_be ? kExitDone : kExitNotSolved;
}

}  // namespace cairn
