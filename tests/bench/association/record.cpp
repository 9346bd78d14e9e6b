// Records what the template matcher says of landmarks: association_record MISSION FIRST_SEED COUNT FILE.
// Random worlds as in the experiment of recognition, one a seed.
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <string>

#include "framework/experiments/trials/random_world.hpp"
#include "framework/mission/modules.hpp"
#include "framework/mission/runner.hpp"
#include "tests/bench/association/stream.hpp"

namespace cairn::bench {
namespace {

constexpr double kNear_m = 0.45;  // of what is said of the landmark
constexpr int kAllOfFirst = 3;    // sights of a landmark, then every so many
constexpr int kThen = 3;

class SightRecorder : public Listener {
 public:
  SightRecorder(const World& world, std::vector<RecordedSight>& into) : world_(world), into_(into) {}

  void on(const Event& event, const MissionView& view) override {
    const auto* done = std::get_if<MatchingDone>(&event);
    if (done == nullptr || !done->matching.detection) return;
    const Detection& detection = *done->matching.detection;
    for (std::size_t i = 0; i < world_.objects.size(); ++i) {
      const WorldObject& object = world_.objects[i];
      const double off_m = (object.T_map_object.position() - detection.T_map_landmark.position()).norm();
      if (object.category.empty() || off_m > kNear_m) continue;
      const Pose2 T_object_map = inverse(object.T_map_object);
      RecordedSight sight{object.category, seen_[i]++, detection, {}};
      if (sight.nth >= kAllOfFirst && sight.nth % kThen != 0) continue;
      sight.detection.T_map_landmark = T_object_map * detection.T_map_landmark;
      for (TemplateDegree& t : sight.detection.templates)
        t.orientation_rad = wrap_angle(t.orientation_rad + T_object_map.theta_rad);
      for (CategoryDegree degree : done->matching.degrees) {
        if (!degree.fits || (degree.at_m - object.T_map_object.position()).norm() > kNear_m) continue;
        degree.at_m = T_object_map * degree.at_m;
        degree.orientation_rad = wrap_angle(degree.orientation_rad + T_object_map.theta_rad);
        sight.degrees.push_back(degree);
      }
      into_.push_back(std::move(sight));
    }
    (void)view;
  }

 private:
  const World& world_;
  std::vector<RecordedSight>& into_;
  std::map<std::size_t, int> seen_;
};

void record(const std::string& mission_file, int first, int count, const std::string& file) {
  const ModuleLibrary library({std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn"});
  const auto out = std::filesystem::temp_directory_path() / "cairn_association_record";
  std::filesystem::create_directories(out);
  std::vector<RecordedSight> sights;
  for (int seed = first; seed < first + count; ++seed) {
    const std::vector<LandmarkShape> shapes = load_mission(mission_file, {}, seed).shapes;
    RandomWorldConfig worlds;
    worlds.min_landmarks = 4;
    std::ofstream(out / "world.yaml") << random_world_yaml(worlds, shapes, 0.0, static_cast<std::uint64_t>(seed));
    const Mission mission = load_mission(mission_file, {"world=" + (out / "world.yaml").string()}, seed);
    MissionRunner runner(mission, library, {out, false, nullptr});
    SightRecorder recorder(*mission.world, sights);
    runner.subscribe(recorder);
    (void)runner.run();
    std::fprintf(stderr, "seed %d: %zu sights\n", seed, sights.size());
  }
  std::filesystem::remove_all(out);
  write_sights(file, sights);
}

}  // namespace
}  // namespace cairn::bench

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "association_record MISSION FIRST_SEED COUNT FILE\n");
    return 2;
  }
  try {
    cairn::bench::record(argv[1], std::stoi(argv[2]), std::stoi(argv[3]), argv[4]);
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return 2;
  }
  return 0;
}
