#include "framework/experiments/trials/trials.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/experiments/trials/random_mission.hpp"
#include "framework/files/robot_file.hpp"
#include "framework/files/template_file.hpp"
#include "framework/files/world_file.hpp"
#include "maps/base/output_file.hpp"
#include "maps/base/portable_random.hpp"

namespace cairn {
namespace {

std::vector<WaitSpan> waits_of(const Mission& mission, const MissionResult& result) {
  std::vector<WaitSpan> waits;
  for (const TreeNode* leaf : behaviours_of(mission.steps)) {
    if (leaf->choice.name != "wait") continue;
    for (const NodeRun& run : result.node_runs.runs())
      if (run.path == leaf->path) waits.push_back({run.begin_s, run.end_s});
  }
  return waits;
}

int faults_begun(const Mission& mission, double until_s) {
  const ConfigValue* list = mission.config.sensor.config.find("faults");
  if (list == nullptr) return 0;
  return static_cast<int>(std::ranges::count_if(list->items, [&](const ConfigValue& fault) {
    return config_detail::to_number(*fault.find("at_s"), "at_s", {0.0, 1e9}, "s") <= until_s;
  }));
}

}  // namespace

std::filesystem::path write_trial(const TrialsConfig& config, const RandomWorldConfig& worlds, std::int64_t seed,
                                  const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const auto number = static_cast<std::uint64_t>(seed);
  constexpr std::uint64_t kTrial = 100;  // beside the mission's own streams
  PortableRandom chance(number, kTrial);
  const std::vector<LandmarkShape> shapes = load_landmark_shapes(config.templates);
  const double specular_ratio = chance.between(0.0, config.max_specular_ratio);
  const int robot = chance.whole(0, static_cast<int>(config.robots.size()) - 1);
  MissionFiles files;
  files.robot = std::filesystem::absolute(config.robots[static_cast<std::size_t>(robot)]).lexically_normal();
  files.templates = std::filesystem::absolute(config.templates).lexically_normal();
  files.world = "world.yaml";  // beside the mission
  const std::filesystem::path world_file = folder / files.world;
  write_file(world_file, random_world_yaml(worlds, shapes, specular_ratio, number));
  const World world = load_world(world_file, shapes);
  std::filesystem::path mission_file = folder / "mission.yaml";
  write_file(mission_file, random_mission_yaml(config, files, load_robot(files.robot), world, number));
  return mission_file;
}

TrialVerdict judge_trial(const TrialsConfig& config, const TrialEvidence& evidence,
                         const std::vector<TimedContact>& contacts) {
  TrialVerdict verdict;
  verdict.contacts = static_cast<int>(contacts.size());
  std::ranges::copy_if(contacts, std::back_inserter(verdict.fast_contacts), [&](const TimedContact& touch) {
    return touch.contact.could_be_seen && touch.contact.speed_mps > config.fast_mps;
  });
  verdict.stand = longest_stand(evidence.record.moments(), waits_of(evidence.mission, evidence.result));
  verdict.silences = evidence.record.silences();
  verdict.goals = judge_goals(config, evidence);
  verdict.fault_count = faults_begun(evidence.mission, evidence.result.time_s);
  return verdict;
}

}  // namespace cairn
