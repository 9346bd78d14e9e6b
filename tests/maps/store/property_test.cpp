// Laws of saving and loading, over random maps with values from the ends of their ranges.
#include <limits>

#include "maps/hierarchy/hierarchy.hpp"
#include "maps/store/repair.hpp"
#include "tests/maps/store/store_fixture.hpp"

namespace cairn {
namespace {

class RandomMap {
 public:
  explicit RandomMap(std::uint64_t seed) : random_(seed) {}

  SavedMap make() {
    SavedMap map;
    map.grid = grid();
    for (std::int64_t i = below(40); i > 0; --i) map.graph.add(landmark());
    for (std::int64_t i = below(60); i > 0 && !map.graph.landmarks().empty(); --i)
      map.graph.add_route(route(map.graph));
    for (std::int64_t i = below(6); i > 0; --i)
      if (const Landmark* gone = map.graph.find(1 + below(40)); gone != nullptr) map.graph.retire(gone->id, text());
    map.clusters = Hierarchy(map.graph, {}, cost_by_length, ClusterSizes{4, 2, 8}).tree();
    for (auto& [id, cluster] : map.clusters.clusters) cluster.name = text();
    for (std::int64_t i = below(5); i > 0; --i) map.shapes.push_back(shape());
    for (std::int64_t i = below(50); i > 0; --i) map.driven_path.push_back(pose());
    for (std::int64_t i = below(6); i > 0; --i) map.properties[text()] = text();
    if (below(2) == 0) map.progress = progress();
    return map;
  }

 private:
  std::int64_t below(std::int64_t end) {
    return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(end));
  }

  double number() {
    using Limits = std::numeric_limits<double>;
    constexpr double kExtremes[] = {0.0,
                                    -0.0,
                                    Limits::max(),
                                    Limits::lowest(),
                                    Limits::min(),
                                    Limits::denorm_min(),
                                    Limits::epsilon(),
                                    1.0 / 3.0,
                                    -1e-300,
                                    1e9};
    if (below(3) == 0) return kExtremes[below(std::size(kExtremes))];
    return static_cast<double>(static_cast<std::int64_t>(random_())) * 1e-15;
  }
  Pose2 pose() {
    const double x_m = number();
    const double y_m = number();
    return {x_m, y_m, number()};
  }
  std::string text() {
    constexpr const char* kTexts[] = {"", "a", "'; DROP TABLE landmarks; --", "\xC3\xA4 \xF0\x9F\x97\xBA",
                                      "two\nlines"};
    if (below(2) == 0) return kTexts[below(std::size(kTexts))];
    return std::string(static_cast<std::size_t>(below(9000)), static_cast<char>('a' + below(26)));
  }
  std::string annotations() { return below(2) == 0 ? "" : R"({"x":[1,{"y":null}]})"; }

  OccupancyGrid grid() {
    constexpr double kClamps[] = {1.0 / 256.0, 4.0, 127.0};
    constexpr double kCells[] = {1e-6, 0.05, 1000.0};
    OccupancyGrid grid(kCells[below(3)], kClamps[below(3)], {static_cast<double>(below(9)), -1.0 / 3.0});
    const int far = below(2) == 0 ? 130'000 : 300;
    const Cell corner{static_cast<int>(below(far)) - far / 2, static_cast<int>(below(far)) - far / 2};
    if (below(4) > 0)
      grid.include({corner, corner + Cell{1 + static_cast<int>(below(300)), 1 + static_cast<int>(below(300))}});
    const CellBox box = grid.bounds();
    for (std::int64_t i = box.empty() ? 0 : below(2000); i > 0; --i)
      grid.set_log_odds(box.min + Cell{static_cast<int>(below(box.width())), static_cast<int>(below(box.height()))},
                        static_cast<LogOdds>(random_()));
    return grid;
  }
  Landmark landmark() {
    Landmark landmark;
    if (below(8) == 0) landmark.id = 0;
    landmark.name = text();
    landmark.category = text();
    landmark.T_map_landmark = pose();
    landmark.degree = number();
    for (std::int64_t i = below(4); i > 0; --i) landmark.templates.push_back({text(), number(), number()});
    for (std::int64_t i = below(3); i > 0; --i)
      landmark.evidence.push_back(
          {"category " + std::to_string(9 - i), std::numeric_limits<int>::max(), number(), number(), number()});
    landmark.sightings = below(2) == 0 ? 0 : std::numeric_limits<int>::max();
    if (below(2) == 0) landmark.access = pose();
    landmark.level = static_cast<int>(below(2'000'001)) - 1'000'000;
    landmark.annotations = annotations();
    return landmark;
  }
  LandmarkId any_of(const LandmarkGraph& graph) {
    return std::next(graph.landmarks().begin(), below(static_cast<std::int64_t>(graph.landmarks().size())))->first;
  }
  Route route(const LandmarkGraph& graph) {
    Route route;
    route.from = any_of(graph);
    route.to = any_of(graph);
    route.cost_m = static_cast<double>(below(1'000'000)) / 7.0;
    for (std::int64_t i = below(30); i > 0; --i) route.trajectory.push_back(pose());
    if (below(2) == 0) route.trajectory = steps(below(30));
    route.driven = below(2) == 0;
    route.closed = below(2) == 0;
    route.level = static_cast<int>(below(3)) - 1;
    if (below(2) == 0) route.speed_limit_mps = std::numeric_limits<double>::min();
    route.annotations = annotations();
    return route;
  }
  std::vector<Pose2> steps(std::int64_t poses) {
    std::vector<Pose2> trajectory;
    const auto number_below = [this](std::int64_t end) { return static_cast<double>(below(end) - end / 2) / 7e5; };
    for (; poses > 0; --poses)
      trajectory.push_back({number_below(100'000'000), number_below(1LL << 50), number_below(4'000'000)});
    return in_whole_steps(trajectory);
  }
  LandmarkShape shape() {
    if (below(2) == 0) return {text(), Contour::circle(0.1 + static_cast<double>(below(100)) / 7.0)};
    const double side_m = 0.1 + static_cast<double>(below(100)) / 7.0;
    return {text(), Contour::polygon_in_place({{0, 0}, {side_m, 0}, {side_m / 3.0, side_m}})};
  }
  MissionProgress progress() {
    MissionProgress progress{number(), static_cast<int>(below(5)), text(),   pose(),   std::nullopt,
                             number(), below(1LL << 53),           below(9), below(9), {}};
    if (below(2) == 0) progress.true_T_map_robot = pose();
    for (std::int64_t i = below(5); i > 0; --i) progress.candidates.add(landmark());
    return progress;
  }

  std::mt19937_64 random_;
};

TEST_F(MapStore, RandomMapsComeBackEqualAndGiveTheSameBytesAgain) {
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const SavedMap map = RandomMap(seed).make();
    save_map(file("a.cairn"), map);
    const SavedMap loaded = load_map(file("a.cairn"));
    expect_equal(loaded, map);
    save_map(file("b.cairn"), loaded);
    ASSERT_EQ(bytes_of(file("a.cairn")), bytes_of(file("b.cairn")));
    const SalvagedMap salvaged = salvage_map(file("a.cairn"));
    EXPECT_THAT(salvaged.losses, testing::IsEmpty());
    expect_equal(salvaged.map, map);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace cairn
