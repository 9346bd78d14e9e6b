// What OMPL improves of legs that are counted by driving time, and what that takes, as a table in Markdown:
//   driving_table [--pairs N] [--seed S] [--maps depot,grid] [--saved FILE.cairn]...
// On the maps that missions have saved, on random rooms with doors of 0.7 to 0.9 m, on a building of a hundred metres
// with doors of 1 m, and on the occupancy grids of CAIRN_DATA. A leg's start is the best route that is known without
// OMPL (improve_iterations 0); each row improves it or searches alone. Driving times are counted anew, in steps of a
// quarter of a cell. Pairs are at random from all places that are joined.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <random>
#include <sstream>

#include "maps/store/map_store.hpp"
#include "planners/common/disc_space/driving_time.hpp"
#include "tests/bench/routes/grid_router.hpp"
#include "tests/bench/routes/occupancy_maps.hpp"
#include "tests/bench/routes/random_rooms.hpp"

namespace cairn {
namespace {

constexpr double kRadius_m = 0.22;
constexpr double kImproved_ratio = 1e-3;  // a leg counts as improved from here on
constexpr double kStep_cells = 0.25;
constexpr double kTouching_m = 0.01;

struct Settings {
  std::size_t pairs = 10;  // a map
  std::uint64_t seed = 1;
  std::vector<std::string> maps;  // empty: all
  std::vector<std::string> saved;
};

struct Leg {
  Point from{0.0, 0.0};
  Point to{0.0, 0.0};
  double ends_clearance_m = 0.0;  // of the nearer one
};

struct Site {
  std::string name;
  std::string group;
  OccupancyGrid grid;
  DiscSpace space;
  std::vector<Leg> legs;

  Site(std::string map_name, std::string map_group, OccupancyGrid map_grid, const Settings& settings)
      : name(std::move(map_name)), group(std::move(map_group)), grid(std::move(map_grid)), space(grid, GroundRules{}) {
    const CellBox box = grid.bounds();
    PlainCells fits{box.width(), box.height(), {}, {0.0, 0.0}, grid.cell_m()};
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x)
        fits.open.push_back(space.fits(grid.centre_of({x, y}), kRadius_m) ? 1 : 0);
    const std::vector<Cell> places = largest_part(fits);
    std::mt19937_64 random(settings.seed);
    const auto place = [&] { return grid.centre_of(places[random() % places.size()] + box.min); };
    while (places.size() > 1 && legs.size() < settings.pairs) {
      const Point from = place();
      const Point to = place();
      legs.push_back({from, to, std::min(space.distance_m(from, from), space.distance_m(to, to)) - kRadius_m});
    }
  }

  // By the speed law, in fine steps.
  [[nodiscard]] double seconds_of(const std::vector<Point>& route) const {
    RobotModel robot;
    robot.radius_m = kRadius_m;
    const LandmarkGraph none;
    WorldView world{grid, none, robot, {}};
    world.speed_law = SpeedLaw{};
    const DrivingRules rules = *driving_rules_of(world, kRadius_m, 0.0);
    double sum_s = 0.0;
    for (std::size_t i = 1; i < route.size(); ++i) {
      const Point along = route[i] - route[i - 1];
      const int steps = std::max(1, static_cast<int>(along.norm() / (kStep_cells * grid.cell_m())));
      for (int k = 0; k < steps; ++k)
        sum_s += driving_time_s(space.field(), route[i - 1] + along * k / steps, route[i - 1] + along * (k + 1) / steps,
                                rules);
    }
    return sum_s;
  }
};

struct Answer {
  double driving_s = 0.0;
  double took_ms = 0.0;
  bool touches = false;  // something, between ends that do not
  bool solved = false;
};

std::vector<Answer> answers_of(const Site& site, const std::string& settings) {
  RobotModel robot;
  robot.radius_m = kRadius_m;
  GridRouter router(site.grid, robot, settings);
  router.set_speed_law(SpeedLaw{});
  std::vector<Answer> answers;
  for (const Leg& leg : site.legs) {
    const TimedPlan plan = timed_plan(router, leg.from, leg.to);
    const std::vector<Point> route = points_of(plan.result);
    answers.push_back({site.seconds_of(route), plan.took_ms,
                       plan.result.clearance_m < kTouching_m && leg.ends_clearance_m >= kTouching_m,
                       plan.result.outcome == PlanOutcome::solved});
  }
  return answers;
}

// Of all legs of a group.
struct Row {
  std::size_t legs = 0;
  std::size_t unsolved = 0;
  std::size_t worse = 0;
  std::size_t touching = 0;
  std::vector<double> gains;     // share of the start's driving time
  std::vector<double> improved;  // those that count
  std::vector<double> took_ms;
  double start_s = 0.0;
  double driving_s = 0.0;

  void add(const Answer& start, const Answer& answer) {
    if (!start.solved) return;
    ++legs;
    took_ms.push_back(answer.took_ms);
    if (!answer.solved) {
      ++unsolved;
      return;
    }
    if (answer.touches) ++touching;
    start_s += start.driving_s;
    driving_s += answer.driving_s;
    const double gain = start.driving_s > 0.0 ? 1.0 - answer.driving_s / start.driving_s : 0.0;
    gains.push_back(gain);
    if (gain >= kImproved_ratio) improved.push_back(gain);
    if (gain <= -kImproved_ratio) ++worse;
  }
};

void print(const std::string& group, const std::string& how, const Row& row) {
  std::printf(
      "| %s | %s | %zu | %zu | %zu | %.0f | %zu | %.2f | %.2f | %.2f | %.2f | %.2f |\n", group.c_str(), how.c_str(),
      row.legs, row.unsolved, row.touching,
      100.0 * static_cast<double>(row.improved.size()) / static_cast<double>(std::max<std::size_t>(row.legs, 1)),
      row.worse, row.improved.empty() ? 0.0 : 100.0 * quantile(row.improved, 0.5),
      row.gains.empty() ? 0.0 : 100.0 * quantile(row.gains, 1.0), 100.0 * (1.0 - row.driving_s / row.start_s),
      quantile(row.took_ms, 0.5), quantile(row.took_ms, 0.95));
  std::fflush(stdout);
}

std::vector<Site> sites_of(const Settings& settings) {
  std::vector<Site> sites;
  const auto is_wanted = [&](const std::string& name) {
    return settings.maps.empty() || std::ranges::find(settings.maps, name) != settings.maps.end();
  };
  for (const std::string& file : settings.saved)
    sites.emplace_back(file, "saved by missions", load_map(file).grid, settings);
  for (const int door_cells : {14, 16, 18}) {
    RoomsShape rooms;
    rooms.side_cells = 512;
    rooms.room_cells = 79;
    rooms.door_cells = door_cells;
    rooms.cell_m = 0.05;
    if (is_wanted("rooms")) sites.emplace_back("rooms", "rooms", grid_of(random_rooms(rooms, settings.seed)), settings);
  }
  RoomsShape building;  // of a hundred metres
  building.side_cells = 2048;
  building.room_cells = 79;
  building.door_cells = 20;
  building.cell_m = 0.05;
  if (is_wanted("building"))
    sites.emplace_back("building", "building", grid_of(random_rooms(building, settings.seed)), settings);
  for (OccupancyMap& map : occupancy_maps())
    if (is_wanted(map.name)) sites.emplace_back(map.name, "occ_maps", std::move(map.grid), settings);
  return sites;
}

struct Way {
  std::string name;
  std::string settings;
};
std::vector<Way> ways() {
  std::vector<Way> all{{"shortest", "{objective: length}"}, {"start", "{improve_iterations: 0}"}};
  for (const char* iterations : {"50", "100", "300", "1000", "2000"})
    all.push_back({std::string("AnyAngleRRTstar, ") + iterations,
                   std::string("{good_enough_ratio: 1.001, improve_iterations: ") + iterations + "}"});
  for (const char* name : {"BITstar", "InformedRRTstar"})
    all.push_back({std::string(name) + " alone, 3000", std::string("{algorithm: ") + name + "}"});
  return all;
}

void print_table(const Settings& settings) {
  const std::vector<Site> sites = sites_of(settings);
  std::printf(
      "| maps | how | legs | unsolved | nearer than 1 cm, the ends not | improved %% | worse than the start | median "
      "of the "
      "improved %% | most %% | all legs together %% | median ms | p95 ms "
      "|\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  for (const std::string group : {"saved by missions", "rooms", "building", "occ_maps"}) {
    std::vector<std::pair<const Site*, std::vector<Answer>>> starts;
    for (const Site& site : sites)
      if (site.group == group) starts.emplace_back(&site, answers_of(site, "{improve_iterations: 0}"));
    if (starts.empty()) continue;
    for (const Way& way : ways()) {
      Row row;
      for (const auto& [site, start] : starts) {
        const std::vector<Answer> answers = answers_of(*site, way.settings);
        for (std::size_t i = 0; i < answers.size(); ++i) row.add(start[i], answers[i]);
      }
      print(group, way.name, row);
    }
  }
}

Settings settings_of(int count, char** arguments) {
  Settings settings;
  for (int i = 1; i < count; i += 2) {
    const std::string name = arguments[i];
    if (i + 1 == count) throw std::invalid_argument(name + " needs a value");
    const std::string value = arguments[i + 1];
    if (name == "--pairs") {
      settings.pairs = std::stoul(value);
    } else if (name == "--seed") {
      settings.seed = std::stoull(value);
    } else if (name == "--saved") {
      settings.saved.push_back(value);
    } else if (name == "--maps") {
      std::istringstream words(value);
      for (std::string map; std::getline(words, map, ',');) settings.maps.push_back(map);
    } else {
      throw std::invalid_argument("unknown option " + name + "; there are --pairs, --seed, --maps and --saved");
    }
  }
  return settings;
}

}  // namespace
}  // namespace cairn

int main(int count, char** arguments) {
  try {
    cairn::print_table(cairn::settings_of(count, arguments));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "driving_table: %s\n", error.what());
    return 2;
  }
}
