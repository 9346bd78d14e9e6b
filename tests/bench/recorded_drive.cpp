#include "tests/bench/recorded_drive.hpp"

#include <utility>

#include "framework/mission/modules.hpp"
#include "framework/mission/runner.hpp"

namespace cairn::bench {
namespace {

// What the map module was given, tick by tick.
class ObservationLog : public Listener {
 public:
  void on(const Event& event, const MissionView& view) override {
    if (std::holds_alternative<TickDone>(event)) seen.emplace_back(*view.world.observation, view.world.pose);
  }

  std::vector<std::pair<Observation, PoseEstimate>> seen;
};

RecordedTick recorded(const OccupancyGrid& grid, const CellChanges& changes) {
  RecordedTick tick{changes, grid.bounds(), {}};
  for (const CellSpan& span : changes.spans)
    for (int x = span.x_begin; x < span.x_end; ++x) tick.written.push_back(grid.log_odds({x, span.y}));
  return tick;
}

}  // namespace

RecordedDrive record_drive(const std::filesystem::path& mission_file, std::int64_t seed) {
  const ModuleLibrary library({std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn"});
  const auto out = std::filesystem::temp_directory_path() / "cairn_recorded_drive";
  std::filesystem::create_directories(out);
  const Mission mission = load_mission(mission_file, {}, seed);
  MissionRunner runner(mission, library, {out, false, nullptr});
  ObservationLog log;
  runner.subscribe(log);
  (void)runner.run();
  std::filesystem::remove_all(out);
  const MissionModules modules = build_modules(mission, library);
  RecordedDrive drive{modules.templates, modules.mapper->grid(), {}};
  for (const auto& [observation, pose] : log.seen) {
    const CellChanges changes = modules.mapper->integrate(observation, pose);
    drive.ticks.push_back(recorded(modules.mapper->grid(), changes));
  }
  return drive;
}

void write(OccupancyGrid& grid, const RecordedTick& tick) {
  grid.include(tick.bounds);
  auto value = tick.written.begin();
  for (const CellSpan& span : tick.changes.spans)
    for (int x = span.x_begin; x < span.x_end; ++x) grid.set_log_odds({x, span.y}, *value++);
}

}  // namespace cairn::bench
