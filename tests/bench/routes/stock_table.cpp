// Routes for a disc beside stock OMPL (stock_ompl.hpp) on the occupancy grids of CAIRN_DATA and on rooms with walls
// one cell thick, as tables in Markdown:
//   stock_table motions|quality|cuts [--pairs N] [--seed S] [--limit SECONDS] [--maps depot,grid] [--settings YAML]
// motions: motion checks a second on the same motions. quality: time until the stock planner's path is within 1 % of
// ours. cuts: paths that stock OMPL calls exact at its default resolution and that touch something.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>
#include <random>
#include <sstream>

#include "tests/bench/routes/grid_router.hpp"
#include "tests/bench/routes/occupancy_maps.hpp"
#include "tests/bench/routes/path_check.hpp"
#include "tests/bench/routes/random_rooms.hpp"
#include "tests/bench/routes/stock_ompl.hpp"

namespace cairn {
namespace {

constexpr double kRadius_m = 0.25;
constexpr double kEnough_ratio = 1.01;
constexpr std::size_t kMotions = 2000;
constexpr double kMinTime_s = 0.2;

struct Settings {
  std::string table;
  std::size_t pairs = 5;  // a map
  std::uint64_t seed = 1;
  double limit_s = 5.0;
  std::vector<std::string> maps;  // empty: all
  std::string module_settings;    // besides the algorithm
};

// A map with what is asked on it.
struct Site {
  std::string name;
  OccupancyGrid grid;
  DiscSpace space;
  std::vector<Cell> places;  // where the disc fits, all joined

  Site(std::string map_name, OccupancyGrid map_grid)
      : name(std::move(map_name)), grid(std::move(map_grid)), space(grid, GroundRules{}) {
    // As a map of its own whose open cells are those where the disc fits.
    const CellBox box = grid.bounds();
    PlainCells fits{box.width(), box.height(), {}, {0.0, 0.0}, grid.cell_m()};
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x)
        fits.open.push_back(space.fits(grid.centre_of({x, y}), kRadius_m) ? 1 : 0);
    for (const Cell cell : largest_part(fits)) places.push_back(cell + box.min);
  }

  [[nodiscard]] std::vector<StraightMotion> random_pairs(std::size_t count, std::mt19937_64& random) const {
    std::vector<StraightMotion> pairs;
    while (pairs.size() < count)
      pairs.emplace_back(grid.centre_of(places[random() % places.size()]),
                         grid.centre_of(places[random() % places.size()]));
    return pairs;
  }
};

std::vector<Site> sites_of(const Settings& settings) {
  std::vector<Site> sites;
  const auto wanted = [&](const std::string& name) {
    return settings.maps.empty() || std::find(settings.maps.begin(), settings.maps.end(), name) != settings.maps.end();
  };
  for (OccupancyMap& map : occupancy_maps())
    if (wanted(map.name)) sites.emplace_back(map.name, std::move(map.grid));
  if (sites.empty() && settings.maps.empty()) std::fprintf(stderr, "occ_maps: skipped, CAIRN_DATA has none\n");
  RoomsShape thin;
  thin.side_cells = 1024;
  thin.room_cells = 79;
  thin.door_cells = 18;
  thin.cell_m = 0.05;
  if (wanted("thin_rooms")) sites.emplace_back("thin_rooms", grid_of(random_rooms(thin, settings.seed)));
  std::erase_if(sites, [](const Site& site) { return site.places.size() < 2; });
  return sites;
}

double seconds_of(const std::function<void()>& work) {
  const auto begin = Budget::Clock::now();
  work();
  return std::chrono::duration<double>(Budget::Clock::now() - begin).count();
}

// How often a second, over as many rounds as it takes to measure.
double rate_of(std::size_t count, const std::function<void()>& round) {
  std::size_t done = 0;
  double took_s = 0.0;
  while (took_s < kMinTime_s) {
    took_s += seconds_of(round);
    done += count;
  }
  return static_cast<double>(done) / took_s;
}

std::size_t count_fitting(const DiscSpace& space, const std::vector<StraightMotion>& motions) {
  return static_cast<std::size_t>(std::count_if(motions.begin(), motions.end(), [&](const StraightMotion& motion) {
    return space.fits_along(motion.first, motion.second, kRadius_m);
  }));
}

// Random ones, and those that planners ask about, by the planner's name.
std::vector<std::pair<std::string, std::vector<StraightMotion>>> motions_on(const Site& site, const StockOmpl& stock,
                                                                            const Settings& settings) {
  std::mt19937_64 random(settings.seed);
  std::vector<std::pair<std::string, std::vector<StraightMotion>>> kinds{
      {"random", site.random_pairs(kMotions, random)}};
  for (const std::string planner : {"RRTConnect", "RRTstar", "BITstar"}) {
    kinds.emplace_back(planner, std::vector<StraightMotion>{});
    for (const StraightMotion& ends : site.random_pairs(settings.pairs, random)) {
      const auto asked = stock.motions_asked(planner, ends, kMotions / settings.pairs, settings.limit_s);
      kinds.back().second.insert(kinds.back().second.end(), asked.begin(), asked.end());
    }
  }
  return kinds;
}

void print_motions(const Settings& settings) {
  std::printf(
      "| map | motions | mean m | free, exactly | free, says stock | ours, 1000/s | stock by distance field | "
      "ratio | stock by cells | ratio |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  std::map<std::string, std::vector<double>> field_ratios;  // by kind of motions
  std::map<std::string, std::vector<double>> cell_ratios;
  for (const Site& site : sites_of(settings)) {
    const StockOmpl stock(site.space, kRadius_m, 0.5 * site.grid.cell_m());
    const StockOmpl by_cells(site.space, kRadius_m, 0.5 * site.grid.cell_m(), StockValidity::by_cells);
    for (const auto& [kind, motions] : motions_on(site, stock, settings)) {
      if (motions.empty()) continue;
      double metres = 0.0;
      for (const StraightMotion& motion : motions) metres += (motion.second - motion.first).norm();
      std::size_t exact = 0;
      std::size_t says_stock = 0;
      const double ours = rate_of(motions.size(), [&] { exact = count_fitting(site.space, motions); });
      const double theirs = rate_of(motions.size(), [&] { says_stock = stock.count_valid(motions); });
      const double scanned = rate_of(motions.size(), [&] { says_stock = by_cells.count_valid(motions); });
      field_ratios[kind].push_back(ours / theirs);
      field_ratios["all"].push_back(ours / theirs);
      cell_ratios[kind].push_back(ours / scanned);
      cell_ratios["all"].push_back(ours / scanned);
      std::printf("| %s | %s | %.1f | %zu of %zu | %zu | %.0f | %.1f | %.1f | %.1f | %.1f |\n", site.name.c_str(),
                  kind.c_str(), metres / static_cast<double>(motions.size()), exact, motions.size(), says_stock,
                  ours / 1e3, theirs / 1e3, ours / theirs, scanned / 1e3, ours / scanned);
      std::fflush(stdout);
    }
  }
  std::printf(
      "\n| motions | stock by distance field: least ratio | quartile | median | quartile | stock by cells: "
      "least | quartile | median | quartile |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  for (const auto& [kind, ratios] : field_ratios) {
    std::printf("| %s |", kind.c_str());
    for (const auto& values : {ratios, cell_ratios[kind]})
      for (const double share : {0.0, 0.25, 0.5, 0.75}) std::printf(" %.1f |", quantile(values, share));
    std::printf("\n");
  }
}

constexpr const char* kDefault = "default";

std::string with_algorithm(const Settings& settings, const std::string& algorithm) {
  if (algorithm == kDefault) return "{" + settings.module_settings + "}";
  return "{algorithm: " + algorithm + (settings.module_settings.empty() ? "" : ", " + settings.module_settings) + "}";
}

struct QualityResult {
  std::size_t pairs = 0;
  std::size_t unsolved = 0;  // by us
  std::size_t reached = 0;   // by the stock planner, within the limit
  std::size_t no_path = 0;   // of the stock planner's at all
  std::vector<double> ours_ms;
  std::vector<double> stock_ms;
  std::vector<double> ratios;
  std::vector<double> lengths;  // the stock planner's last / ours
};

void compare_quality(const Site& site, const GridRouter& router, const StockOmpl& stock, const std::string& planner,
                     const StraightMotion& ends, double limit_s, QualityResult& sum) {
  const TimedPlan ours = timed_plan(router, ends.first, ends.second);
  ++sum.pairs;
  if (ours.result.outcome != PlanOutcome::solved) {
    ++sum.unsolved;
    std::fprintf(stderr, "%s: %s\n", site.name.c_str(), ours.result.reason.c_str());
    return;
  }
  const StockAnswer theirs = stock.solve(planner, ends, kEnough_ratio * ours.result.length_m, limit_s);
  if (!theirs.exact) ++sum.no_path;
  const bool reached = theirs.exact && theirs.length_m <= kEnough_ratio * ours.result.length_m;
  if (reached) ++sum.reached;
  sum.ours_ms.push_back(ours.took_ms);
  sum.stock_ms.push_back(1e3 * theirs.took_s);
  sum.ratios.push_back(1e3 * (reached ? theirs.took_s : limit_s) / ours.took_ms);
  if (theirs.exact) sum.lengths.push_back(theirs.length_m / ours.result.length_m);
}

QualityResult quality_of(const std::vector<Site>& sites, const Settings& settings, const std::string& ours,
                         const std::string& planner) {
  QualityResult sum;
  for (const Site& site : sites) {
    std::mt19937_64 random(settings.seed);
    const GridRouter router(site.grid, kRadius_m, with_algorithm(settings, ours));
    const StockOmpl stock(site.space, kRadius_m, 0.5 * site.grid.cell_m());
    const std::vector<StraightMotion> pairs = site.random_pairs(settings.pairs, random);
    static_cast<void>(router.plan(pairs.front().first, pairs.front().second));  // makes what the map's others use
    for (const StraightMotion& ends : pairs) compare_quality(site, router, stock, planner, ends, settings.limit_s, sum);
  }
  return sum;
}

void print_quality(const Settings& settings) {
  std::printf(
      "| ours | stock | pairs | ours, median ms | p95 | stock, median ms | got there | no path at all | ratio of "
      "times: quartile | median | quartile | stock's length / ours at the end, median |\n"
      "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  const std::vector<Site> sites = sites_of(settings);
  for (const bool same : {false, true})
    for (const std::string planner : {"RRTConnect", "BITstar", "InformedRRTstar", "RRTstar"}) {
      const std::string ours = same ? planner : kDefault;
      const QualityResult sum = quality_of(sites, settings, ours, planner);
      std::printf("| %s | %s | %zu | %.2f | %.2f | %.0f | %zu | %zu | %.1f | %.1f | %.1f | %.3f |\n", ours.c_str(),
                  planner.c_str(), sum.pairs - sum.unsolved, quantile(sum.ours_ms, 0.5), quantile(sum.ours_ms, 0.95),
                  quantile(sum.stock_ms, 0.5), sum.reached, sum.no_path, quantile(sum.ratios, 0.25),
                  quantile(sum.ratios, 0.5), quantile(sum.ratios, 0.75), quantile(sum.lengths, 0.5));
      if (sum.unsolved > 0) std::printf("%zu pairs not solved by ours\n", sum.unsolved);
      std::fflush(stdout);
    }
}

struct Cuts {
  std::size_t exact = 0;
  std::size_t touch = 0;  // the disc
  std::size_t cross = 0;  // even its centre, which enters a cell that is not free
};

void count_cuts(const PlainCells& cells, const std::vector<Point>& path, Cuts& cuts) {
  ++cuts.exact;
  const double near_m = distance_to_closed_m(cells, path, kRadius_m);
  if (near_m < kRadius_m - 1e-6) ++cuts.touch;
  if (near_m <= 0.0) ++cuts.cross;
}

void print_cuts(const Settings& settings) {
  std::printf(
      "| map | planner | stock's step, m | pairs | stock: exact | of these the disc touches | its centre crosses "
      "| ours: solved | touches | crosses |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  for (const Site& site : sites_of(settings)) {
    const PlainCells cells = plain_cells(site.grid);
    const StockOmpl stock(site.space, kRadius_m, 0.0);
    const GridRouter router(site.grid, kRadius_m, with_algorithm(settings, kDefault));
    for (const std::string planner : {"RRTConnect", "BITstar"}) {
      std::mt19937_64 random(settings.seed);
      Cuts theirs;
      Cuts ours;
      for (const StraightMotion& ends : site.random_pairs(settings.pairs, random)) {
        const double enough_m = planner == std::string("RRTConnect") ? 1e9 : 0.0;
        const StockAnswer answer = stock.solve(planner, ends, enough_m, settings.limit_s);
        if (answer.exact) count_cuts(cells, answer.path, theirs);
        const PlanResult result = router.plan(ends.first, ends.second);
        if (result.outcome == PlanOutcome::solved) count_cuts(cells, points_of(result), ours);
      }
      std::printf("| %s | %s | %.2f | %zu | %zu | %zu | %zu | %zu | %zu | %zu |\n", site.name.c_str(), planner.c_str(),
                  stock.step_m(), settings.pairs, theirs.exact, theirs.touch, theirs.cross, ours.exact, ours.touch,
                  ours.cross);
      std::fflush(stdout);
    }
  }
}

Settings settings_of(int count, char** arguments) {
  Settings settings;
  if (count < 2) throw std::invalid_argument("usage: stock_table motions|quality|cuts [--OPTION VALUE ...]");
  settings.table = arguments[1];
  for (int i = 2; i < count; i += 2) {
    const std::string name = arguments[i];
    if (i + 1 == count) throw std::invalid_argument(name + " needs a value");
    const std::string value = arguments[i + 1];
    if (name == "--pairs") {
      settings.pairs = std::stoul(value);
    } else if (name == "--seed") {
      settings.seed = std::stoull(value);
    } else if (name == "--limit") {
      settings.limit_s = std::stod(value);
    } else if (name == "--settings") {
      settings.module_settings = value;
    } else if (name == "--maps") {
      std::istringstream words(value);
      for (std::string map; std::getline(words, map, ',');) settings.maps.push_back(map);
    } else {
      throw std::invalid_argument("unknown option " + name +
                                  "; there are --pairs, --seed, --limit, --maps, --settings");
    }
  }
  return settings;
}

void print_table(const Settings& settings) {
  if (settings.table == "motions") return print_motions(settings);
  if (settings.table == "quality") return print_quality(settings);
  if (settings.table == "cuts") return print_cuts(settings);
  throw std::invalid_argument("unknown table " + settings.table + "; there are motions, quality and cuts");
}

}  // namespace
}  // namespace cairn

int main(int count, char** arguments) {
  try {
    cairn::print_table(cairn::settings_of(count, arguments));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stock_table: %s\n", error.what());
    return 2;
  }
}
