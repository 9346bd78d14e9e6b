// Routes of the module `ompl` on the maps of the Moving AI benchmarks, as tables in Markdown:
//   route_table [--sets dao,mazes] [--per-map N] [--seed S] [--settings YAML] [--no-route N]
// Beside Lazy Theta* and the eight-neighbour optimum on the same instances, in the same run. --no-route asks for N
// pairs a map between which there is none, in place of the instances. Exit status 1 when an instance is not solved or
// a path is none.

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <random>
#include <sstream>

#include "tests/bench/graph/unpacked.hpp"
#include "tests/bench/routes/grid_router.hpp"
#include "tests/bench/routes/lazy_theta_star.hpp"
#include "tests/bench/routes/moving_ai_set.hpp"
#include "tests/bench/routes/path_check.hpp"

namespace cairn {
namespace {

constexpr double kLong_cells = 50.0;  // from which on lengths are compared
constexpr double kEqual_ratio = 1e-9;
constexpr double kFileRounding = 2e-3;  // some files give two decimals, of optima of few cells
constexpr int kMiddling = 512;          // cells a side; a larger map is counted apart

struct Settings {
  std::vector<std::string> sets{"dao", "bg512", "da2", "sc1", "cities", "rooms", "mazes", "random"};
  std::size_t per_map = 20;
  std::uint64_t seed = 1;
  std::string module_settings;
  std::size_t no_route = 0;
};

struct Times {
  std::vector<double> ours_ms;
  std::vector<double> lazy_ms;
};

struct SetResult {
  std::size_t maps = 0;
  std::size_t instances = 0;      // that have a way
  std::size_t without_a_way = 0;  // by the plain search; all answered so
  std::size_t solved = 0;
  std::size_t broken = 0;  // of the solved: what the checker refuses
  std::size_t over = 0;    // longer than the eight-neighbour optimum
  std::size_t lazy_over = 0;
  std::size_t longer_than_lazy = 0;
  std::size_t strange = 0;  // optima that differ from the file's
  std::vector<double> ours_ratio;
  std::vector<double> lazy_ratio;
  Times middling;
  Times large;
};

double milliseconds_of(const std::function<void()>& work) {
  const auto begin = Budget::Clock::now();
  work();
  return std::chrono::duration<double, std::milli>(Budget::Clock::now() - begin).count();
}

void complain(const std::string& map, const MovingAiInstance& i, const std::string& what) {
  std::fprintf(stderr, "%s (%d, %d) to (%d, %d): %s\n", map.c_str(), i.from.x, i.from.y, i.to.x, i.to.y, what.c_str());
}

void compare(const MovingAiInstance& instance, const std::string& name, const PlainCells& cells,
             const GridRouter& router, PlainSearches& plain, SetResult& sum) {
  const Point from = cells.centre_m(instance.from);
  const Point to = cells.centre_m(instance.to);
  const TimedPlan ours = timed_plan(router, from, to);
  PlainPath lazy;
  const double lazy_ms = milliseconds_of([&] { lazy = plain.lazy_theta_star(instance.from, instance.to); });
  const double optimum = plain.a_star(instance.from, instance.to).length;
  if (std::isinf(optimum)) {  // some files have such instances
    ++sum.without_a_way;
    if (ours.result.outcome != PlanOutcome::no_route)
      complain(name, instance, "has no way, and an answer that is none");
    return;
  }
  ++sum.instances;
  if (std::abs(optimum - instance.optimum) > kFileRounding * std::max(1.0, optimum)) {
    ++sum.strange;
    complain(name, instance, "optimum " + std::to_string(optimum) + ", not " + std::to_string(instance.optimum));
  }
  Times& times = std::max(cells.width, cells.height) > kMiddling ? sum.large : sum.middling;
  times.ours_ms.push_back(ours.took_ms);
  times.lazy_ms.push_back(lazy_ms);
  if (ours.result.outcome != PlanOutcome::solved)
    return complain(name, instance, std::string(name_of(ours.result.outcome)) + ", " + ours.result.reason);
  ++sum.solved;
  const std::vector<Point> path = points_of(ours.result);
  if (const std::string fault = fault_of_point_path(cells, path, from, to); !fault.empty()) {
    ++sum.broken;
    complain(name, instance, fault);
  }
  const double length = length_of_m(path);
  if (length > optimum * (1.0 + kEqual_ratio)) ++sum.over;
  if (lazy.length > optimum * (1.0 + kEqual_ratio)) ++sum.lazy_over;
  if (length > lazy.length * (1.0 + kEqual_ratio)) ++sum.longer_than_lazy;
  if (optimum <= kLong_cells) return;
  sum.ours_ratio.push_back(length / optimum);
  sum.lazy_ratio.push_back(lazy.length / optimum);
}

SetResult result_of(const std::string& set, const Settings& settings) {
  SetResult sum;
  for (const auto& file : moving_ai_maps(set)) {
    const PlainCells cells = moving_ai_cells(file);
    const auto instances = moving_ai_instances(scenario_of(file), cells.height, settings.per_map, settings.seed);
    const GridRouter router(grid_of(cells), 0.0, settings.module_settings);
    PlainSearches plain(cells);
    if (instances.empty()) continue;
    ++sum.maps;
    // The first query makes what the map's later ones use.
    static_cast<void>(router.plan(cells.centre_m(instances.front().from), cells.centre_m(instances.front().to)));
    for (const MovingAiInstance& instance : instances)
      compare(instance, set + "/" + file.stem().stem().string(), cells, router, plain, sum);
  }
  return sum;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

void print_times(const std::string& set, const std::string& size, const Times& t) {
  if (t.ours_ms.empty()) return;
  std::vector<double> ratios;
  for (std::size_t i = 0; i < t.ours_ms.size(); ++i) ratios.push_back(t.ours_ms[i] / t.lazy_ms[i]);
  std::printf("| %s | %s | %zu | %.2f | %.2f | %.1f | %.2f | %.2f | %.1f | %.2f |\n", set.c_str(), size.c_str(),
              t.ours_ms.size(), quantile(t.ours_ms, 0.5), quantile(t.ours_ms, 0.99), quantile(t.ours_ms, 1.0),
              quantile(t.lazy_ms, 0.5), quantile(t.lazy_ms, 0.99), quantile(t.lazy_ms, 1.0), quantile(ratios, 0.5));
}

bool print_routes(const Settings& settings) {
  std::map<std::string, SetResult> results;
  for (const std::string& set : settings.sets) {
    results[set] = result_of(set, settings);
    std::fprintf(stderr, "%s: %zu instances\n", set.c_str(), results[set].instances);
  }
  std::printf(
      "| set | maps | instances | solved | refused by the checker | over the optimum | Lazy Theta* over it | "
      "longer than Lazy Theta* | mean / optimum | Lazy Theta*'s | worst / optimum |\n"
      "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  bool all_well = true;
  for (const std::string& set : settings.sets) {
    const SetResult& r = results[set];
    if (r.instances == 0) {
      std::printf("| %s | 0 |\n", set.c_str());
      std::fprintf(stderr, "%s: skipped, it is not in %s (CAIRN_DATA)\n", set.c_str(), data_folder().c_str());
      continue;
    }
    std::printf("| %s | %zu | %zu | %zu | %zu | %zu | %zu | %zu | %.4f | %.4f | %.4f |\n", set.c_str(), r.maps,
                r.instances, r.solved, r.broken, r.over, r.lazy_over, r.longer_than_lazy, mean(r.ours_ratio),
                mean(r.lazy_ratio), quantile(r.ours_ratio, 1.0));
    if (r.without_a_way > 0) std::printf("%zu instances of %s have no way\n", r.without_a_way, set.c_str());
    if (r.strange > 0) std::printf("%zu optima of %s are not what its files say\n", r.strange, set.c_str());
    all_well = all_well && r.solved == r.instances && r.broken == 0;
  }
  std::printf(
      "\n| set | side, cells | instances | median ms | p99 | longest | Lazy Theta*: median ms | p99 | longest | "
      "ours / Lazy Theta*, median |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  Times all;
  for (const std::string& set : settings.sets) {
    print_times(set, "to 512", results[set].middling);
    print_times(set, "more", results[set].large);
    all.ours_ms.insert(all.ours_ms.end(), results[set].middling.ours_ms.begin(), results[set].middling.ours_ms.end());
    all.lazy_ms.insert(all.lazy_ms.end(), results[set].middling.lazy_ms.begin(), results[set].middling.lazy_ms.end());
  }
  print_times("all", "to 512", all);
  return all_well;
}

// Pairs of open cells that no way joins, found without the planner; none when all open cells hang together.
std::vector<MovingAiInstance> parted_pairs(const PlainCells& cells, std::size_t count, std::uint64_t seed) {
  const std::vector<std::int32_t> part = parts_of(cells);
  std::vector<Cell> open;
  std::map<std::int32_t, std::vector<Cell>> cells_of_part;
  for (int y = 0; y < cells.height; ++y)
    for (int x = 0; x < cells.width; ++x)
      if (cells.is_open(x, y)) {
        open.push_back({x, y});
        cells_of_part[part[cells.index(x, y)]].push_back({x, y});
      }
  std::vector<MovingAiInstance> pairs;
  if (cells_of_part.size() < 2) return pairs;
  std::mt19937_64 random(seed);
  while (pairs.size() < count) {
    // A part first, then its cell: most open cells are in one part.
    const auto chosen = std::next(cells_of_part.begin(), static_cast<std::ptrdiff_t>(random() % cells_of_part.size()));
    const Cell from = open[random() % open.size()];
    const Cell to = chosen->second[random() % chosen->second.size()];
    if (part[cells.index(from.x, from.y)] != chosen->first) pairs.push_back({from, to, 0.0});
  }
  return pairs;
}

bool print_no_routes(const Settings& settings) {
  std::map<std::string, std::vector<double>> times_ms;
  std::size_t wrong = 0;
  for (const std::string& set : settings.sets)
    for (const auto& file : moving_ai_maps(set)) {
      const PlainCells cells = moving_ai_cells(file);
      const auto pairs = parted_pairs(cells, settings.no_route, settings.seed);
      if (pairs.empty()) continue;
      const int side = std::max(cells.width, cells.height);
      const GridRouter router(grid_of(cells), 0.0, settings.module_settings);
      static_cast<void>(router.plan(cells.centre_m(pairs.front().from), cells.centre_m(pairs.front().from)));
      for (const MovingAiInstance& pair : pairs) {
        const TimedPlan ours = timed_plan(router, cells.centre_m(pair.from), cells.centre_m(pair.to));
        times_ms[side <= 256    ? "to 256"
                 : side <= 512  ? "257 to 512"
                 : side <= 1024 ? "513 to 1024"
                                : "more"]
            .push_back(ours.took_ms);
        if (ours.result.outcome == PlanOutcome::no_route) continue;
        ++wrong;
        complain(file.stem().stem().string(), pair, std::string(name_of(ours.result.outcome)));
      }
    }
  std::printf("| side, cells | pairs | median ms | p99 | longest |\n|---|---:|---:|---:|---:|\n");
  for (const auto& [side, times] : times_ms)
    std::printf("| %s | %zu | %.4f | %.4f | %.3f |\n", side.c_str(), times.size(), quantile(times, 0.5),
                quantile(times, 0.99), quantile(times, 1.0));
  if (wrong > 0) std::printf("%zu answers are not no_route\n", wrong);
  return wrong == 0;
}

Settings settings_of(int count, char** arguments) {
  Settings settings;
  for (int i = 1; i < count; i += 2) {
    const std::string name = arguments[i];
    if (i + 1 == count) throw std::invalid_argument(name + " needs a value");
    const std::string value = arguments[i + 1];
    if (name == "--sets") {
      settings.sets.clear();
      std::istringstream words(value);
      for (std::string set; std::getline(words, set, ',');) settings.sets.push_back(set);
    } else if (name == "--per-map") {
      settings.per_map = std::stoul(value);
    } else if (name == "--seed") {
      settings.seed = std::stoull(value);
    } else if (name == "--settings") {
      settings.module_settings = value;
    } else if (name == "--no-route") {
      settings.no_route = std::stoul(value);
    } else {
      throw std::invalid_argument("unknown option " + name +
                                  "; there are --sets, --per-map, --seed, --settings, --no-route");
    }
  }
  return settings;
}

}  // namespace
}  // namespace cairn

int main(int count, char** arguments) {
  try {
    const cairn::Settings settings = cairn::settings_of(count, arguments);
    return (settings.no_route > 0 ? cairn::print_no_routes(settings) : cairn::print_routes(settings)) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "route_table: %s\n", error.what());
    return 2;
  }
}
