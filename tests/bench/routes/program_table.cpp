// Routes on the Moving AI maps of CAIRN_DATA through the program, as its users ask for them:
//   program_table FOLDER [PER_MAP [SEED]]
// For each map `cairn map import NAME.map -o NAME.cairn`, then all queries with one
// `cairn plan NAME.cairn --queries NAME.jsonl --radius-m 0 --json`; the files stay in the folder. Exit status 1 when
// an instance is not solved or a path is none.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/bench/graph/unpacked.hpp"
#include "tests/bench/routes/grid_router.hpp"
#include "tests/bench/routes/lazy_theta_star.hpp"
#include "tests/bench/routes/moving_ai_set.hpp"
#include "tests/bench/routes/path_check.hpp"

namespace cairn {
namespace {

constexpr double kLong_cells = 50.0;

struct SetResult {
  std::size_t asked = 0;
  std::size_t solved = 0;
  std::size_t broken = 0;
  std::size_t over = 0;  // longer than the eight-neighbour optimum
  std::vector<double> ratios;
  std::vector<double> total_ms;  // as the answers say
  double import_s = 0.0;
  double plan_s = 0.0;  // with starting the program and loading the map
};

double seconds_of_command(const std::string& command) {
  const auto begin = Budget::Clock::now();
  const int status = std::system(command.c_str());
  if (status != 0 && WEXITSTATUS(status) != 1) throw std::runtime_error(command + ": status " + std::to_string(status));
  return std::chrono::duration<double>(Budget::Clock::now() - begin).count();
}

std::string place_text(const Point& p) {
  return std::to_string(p.x()) + "," + std::to_string(p.y());
}

void judge(const nlohmann::json& answer, const PlainCells& cells, const MovingAiInstance& instance,
           PlainSearches& plain, SetResult& sum) {
  const double optimum = plain.a_star(instance.from, instance.to).length;
  if (std::isinf(optimum)) return;  // some files have such instances
  ++sum.asked;
  sum.total_ms.push_back(answer.at("time_ms").at("total"));
  if (answer.at("outcome") != "solved") return;
  ++sum.solved;
  std::vector<Point> path;
  for (const auto& pose : answer.at("path")) path.emplace_back(pose.at(0), pose.at(1));
  const std::string fault =
      fault_of_point_path(cells, path, cells.centre_m(instance.from), cells.centre_m(instance.to));
  if (!fault.empty()) {
    ++sum.broken;
    std::fprintf(stderr, "%s\n", fault.c_str());
  }
  const double ratio = length_of_m(path) / optimum;
  if (ratio > 1.0 + 1e-9) ++sum.over;
  if (instance.optimum > kLong_cells) sum.ratios.push_back(ratio);
}

void run_map(const std::filesystem::path& file, const std::filesystem::path& folder, std::size_t count,
             std::uint64_t seed, SetResult& sum) {
  const std::string name = file.stem().stem().string();
  const std::string base = (folder / name).string();
  const PlainCells cells = moving_ai_cells(file);
  const auto instances = moving_ai_instances(scenario_of(file), cells.height, count, seed);
  std::ofstream(base + ".map") << unpacked(file);
  {
    std::ofstream queries(base + ".jsonl");
    for (std::size_t i = 0; i < instances.size(); ++i)
      queries << R"({"id": )" << i << R"(, "from": ")" << place_text(cells.centre_m(instances[i].from))
              << R"(", "to": ")" << place_text(cells.centre_m(instances[i].to)) << "\"}\n";
  }
  const std::string program = CAIRN_BINARY_DIR "/bin/cairn";
  sum.import_s += seconds_of_command(program + " map import " + base + ".map -o " + base + ".cairn >/dev/null 2>&1");
  sum.plan_s += seconds_of_command(program + " plan " + base + ".cairn --queries " + base +
                                   ".jsonl --radius-m 0 --json >" + base + ".answers.jsonl 2>/dev/null");
  PlainSearches plain(cells);
  std::ifstream answers(base + ".answers.jsonl");
  std::size_t i = 0;
  for (std::string line; std::getline(answers, line); ++i) {
    const auto answer = nlohmann::json::parse(line);
    if (answer.at("id") != i) throw std::runtime_error(base + ".answers.jsonl: answers are not in order");
    judge(answer, cells, instances.at(i), plain, sum);
  }
}

bool print_table(const std::filesystem::path& folder, std::size_t count, std::uint64_t seed) {
  std::filesystem::create_directories(folder);
  std::printf(
      "| set | instances | solved | refused by the checker | over the optimum | mean / optimum | median ms | p99 "
      "| longest | imports, s | `cairn plan`, s | queries a second |\n"
      "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  bool all_well = true;
  for (const std::string set : {"dao", "bg512", "da2", "sc1", "cities", "rooms", "mazes", "random"}) {
    SetResult sum;
    for (const auto& file : moving_ai_maps(set)) run_map(file, folder, count, seed, sum);
    if (sum.asked == 0) {
      std::fprintf(stderr, "%s: skipped, it is not in %s (CAIRN_DATA)\n", set.c_str(), data_folder().c_str());
      continue;
    }
    double mean = 0.0;
    for (const double ratio : sum.ratios) mean += ratio / static_cast<double>(sum.ratios.size());
    std::printf("| %s | %zu | %zu | %zu | %zu | %.4f | %.2f | %.2f | %.1f | %.1f | %.1f | %.0f |\n", set.c_str(),
                sum.asked, sum.solved, sum.broken, sum.over, mean, quantile(sum.total_ms, 0.5),
                quantile(sum.total_ms, 0.99), quantile(sum.total_ms, 1.0), sum.import_s, sum.plan_s,
                static_cast<double>(sum.asked) / sum.plan_s);
    std::fflush(stdout);
    all_well = all_well && sum.solved == sum.asked && sum.broken == 0;
  }
  return all_well;
}

}  // namespace
}  // namespace cairn

int main(int count, char** arguments) {
  if (count < 2 || count > 4) {
    std::fprintf(stderr, "usage: program_table FOLDER [PER_MAP [SEED]]\n");
    return 2;
  }
  try {
    const std::size_t per_map = count > 2 ? std::stoul(arguments[2]) : 20;
    return cairn::print_table(arguments[1], per_map, count > 3 ? std::stoull(arguments[3]) : 1) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "program_table: %s\n", error.what());
    return 2;
  }
}
