#include "framework/experiments/jobs.hpp"

#include <algorithm>

#include "framework/mission/mission.hpp"

namespace cairn {

std::vector<ExperimentJob> jobs_of(const ExperimentConfig& config, const std::filesystem::path& out) {
  std::vector<ExperimentJob> jobs;
  const bool of_trials = config.experiment == ExperimentKind::trials;
  const std::vector<std::filesystem::path> drawn{"trials"};  // each seed's own
  const std::vector<std::filesystem::path>& missions = of_trials ? drawn : config.missions;
  for (const std::filesystem::path& mission : missions) {
    const bool is_log = !of_trials && !load_mission(mission, config.overrides).world;
    const int seeds = is_log ? std::min(config.seeds.count, std::max(config.hold_out_every, 1)) : config.seeds.count;
    for (const ExperimentVariant& variant : config.variants)
      for (int i = 0; i < seeds; ++i) {
        const std::int64_t seed = config.seeds.from + i;
        const std::string name = "seed_" + std::to_string(seed);
        // One mission as it stands needs no folders of its own.
        const bool alone = missions.size() == 1 && config.variants.size() == 1;
        jobs.push_back({mission, variant, seed, alone ? out / name : out / mission.stem() / variant.name / name});
      }
  }
  return jobs;
}

}  // namespace cairn
