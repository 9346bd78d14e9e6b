#include "framework/program/experiment/buildings_experiment.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
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
  double cpu_s = 0.0;
  double peak_mb = 0.0;
};

// `cairn plan MAP ...` in a process of its own, its output to a file.
Run asked(std::vector<std::string> arguments, const std::filesystem::path& output) {
  arguments.insert(arguments.begin(), {"cairn", "plan"});
  arguments.emplace_back("--json");
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  ::unlink(output.c_str());  // of an earlier run, or a link that somebody has put there
  posix_spawn_file_actions_t files{};
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_EXCL, 0644);
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
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
          seconds(used.ru_utime) + seconds(used.ru_stime), static_cast<double>(used.ru_maxrss) / 1024.0};
}

// In a process of its own: the most memory that a process ever had also counts for those that it starts.
void made_apart(const std::function<void()>& make) {
  const pid_t child = ::fork();
  if (child == 0) {
    int status = kExitDone;
    try {
      make();
    } catch (const std::exception& error) {
      std::cerr << "cairn: " << error.what() << "\n";
      status = kExitNotSolved;
    }
    ::_exit(status);
  }
  int status = 0;
  if (child < 0 || ::waitpid(child, &status, 0) != child || status != 0)
    throw std::runtime_error("experiment: the map of a building cannot be made");
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

std::string text_of_place(const Point& at) {
  return fmt::format("{:.3f},{:.3f}", at.x(), at.y());
}

void write_questions(const std::filesystem::path& file, const std::vector<std::pair<Point, Point>>& pairs) {
  std::string text;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    text += fmt::format("{{\"id\": {}, \"from\": \"{}\", \"to\": \"{}\"}}\n", i, text_of_place(pairs[i].first),
                        text_of_place(pairs[i].second));
  write_file(file, text);
}

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::vector<std::string> lines;
  std::ifstream input(file);
  for (std::string line; std::getline(input, line);) lines.push_back(line);
  return lines;
}

// Of one planner, on one map.
struct Asked {
  std::vector<Answer> answers;
  Run first;  // with opening the map and whatever is prepared
  Run all;

  // Of the processor for one more answer.
  [[nodiscard]] double further_ms() const {
    return answers.size() < 2 ? 0.0 : 1e3 * (all.cpu_s - first.cpu_s) / static_cast<double>(answers.size() - 1);
  }
};

class BuildingRow {
 public:
  BuildingRow(const BuildingsConfig& config, double side_m, std::uint64_t seed, const std::filesystem::path& out)
      : config_(config), side_m_(side_m), out_(out) {
    const double largest_m = *std::max_element(config.sides_m.begin(), config.sides_m.end());
    const double share = side_m * side_m / (largest_m * largest_m);
    const BuildingRules rules{side_m, static_cast<int>(std::lround(share * config.landmarks)), config.cell_m,
                              config.radius_m, seed};
    map_file_ = out / fmt::format("building_{:g}_m.cairn", side_m);
    made_apart([&] {
      const SavedMap map = building(rules);
      save_map(map_file_, map);
      write_questions(out_ / "all.jsonl", random_pairs(map.grid, config.radius_m, config.pairs, seed));
    });
    const SavedMap map = MapFile(map_file_).without_cells();
    landmarks_ = map.graph.landmarks().size();
    routes_ = map.graph.routes().size();
    questions_ = lines_of(out_ / "all.jsonl");
  }

  void ask() {
    hybrid_ = asked_of("hybrid", questions_.size(), {});
    for (std::size_t i = 0; i < std::min(questions_.size(), static_cast<std::size_t>(config_.first_answers)); ++i) {
      const auto question = nlohmann::json::parse(questions_[i]);
      firsts_.push_back(
          asked({map_file_, "--from", question.at("from"), "--to", question.at("to")}, out_ / "one.json"));
    }
    if (config_.whole_pairs > 0)
      shortest_ = asked_of("ompl", static_cast<std::size_t>(config_.whole_pairs), {"--set", "improve_iterations=0"});
  }

  [[nodiscard]] std::string over_landmarks_text() const {
    std::vector<double> times_ms;
    for (const Answer& answer : hybrid_.answers) times_ms.push_back(answer.total_ms);
    std::vector<double> firsts_s;
    double first_mb = 0.0;
    for (const Run& run : firsts_) {
      firsts_s.push_back(run.wall_s);
      first_mb = std::max(first_mb, run.peak_mb);
    }
    const auto count = [&](auto is_so) { return std::count_if(hybrid_.answers.begin(), hybrid_.answers.end(), is_so); };
    return fmt::format(
        "| {0:g} x {0:g} | {1} | {2} | {3}/{4} | {5} | {6:.1f} | {7:.1f} | {8:.1f} | {9:.2f} | {10:.2f} | "
        "{11:.0f} | {12:.0f} |\n",
        side_m_, landmarks_, routes_, count([](const Answer& a) { return a.is_solved; }), hybrid_.answers.size(),
        count([](const Answer& a) { return a.on_whole_grid; }), quantile(times_ms, 0.5), quantile(times_ms, 0.95),
        hybrid_.further_ms(), quantile(firsts_s, 0.5), quantile(firsts_s, 1.0), first_mb, hybrid_.all.peak_mb);
  }

  [[nodiscard]] std::string against_shortest_text() const {
    double sum = 0.0;
    double worst = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < shortest_.answers.size(); ++i) {
      const Answer& best = shortest_.answers[i];
      const Answer& over = hybrid_.answers[i];
      if (!best.is_solved || !over.is_solved) continue;
      sum += over.length_m / best.length_m;
      worst = std::max(worst, over.length_m / best.length_m);
      count += 1.0;
    }
    std::vector<double> firsts_s;
    for (const Run& run : firsts_) firsts_s.push_back(run.cpu_s);
    const double first_cpu_s = quantile(firsts_s, 0.5);
    return fmt::format(
        "| {0:g} x {0:g} | {1:.3f} | {2:.3f} | {3:.2f} | {4:.2f} | {5:.0f} | {6:.1f} | {7:.1f} | {8:.0f} |\n", side_m_,
        sum / std::max(count, 1.0), worst, first_cpu_s, shortest_.first.cpu_s,
        shortest_.first.cpu_s / std::max(first_cpu_s, 1e-9), hybrid_.further_ms(), shortest_.further_ms(),
        shortest_.all.peak_mb);
  }

  // Whether each question is solved by both or by neither.
  [[nodiscard]] bool is_as_it_must_be() const {
    for (std::size_t i = 0; i < shortest_.answers.size(); ++i)
      if (shortest_.answers[i].is_solved != hybrid_.answers[i].is_solved) return false;
    return hybrid_.answers.size() == questions_.size();
  }

 private:
  [[nodiscard]] Asked asked_of(const std::string& planner, std::size_t count,
                               const std::vector<std::string>& more) const {
    const auto run = [&](std::size_t questions) {
      const std::filesystem::path file = out_ / "questions.jsonl";
      std::string text;
      for (std::size_t i = 0; i < std::min(questions, questions_.size()); ++i) text += questions_[i] + "\n";
      write_file(file, text);
      std::vector<std::string> arguments{map_file_, "--queries", file, "--jobs", "1", "--planner", planner};
      arguments.insert(arguments.end(), more.begin(), more.end());
      return asked(arguments, out_ / (planner + ".jsonl"));
    };
    Asked asked_here;
    asked_here.first = run(1);
    asked_here.all = run(count);
    asked_here.answers = answers_in(out_ / (planner + ".jsonl"));
    return asked_here;
  }

  const BuildingsConfig& config_;
  double side_m_;
  std::filesystem::path out_;
  std::filesystem::path map_file_;
  std::size_t landmarks_ = 0;
  std::size_t routes_ = 0;
  std::vector<std::string> questions_;
  Asked hybrid_;
  std::vector<Run> firsts_;
  Asked shortest_;
};

constexpr const char* kOverLandmarksHead =
    "| m | landmarks | routes | solved | by the whole grid | median, ms | p95, ms | processor, ms | first answer, s | "
    "worst, s | MB | MB, all questions |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
constexpr const char* kAgainstShortestHead =
    "| m | length ratio, mean | worst | first answer, processor s | by the whole grid, s | times faster | further "
    "answers, ms | by the whole grid, prepared, ms | MB of the whole grid |\n"
    "|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";

}  // namespace

int buildings_experiment(const ExperimentConfig& config, const std::filesystem::path& out) {
  std::string over_landmarks = kOverLandmarksHead;
  std::string against_shortest = kAgainstShortestHead;
  bool as_it_must_be = true;
  for (const double side_m : config.buildings.sides_m) {
    BuildingRow row(config.buildings, side_m, static_cast<std::uint64_t>(config.seeds.from), out);
    row.ask();
    as_it_must_be = row.is_as_it_must_be() && as_it_must_be;
    over_landmarks += row.over_landmarks_text();
    if (config.buildings.whole_pairs > 0) against_shortest += row.against_shortest_text();
  }
  const std::string table = over_landmarks + "\n" + against_shortest;
  write_file(out / "table.md", table);
  std::cout << table << "Table: " << (out / "table.md").string() << ", the maps beside it\n";
  return as_it_must_be ? kExitDone : kExitNotSolved;
}

}  // namespace cairn
