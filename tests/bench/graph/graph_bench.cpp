// The landmark graph from a hundred landmarks to a million: queries beside Boost.Graph's in the same run, building,
// memory, changes. Ratios are what counts.

#include <benchmark/benchmark.h>
#include <malloc.h>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <random>
#include <string>

#include "maps/pictures/drawing/chart.hpp"
#include "planners/landmark_search/hierarchy_search.hpp"
#include "tests/bench/graph/boost_searches.hpp"
#include "tests/bench/graph/building_complex.hpp"

namespace cairn {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kFloor_m = 4.0;
constexpr std::uint64_t kSeed = 2;  // the sizes of clusters were chosen with another

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double median(const std::vector<double>& values) {
  return quantile(values, 0.5);
}

// Pairs of landmarks, the same ones every time.
std::vector<std::pair<LandmarkId, LandmarkId>> random_pairs(const LandmarkGraph& graph, std::size_t count) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<LandmarkId> any(1, static_cast<LandmarkId>(graph.landmarks().size()));
  std::vector<std::pair<LandmarkId, LandmarkId>> pairs;
  while (pairs.size() < count) {
    const std::pair<LandmarkId, LandmarkId> pair(any(random), any(random));
    if (pair.first != pair.second) pairs.push_back(pair);
  }
  return pairs;
}

// The complex of a size and its hierarchy; only the last one that was asked for is kept.
struct Site {
  explicit Site(std::size_t landmarks)
      : asked_for(landmarks), graph(building_complex(landmarks, kSeed)), hierarchy(graph) {}
  std::size_t asked_for;
  LandmarkGraph graph;
  Hierarchy hierarchy;
};

std::unique_ptr<Site>& kept_site() {
  static std::unique_ptr<Site> site;
  return site;
}

Site& site_of(std::size_t landmarks) {
  std::unique_ptr<Site>& site = kept_site();
  if (site == nullptr || site->asked_for != landmarks) {
    site.reset();
    site = std::make_unique<Site>(landmarks);
  }
  return *site;
}

void drop_site() {
  kept_site().reset();
}

struct Timings {
  std::vector<double> us, settled;
  template <class Search>
  void time(Search search) {
    const auto begin = Clock::now();
    const std::int64_t count = search();
    us.push_back(1e6 * seconds_since(begin));
    settled.push_back(static_cast<double>(count));
  }
  // What all cores of the machine work on it, so that the longest is not what some other program did meanwhile.
  template <class Work>
  void time_work(Work work) {
    const std::clock_t begin = std::clock();
    work();
    us.push_back(1e6 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
};

// Median time of a query by size, for a chart.
struct Growth {
  std::vector<Point> ours, dijkstra, astar;
};
Growth& growth() {
  static Growth all;
  return all;
}

void query(benchmark::State& state) {
  const Site& site = site_of(static_cast<std::size_t>(state.range(0)));
  BoostSearches boost(site.graph, kFloor_m);
  HierarchySearch search;
  const auto pairs = random_pairs(site.graph, static_cast<std::size_t>(state.range(1)));
  Timings ours, dijkstra, astar;
  const auto find = [&](const std::pair<LandmarkId, LandmarkId>& pair) {
    const Network& network = site.hierarchy.network();
    const RouteQuery query{{{network.vertex_of(pair.first)}}, {{network.vertex_of(pair.second)}}, {}, {}};
    const GraphPath path = search.find(site.hierarchy, query, {});
    benchmark::DoNotOptimize(path.routes.data());
    return path.settled;
  };
  for (auto _ : state) {
    for (const auto& pair : pairs) ours.time([&] { return find(pair); });
    for (const auto& [from, to] : pairs) dijkstra.time([&] { return boost.dijkstra(from, to), boost.settled(); });
    for (const auto& [from, to] : pairs) astar.time([&] { return boost.astar(from, to), boost.settled(); });
    state.SetIterationTime(1e-6 * median(ours.us));
  }
  const auto size = static_cast<double>(state.range(0));
  growth().ours.emplace_back(size, median(ours.us));
  growth().dijkstra.emplace_back(size, median(dijkstra.us));
  growth().astar.emplace_back(size, median(astar.us));
  state.counters["levels"] = site.hierarchy.levels();
  state.counters["us"] = median(ours.us);
  state.counters["us_p95"] = quantile(ours.us, 0.95);
  state.counters["us_max"] = quantile(ours.us, 1.0);
  state.counters["dijkstra_us"] = median(dijkstra.us);
  state.counters["astar_us"] = median(astar.us);
  state.counters["dijkstra_ratio"] = median(dijkstra.us) / median(ours.us);
  state.counters["astar_ratio"] = median(astar.us) / median(ours.us);
  state.counters["settled"] = median(ours.settled);
  state.counters["dijkstra_settled"] = median(dijkstra.settled);
  state.counters["astar_settled"] = median(astar.settled);
}

// What it takes until a change of the graph is in service, and back again.
class Changes {
 public:
  explicit Changes(Site& site) : site_(site) {
    for (const auto& [id, route] : site.graph.routes()) routes_.push_back(id);
  }

  void change_costs(std::size_t count, Timings& changed) {
    for (std::size_t i = 0; i < count; ++i) {
      const RouteId id = any_route();
      const double cost_m =
          site_.graph.find_route(id)->cost_m * std::uniform_real_distribution<double>(0.5, 2.0)(random_);
      changed.time_work([&] {
        site_.graph.set_cost(id, cost_m);
        site_.hierarchy.update(site_.graph, {{}, {id}});
      });
    }
  }
  void add_and_remove_routes(std::size_t count, Timings& added, Timings& removed) {
    for (std::size_t i = 0; i < count; ++i) {
      RouteId id = 0;
      added.time_work([&] {
        id = site_.graph.add_route(shortcut());
        site_.hierarchy.update(site_.graph, {{}, {id}});
      });
      removed.time_work([&] {
        site_.graph.remove_route(id);
        site_.hierarchy.update(site_.graph, {{}, {id}});
      });
    }
  }
  void add_and_remove_landmarks(std::size_t count, Timings& added, Timings& removed) {
    for (std::size_t i = 0; i < count; ++i) {
      const Route beside = *site_.graph.find_route(any_route());
      LandmarkId id = 0;
      added.time_work([&] {
        id = site_.graph.add(copy_of(beside.from));
        for (const auto& [from, to] : {std::pair(beside.from, id), std::pair(id, beside.to)})
          site_.graph.add_route(route(from, to, beside.cost_m));
        site_.hierarchy.update(site_.graph, {{id}, {}});
      });
      removed.time_work([&] {
        site_.graph.remove(id);
        site_.hierarchy.update(site_.graph, {{id}, {}});
      });
    }
  }

 private:
  RouteId any_route() { return routes_[std::uniform_int_distribution<std::size_t>(0, routes_.size() - 1)(random_)]; }
  [[nodiscard]] Landmark copy_of(LandmarkId id) const {
    Landmark copy = *site_.graph.find(id);
    copy.id = 0;
    return copy;
  }
  static Route route(LandmarkId from, LandmarkId to, double cost_m) {
    Route made;
    made.from = from;
    made.to = to;
    made.cost_m = cost_m;
    return made;
  }
  // Past the end of a route to the end of the next one.
  Route shortcut() {
    const Route& first = *site_.graph.find_route(any_route());
    const auto& next = site_.graph.routes_from(first.to);
    const Route& second = next.empty() ? first : *site_.graph.find_route(next.back());
    return route(first.from, second.to, 0.9 * (first.cost_m + second.cost_m));
  }

  Site& site_;
  std::mt19937_64 random_{11};
  std::vector<RouteId> routes_;
};

void change(benchmark::State& state) {
  Changes changes(site_of(static_cast<std::size_t>(state.range(0))));
  Timings cost, route_added, route_removed, landmark_added, landmark_removed;
  for (auto _ : state) {
    changes.change_costs(500, cost);
    changes.add_and_remove_routes(200, route_added, route_removed);
    changes.add_and_remove_landmarks(200, landmark_added, landmark_removed);
    state.SetIterationTime(1e-6 * median(cost.us));
  }
  const auto count = [&](const std::string& name, const Timings& timings) {
    state.counters[name + "_us"] = median(timings.us);
    state.counters[name + "_us_p95"] = quantile(timings.us, 0.95);
    state.counters[name + "_us_max"] = quantile(timings.us, 1.0);
  };
  count("cost", cost);
  count("route_added", route_added);
  count("route_removed", route_removed);
  count("landmark_added", landmark_added);
  count("landmark_removed", landmark_removed);
}

// Of this process, in MB: "VmRSS", "VmHWM" (the highest since the last reset).
double memory_mb(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":")) return std::stod(line.substr(name.size() + 1)) * 1024.0 / 1e6;
  return 0.0;
}

void reset_highest_memory() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;
}

void use_cores(int count) {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  for (int i = 0; i < count; ++i) CPU_SET(i, &cores);
  sched_setaffinity(0, sizeof(cores), &cores);
}

// The steps of Hierarchy's own making, each by itself.
void build(benchmark::State& state) {
  drop_site();
  reset_highest_memory();
  const double before_mb = memory_mb("VmRSS");
  const LandmarkGraph graph = building_complex(static_cast<std::size_t>(state.range(0)), kSeed);
  const double graph_mb = memory_mb("VmRSS") - before_mb;
  use_cores(static_cast<int>(state.range(1)));
  for (auto _ : state) {
    const auto begin = Clock::now();
    const Network network(graph, cost_by_length);
    const double network_s = seconds_since(begin);
    const Clustering clustering(network, {});
    const double clustering_s = seconds_since(begin) - network_s;
    Overlay overlay;
    overlay.build(network, clustering);
    const double all_s = seconds_since(begin);
    state.SetIterationTime(all_s);
    state.counters["network_s"] = network_s;
    state.counters["clustering_s"] = clustering_s;
    state.counters["ways_s"] = all_s - clustering_s - network_s;
    state.counters["ways_mb"] = static_cast<double>(overlay.bytes()) / 1e6;
    state.counters["hierarchy_mb"] = memory_mb("VmRSS") - before_mb - graph_mb;
    state.counters["peak_mb"] = memory_mb("VmHWM");
  }
  state.counters["graph_mb"] = graph_mb;
  use_cores(CPU_SETSIZE);
}

void add_rows(std::int64_t landmarks, std::int64_t pairs) {
  benchmark::RegisterBenchmark("query", query)
      ->Args({landmarks, pairs})
      ->Iterations(1)
      ->UseManualTime()
      ->Unit(benchmark::kMicrosecond);
  benchmark::RegisterBenchmark("change", change)
      ->Arg(landmarks)
      ->Iterations(1)
      ->UseManualTime()
      ->Unit(benchmark::kMicrosecond);
  for (const std::int64_t cores : {1, 2})
    benchmark::RegisterBenchmark("build", build)
        ->Args({landmarks, cores})
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
}

// Whether it was drawn.
bool draw_growth(const std::string& file) {
  Chart chart;
  chart.title = "A query over the landmark graph, median";
  chart.x_label = "landmarks";
  chart.y_label = "microseconds";
  chart.log_x = chart.log_y = true;
  chart.series = {{"Dijkstra", growth().dijkstra, SeriesStyle::lines_and_points, {}},
                  {"A*", growth().astar, SeriesStyle::lines_and_points, {}},
                  {"landmark_search", growth().ours, SeriesStyle::lines_and_points, {}}};
  const ChartOutcome outcome = write_chart(file, chart);
  if (!outcome.drawn) std::fprintf(stderr, "graph_bench: %s\n", outcome.reason.c_str());
  return outcome.drawn;
}

}  // namespace
}  // namespace cairn

// After the options of all benches: a file for the chart of growth, if wanted.
int main(int count, char** arguments) {
  benchmark::Initialize(&count, arguments);
  if (count > 2) {
    std::fprintf(stderr, "usage: graph_bench [--benchmark_...] [CHART.png]\n");
    return 2;
  }
  for (const auto& [landmarks, pairs] : {std::pair(100, 5000), std::pair(1000, 5000), std::pair(10'000, 2000),
                                         std::pair(100'000, 500), std::pair(1'000'000, 300)})
    cairn::add_rows(landmarks, pairs);
  benchmark::RunSpecifiedBenchmarks();
  return count < 2 || cairn::draw_growth(arguments[1]) ? 0 : 1;
}
