// Routes beside the plain ways to them, in the same run, on maps made by seed. Counters are what counts: ratios.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "tests/bench/routes/grid_router.hpp"
#include "tests/bench/routes/lazy_theta_star.hpp"
#include "tests/bench/routes/path_check.hpp"
#include "tests/bench/routes/random_rooms.hpp"
#include "tests/bench/routes/stock_ompl.hpp"

namespace cairn {
namespace {

constexpr double kRadius_m = 0.25;

double seconds_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// An office floor of 26 x 26 m at 0.05 m, with some clutter.
PlainCells office_floor() {
  RoomsShape shape;
  shape.room_cells = 63;
  shape.door_cells = 20;
  shape.clutter_ratio = 0.0003;
  shape.cell_m = 0.05;
  return random_rooms(shape, 1);
}

std::vector<StraightMotion> random_motions(const DiscSpace& space, const std::vector<Cell>& places, std::size_t count,
                                           double max_m) {
  std::mt19937_64 random(2);
  std::vector<StraightMotion> motions;
  while (motions.size() < count) {
    const Point a = space.field().centre_of(places[random() % places.size()]);
    const Point b = space.field().centre_of(places[random() % places.size()]);
    if ((b - a).norm() <= max_m && space.fits(a, kRadius_m) && space.fits(b, kRadius_m)) motions.emplace_back(a, b);
  }
  return motions;
}

// Motions of a disc of 0.25 m up to so many metres long, against OMPL's discrete validator at half a cell.
void motion_checks(benchmark::State& state) {
  const PlainCells floor = office_floor();
  const OccupancyGrid grid = grid_of(floor);
  const DiscSpace space(grid, GroundRules{});
  const auto motions = random_motions(space, largest_part(floor), 2000, static_cast<double>(state.range(0)));
  const StockOmpl by_field(space, kRadius_m, 0.025);
  const StockOmpl by_cells(space, kRadius_m, 0.025, StockValidity::by_cells);
  std::size_t free = 0;
  double ours_s = 0.0;
  for (auto _ : state) {
    const double took_s = seconds_of([&] {
      free = static_cast<std::size_t>(std::count_if(motions.begin(), motions.end(), [&](const StraightMotion& m) {
        return space.fits_along(m.first, m.second, kRadius_m);
      }));
    });
    ours_s += took_s;
    state.SetIterationTime(took_s);
  }
  ours_s /= static_cast<double>(state.iterations());
  const auto count = static_cast<double>(motions.size());
  state.counters["checks_per_s"] = count / ours_s;
  state.counters["free_ratio"] = static_cast<double>(free) / count;
  const auto ratio_of = [&](const StockOmpl& stock) {
    return seconds_of([&] { benchmark::DoNotOptimize(stock.count_valid(motions)); }) / ours_s;
  };
  state.counters["times_faster_than_stock"] = ratio_of(by_field);
  state.counters["than_stock_by_cells"] = ratio_of(by_cells);
}
BENCHMARK(motion_checks)->Arg(3)->Arg(30)->UseManualTime()->Unit(benchmark::kMillisecond);

// 512 x 512 cells of 1 m for a point, as the Moving AI benchmarks have them.
PlainCells rooms_512(double clutter_ratio) {
  RoomsShape shape;
  shape.clutter_ratio = clutter_ratio;
  return random_rooms(shape, 3);
}

void route(benchmark::State& state) {
  const PlainCells cells = rooms_512(0.01 * static_cast<double>(state.range(0)));
  const std::vector<Cell> places = largest_part(cells);
  const GridRouter router(grid_of(cells), 0.0);
  PlainSearches plain(cells);
  std::mt19937_64 random(4);
  std::vector<std::pair<Cell, Cell>> pairs;
  for (int i = 0; i < 40; ++i) pairs.emplace_back(places[random() % places.size()], places[random() % places.size()]);
  static_cast<void>(router.plan(cells.centre_m(pairs[0].first), cells.centre_m(pairs[0].second)));
  std::vector<double> ours_ms;
  std::vector<double> lazy_ms;
  double ours_m = 0.0;
  double lazy_m = 0.0;
  double faults = 0.0;
  for (auto _ : state) {
    double took_s = 0.0;
    for (const auto& [from, to] : pairs) {
      const TimedPlan ours = timed_plan(router, cells.centre_m(from), cells.centre_m(to));
      took_s += 1e-3 * ours.took_ms;
      ours_ms.push_back(ours.took_ms);
      PlainPath lazy;
      lazy_ms.push_back(1e3 * seconds_of([&] { lazy = plain.lazy_theta_star(from, to); }));
      const std::vector<Point> path = points_of(ours.result);
      if (!fault_of_point_path(cells, path, cells.centre_m(from), cells.centre_m(to)).empty()) faults += 1.0;
      ours_m += length_of_m(path);
      lazy_m += lazy.length;
    }
    state.SetIterationTime(took_s / static_cast<double>(pairs.size()));
  }
  state.counters["median_ms"] = quantile(ours_ms, 0.5);
  state.counters["p99_ms"] = quantile(ours_ms, 0.99);
  state.counters["lazy_theta_star_median_ms"] = quantile(lazy_ms, 0.5);
  state.counters["times_faster"] = quantile(lazy_ms, 0.5) / quantile(ours_ms, 0.5);
  state.counters["length_to_lazy_theta_star"] = ours_m / lazy_m;
  state.counters["faults"] = faults;
}
BENCHMARK(route)->Arg(0)->Arg(10)->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);

// To a place in a room without a door.
void no_route(benchmark::State& state) {
  RoomsShape shape;
  shape.side_cells = static_cast<int>(state.range(0));
  shape.door_ratio = 0.5;
  const PlainCells cells = random_rooms(shape, 5);
  const std::vector<std::int32_t> part = parts_of(cells);
  const std::vector<Cell> places = largest_part(cells);
  const std::int32_t largest = part[cells.index(places[0].x, places[0].y)];
  std::vector<Cell> elsewhere;
  for (int y = 0; y < cells.height; ++y)
    for (int x = 0; x < cells.width; ++x)
      if (cells.is_open(x, y) && part[cells.index(x, y)] != largest) elsewhere.push_back({x, y});
  const GridRouter router(grid_of(cells), 0.0);
  static_cast<void>(router.plan(cells.centre_m(places.front()), cells.centre_m(places.back())));
  std::mt19937_64 random(6);
  std::vector<double> took_ms;
  double wrong = 0.0;
  for (auto _ : state) {
    const TimedPlan ours = timed_plan(router, cells.centre_m(places[random() % places.size()]),
                                      cells.centre_m(elsewhere[random() % elsewhere.size()]));
    if (ours.result.outcome != PlanOutcome::no_route) wrong += 1.0;
    took_ms.push_back(ours.took_ms);
    state.SetIterationTime(1e-3 * ours.took_ms);
  }
  state.counters["longest_ms"] = quantile(took_ms, 1.0);
  state.counters["wrong"] = wrong;
}
BENCHMARK(no_route)->Arg(512)->Arg(1024)->UseManualTime()->Iterations(200)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cairn
