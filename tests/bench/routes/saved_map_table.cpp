// What a large saved map costs: 4000 x 4000 cells with 10,000 landmarks and their routes.
//   saved_map_table FOLDER [SIDE_CELLS [LANDMARKS [SEED]]]
// Two grids of one building, rooms with doors: one of three values, as other tools' maps have it, and one as it is
// sensed, where what was seen less often is less sure. The maps stay in the folder. The first answer is that of a
// `cairn plan` of its own, with starting the program.

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <random>

#include "framework/contracts/budget.hpp"
#include "maps/store/map_store.hpp"
#include "planners/common/any_angle/disc_routes.hpp"
#include "planners/common/disc_space/routes.hpp"
#include "tests/bench/routes/random_rooms.hpp"

namespace cairn {
namespace {

constexpr double kRadius_m = 0.22;
constexpr double kNear_m = 12.0;       // landmarks so near to each other are joined
constexpr double kDetour_ratio = 1.3;  // of routes, at most
constexpr int kAnswers = 11;

using Clock = Budget::Clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

struct Site {
  int side_cells = 4000;
  std::size_t landmarks = 10'000;
  std::uint64_t seed = 1;
};

// Free and occupied for sure, or each as sure as the readings that happened to fall on it make it.
OccupancyGrid grid_of(const PlainCells& cells, bool as_sensed, std::uint64_t seed) {
  OccupancyGrid grid(cells.cell_m, 4.0, cells.origin_m);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> evidence(1200.0, 500.0);
  for (int y = 0; y < cells.height; ++y)
    for (int x = 0; x < cells.width; ++x) {
      const double sure = as_sensed ? std::clamp(evidence(random), 160.0, 1024.0) : 900.0;
      grid.set_log_odds({x, y}, static_cast<LogOdds>(cells.is_open(x, y) ? -sure : sure));
    }
  return grid;
}

class Landmarks {
 public:
  Landmarks(const DiscRoutes& routes, const std::vector<Cell>& open, const Site& site)
      : routes_(routes), open_(open), site_(site) {}

  LandmarkGraph graph() {
    LandmarkGraph graph;
    std::mt19937_64 random(site_.seed + 1);
    std::uniform_int_distribution<std::size_t> any(0, open_.size() - 1);
    const DistanceField& field = routes_.space().field();
    while (graph.landmarks().size() < site_.landmarks) {
      const Point at = field.centre_of(open_[any(random)]);
      if (!routes_.space().fits(at, routes_.radius_m())) continue;
      Landmark landmark;
      landmark.category = "square";
      landmark.T_map_landmark = {at.x(), at.y(), 0.0};
      landmark.access = landmark.T_map_landmark;
      landmark.degree = 0.7;
      landmark.sightings = 3;
      graph.add(landmark);
    }
    for (const auto& [id, landmark] : graph.landmarks()) join(graph, landmark);
    return graph;
  }

 private:
  void join(LandmarkGraph& graph, const Landmark& from) const {
    std::array<std::vector<std::pair<double, LandmarkId>>, 4> near;  // by quarter
    const Point at = from.access->position();
    for (const auto& [id, other] : graph.landmarks()) {
      const Point off = other.access->position() - at;
      if (id != from.id && off.norm() < kNear_m)
        near[(off.x() > 0.0 ? 1 : 0) + (off.y() > 0.0 ? 2 : 0)].emplace_back(off.norm(), id);
    }
    for (auto& quarter : near) {
      std::sort(quarter.begin(), quarter.end());
      for (const auto& [away_m, id] : quarter) {
        const DiscRoute found = routes_.route(at, graph.find(id)->access->position(), Budget{});
        if (found.route.empty() || length_of(found.route) > kDetour_ratio * away_m) continue;
        graph.add_route(route_along(found.route, from.id, id));
        break;
      }
    }
  }
  // The corners, as missions leave them.
  static Route route_along(const std::vector<Point>& corners, LandmarkId from, LandmarkId to) {
    Route route;
    route.from = from;
    route.to = to;
    route.cost_m = length_of(corners);
    route.trajectory = in_whole_steps(poses_along(corners, 0.0, std::nullopt));

    return route;
  }

  const DiscRoutes& routes_;
  const std::vector<Cell>& open_;
  const Site& site_;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// Seconds of the whole command.
std::vector<double> first_answers(const std::string& map, const LandmarkGraph& graph, bool near, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<LandmarkId> any(1, static_cast<LandmarkId>(graph.landmarks().size()));
  std::vector<double> seconds;
  for (int i = 0; i < kAnswers; ++i) {
    const LandmarkId from = any(random);
    LandmarkId to = any(random);
    if (near && !graph.routes_from(from).empty()) to = graph.find_route(graph.routes_from(from).front())->to;
    const std::string command = std::string(CAIRN_BINARY_DIR "/bin/cairn plan ") + map + " --from L" +
                                std::to_string(from) + " --to L" + std::to_string(to) + " --json > /dev/null 2>&1";
    const auto begin = Clock::now();
    const int status = std::system(command.c_str());
    seconds.push_back(seconds_since(begin));
    if (status != 0) std::fprintf(stderr, "%s: status %d\n", command.c_str(), status);
  }
  return seconds;
}

void measure(const std::filesystem::path& file, const SavedMap& map, const Site& site) {
  double saved_s = 1e9;
  for (int run = 0; run < 3; ++run) {
    const auto begin = Clock::now();
    save_map(file, map);
    saved_s = std::min(saved_s, seconds_since(begin));
  }
  double copied_s = 1e9;  // what a mission waits for when its map is autosaved
  for (int run = 0; run < 3; ++run) {
    const auto begin = Clock::now();
    const SavedMap copy = map;
    copied_s = std::min(copied_s, seconds_since(begin));
    if (copy.grid.bounds() != map.grid.bounds()) std::abort();
  }
  const auto begin = Clock::now();
  const bool same = load_map(file).grid == map.grid;
  const double loaded_s = seconds_since(begin);
  const double raw = 2.0 * site.side_cells * site.side_cells;
  const double bytes = static_cast<double>(std::filesystem::file_size(file));
  const std::vector<double> far = first_answers(file.string(), map.graph, false, site.seed + 2);
  const std::vector<double> near = first_answers(file.string(), map.graph, true, site.seed + 3);
  std::printf("| %s | %.2f | %.3f | %.1f | %.1f | %.2f | %.2f | %.2f | %.2f | %.2f |%s\n", file.stem().c_str(), saved_s,
              copied_s, bytes / 1e6, 100.0 * bytes / raw, loaded_s, median(near),
              *std::max_element(near.begin(), near.end()), median(far), *std::max_element(far.begin(), far.end()),
              same ? "" : " DIFFERENT");
  std::fflush(stdout);
}

int run(const std::filesystem::path& folder, const Site& site) {
  std::filesystem::create_directories(folder);
  RoomsShape shape;
  shape.side_cells = site.side_cells;
  shape.room_cells = 79;
  shape.door_cells = 20;
  shape.cell_m = 0.05;
  const PlainCells cells = random_rooms(shape, site.seed);
  SavedMap map;
  map.properties["robot_radius_m"] = std::to_string(kRadius_m);
  map.grid = grid_of(cells, false, site.seed);
  {
    const DiscRoutes routes(std::make_shared<const DiscSpace>(map.grid, GroundRules{}), kRadius_m + kMaxRounding_m);
    map.graph = Landmarks(routes, largest_part(cells), site).graph();
  }
  std::printf("%zu landmarks, %zu routes\n\n", map.graph.landmarks().size(), map.graph.routes().size());
  std::printf(
      "| map | saved, s | copied, s | MB | %% of raw | loaded, s | near answer, s | worst | far answer, s | worst |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|\n");
  measure(folder / "three_values.cairn", map, site);
  map.grid = grid_of(cells, true, site.seed);
  measure(folder / "as_sensed.cairn", map, site);
  return 0;
}

}  // namespace
}  // namespace cairn

int main(int argc, char** argv) {
  if (argc < 2 || argc > 5) {
    std::fprintf(stderr, "usage: saved_map_table FOLDER [SIDE_CELLS [LANDMARKS [SEED]]]\n");
    return 2;
  }
  try {
    cairn::Site site;
    if (argc > 2) site.side_cells = std::atoi(argv[2]);
    if (argc > 3) site.landmarks = static_cast<std::size_t>(std::atoi(argv[3]));
    if (argc > 4) site.seed = std::strtoull(argv[4], nullptr, 10);
    return cairn::run(argv[1], site);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
