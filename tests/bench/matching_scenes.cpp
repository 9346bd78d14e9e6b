#include "tests/bench/matching_scenes.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>

#include "framework/mission/modules.hpp"
#include "framework/mission/runner.hpp"

namespace cairn::bench {
namespace {

constexpr int kMatchingsPerScene = 20;

CellBox region_about(Cell centre) {
  const Cell half{kRegionSide / 2, kRegionSide / 2};
  return {centre - half, centre - half + Cell{kRegionSide, kRegionSide}};
}

// Copies what the templates can reach around some of a mission's matchings.
class SceneCollector : public Listener {
 public:
  SceneCollector(const World& world, int reach, MatchingScenes& into) : world_(world), reach_(reach), into_(into) {}

  void on(const Event& event, const MissionView& view) override {
    const auto* done = std::get_if<MatchingDone>(&event);
    if (done == nullptr || seen_++ % kMatchingsPerScene != 0) return;
    const OccupancyGrid& grid = view.world.grid;
    const CellBox box = region_about(grid.cell_at(done->matching.region_centre_m));
    MatchingScene scene{OccupancyGrid(grid.cell_m(), grid.clamp_nat(), grid.origin_m()), {}, false};
    const CellBox read = box.grown(reach_ + 2);
    for (int y = read.min.y; y < read.max.y; ++y) {
      for (int x = read.min.x; x < read.max.x; ++x) scene.grid.set_log_odds({x, y}, grid.log_odds({x, y}));
    }
    for (int y = box.min.y; y < box.max.y; ++y) scene.region.push_back({y, box.min.x, box.max.x});
    for (const WorldObject& object : world_.objects) {
      if (object.category.empty()) continue;
      scene.has_landmark |= box.contains(grid.cell_at(object.T_map_object.position()));
    }
    into_.scenes.push_back(std::move(scene));
  }

 private:
  const World& world_;
  int reach_;
  MatchingScenes& into_;
  int seen_ = 0;
};

int reach_of(const TemplateSet& set) {
  int reach = 0;
  for (const LandmarkTemplate& t : set.templates) {
    for (const TemplateCell& cell : t.cells) reach = std::max(reach, distance8(cell.offset, {0, 0}));
  }
  return reach;
}

MatchingScenes collect() {
  const ModuleLibrary library({std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn"});
  const auto out = std::filesystem::temp_directory_path() / "cairn_matching_scenes";
  std::filesystem::create_directories(out);
  MatchingScenes scenes;
  for (const std::int64_t seed : {7, 8}) {
    const Mission mission =
        load_mission(std::filesystem::path(CAIRN_SOURCE_DIR) / "config/missions/office.yaml", {}, seed);
    if (scenes.templates.templates.empty()) scenes.templates = render_templates(mission, 0.05, library);
    MissionRunner runner(mission, library, {out, false, nullptr});
    SceneCollector collector(*mission.world, reach_of(scenes.templates), scenes);
    runner.subscribe(collector);
    (void)runner.run();
  }
  std::filesystem::remove_all(out);
  return scenes;
}

}  // namespace

std::vector<const MatchingScene*> MatchingScenes::with_landmark(bool has_landmark) const {
  std::vector<const MatchingScene*> chosen;
  for (const MatchingScene& scene : scenes) {
    if (scene.has_landmark == has_landmark) chosen.push_back(&scene);
  }
  return chosen;
}

const MatchingScenes& matching_scenes() {
  static const MatchingScenes scenes = collect();
  return scenes;
}

}  // namespace cairn::bench
