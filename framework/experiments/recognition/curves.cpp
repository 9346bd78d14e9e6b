#include "framework/experiments/recognition/curves.hpp"

#include <algorithm>
#include <chrono>

#include "framework/experiments/recognition/recognition.hpp"
#include "framework/mission/modules.hpp"
#include "framework/modules/fence.hpp"

namespace cairn {
namespace {

constexpr const char* kThreshold = "tau_match";

// The best ones first, none nearer to a better one than merge_m.
std::vector<Detection> merged(std::vector<Detection> detections, double merge_m) {
  std::ranges::stable_sort(detections, std::greater(), &Detection::degree);
  std::vector<Detection> kept;
  for (Detection& detection : detections) {
    const Point at_m = detection.T_map_landmark.position();
    if (std::ranges::none_of(
            kept, [&](const Detection& other) { return (other.T_map_landmark.position() - at_m).norm() <= merge_m; }))
      kept.push_back(std::move(detection));
  }
  return kept;
}

std::int64_t right_ones(const LandmarkGraph& found, const World& world, double tolerance_m) {
  return std::ranges::count_if(pairs_within(world, found, tolerance_m), [](const FoundThing& pair) {
    return !pair.object->category.empty() && pair.object->category == pair.landmark->category;
  });
}

}  // namespace

Mission with_detector(const Mission& mission, const ComparedDetector& detector, const ModuleLibrary& library) {
  PluginChoice choice = detector.choice;
  const Schema& schema = library.find(PluginKind::detector, choice.name, choice.config.place).schema;
  const auto knows = [&](const std::string& key) {
    return std::ranges::find(schema.fields, key, &FieldSpec::key) != schema.fields.end();
  };
  std::vector<ConfigValue::Entry> left_open = mission.config.detector.config.entries;
  std::erase_if(left_open, [](const ConfigValue::Entry& entry) { return entry.key == kThreshold; });
  ConfigValue::Entry lowest{kThreshold, choice.config.place, {}};
  lowest.value.kind = ConfigValue::Kind::scalar;
  lowest.value.place = choice.config.place;
  lowest.value.scalar = "0";
  left_open.push_back(std::move(lowest));
  for (ConfigValue::Entry& entry : left_open)
    if (knows(entry.key) && choice.config.find(entry.key) == nullptr) choice.config.entries.push_back(std::move(entry));
  Mission changed = mission;
  use_detector(changed, choice);
  return changed;
}

WorldCounts counts_of(const std::vector<Detection>& detections, const Mission& mission, double tolerance_m) {
  WorldCounts world;
  for (const WorldObject& object : mission.world->objects) world.truly += object.category.empty() ? 0 : 1;
  LandmarkGraph found;
  for (const Detection& detection : merged(detections, mission.config.landmarks.merge_m)) {
    Landmark landmark;
    landmark.category = detection.category;
    landmark.T_map_landmark = detection.T_map_landmark;
    found.add(landmark);
    if (world.counts.empty() || world.counts.back().degree > detection.degree) world.counts.emplace_back();
    world.counts.back() = {detection.degree, static_cast<std::int64_t>(found.landmarks().size()),
                           right_ones(found, *mission.world, tolerance_m)};
  }
  return world;
}

DetectorSweep sweep(const Mission& mission, const ComparedDetector& detector, const ModuleLibrary& library,
                    const OccupancyGrid& grid, double tolerance_m) {
  const Mission changed = with_detector(mission, detector, library);
  const auto module = build_detector(changed, library, grid.cell_m());
  const CellChanges changes = everything_in(grid.bounds());
  const auto begin = std::chrono::steady_clock::now();
  const DetectionReport report =
      fenced("detector", detector.choice.name, [&] { return module->detect(grid, changes, Budget{}); });
  DetectorSweep result;
  result.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.detector = detector.name;
  std::vector<Detection> detections;
  for (const Matching& matching : report.matchings)
    if (matching.detection) detections.push_back(*matching.detection);
  result.counts = counts_of(detections, changed, tolerance_m);
  return result;
}

}  // namespace cairn
