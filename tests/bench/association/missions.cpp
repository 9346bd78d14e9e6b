// Template sets against distance alone in simulated missions:
//   association_missions MISSION TOLERANCE_M FIRST_SEED COUNT [random]
// With `random`, in random worlds as in the experiment of recognition. One Markdown table; a line a run on stderr.
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "framework/experiments/recognition/recognition.hpp"
#include "framework/experiments/statistics.hpp"
#include "framework/experiments/trials/random_world.hpp"
#include "framework/mission/modules.hpp"
#include "framework/mission/runner.hpp"

namespace cairn::bench {
namespace {

struct Count {
  std::int64_t found = 0;       // landmarks of the graph
  std::int64_t is = 0;          // of the world
  std::int64_t paired = 0;      // of both, no further apart than the tolerance
  std::int64_t right = 0;       // of them, of one category
  double squared_error_m2 = 0;  // of the pose, summed over the ticks
  double variance_m2 = 0;       // as the localizer reports it, the same
  double ticks = 0;
};

class PoseErrors : public Listener {
 public:
  explicit PoseErrors(Count& into) : into_(into) {}
  void on(const Event& event, const MissionView& view) override {
    if (!std::holds_alternative<TickDone>(event) || !view.truth) return;
    const PoseEstimate& pose = view.world.pose;
    into_.squared_error_m2 += (pose.T_map_robot.position() - view.truth->T_map_robot.position()).squaredNorm();
    into_.variance_m2 += pose.covariance(0, 0) + pose.covariance(1, 1);
    into_.ticks += 1.0;
  }

 private:
  Count& into_;
};

struct Trial {
  std::string file;
  double tolerance_m = 0.3;
  bool is_random = false;
};

class Trials {
 public:
  explicit Trials(Trial trial)
      : trial_(std::move(trial)),
        library_({std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn"}),
        out_(std::filesystem::temp_directory_path() / ("cairn_association_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(out_);
  }
  ~Trials() { std::filesystem::remove_all(out_); }
  Trials(const Trials&) = delete;
  Trials& operator=(const Trials&) = delete;

  Count run(const std::string& rule, int seed) {
    std::vector<std::string> settings = {"landmarks.association=" + rule};
    if (trial_.is_random) {
      const std::filesystem::path world = out_ / "world.yaml";
      std::ofstream(world) << random_world_yaml({}, load_mission(trial_.file, {}, seed).shapes, 0.0,
                                                static_cast<std::uint64_t>(seed));
      settings.push_back("world=" + world.string());
    }
    const Mission mission = load_mission(trial_.file, settings, seed);
    MissionRunner runner(mission, library_, {out_, false, nullptr});
    Count count;
    PoseErrors errors(count);
    runner.subscribe(errors);
    (void)runner.run();
    for (const Verdict& verdict : judge_recognition(mission, runner.graph(), {}, trial_.tolerance_m)) {
      count.is += verdict.is.empty() ? 0 : 1;
      count.found += verdict.found.empty() ? 0 : 1;
      count.paired += !verdict.is.empty() && !verdict.found.empty() ? 1 : 0;
      count.right += verdict.is_right() ? 1 : 0;
    }
    std::fprintf(stderr, "%s, seed %d: %ld of %ld found, %ld right, %ld more; pose error %.2f m, reported %.2f m\n",
                 rule.c_str(), seed, count.paired, count.is, count.right, count.found - count.paired,
                 std::sqrt(count.squared_error_m2 / count.ticks), std::sqrt(count.variance_m2 / count.ticks));
    return count;
  }

 private:
  Trial trial_;
  ModuleLibrary library_;
  std::filesystem::path out_;
};

void print(const std::string& rule, const std::vector<Count>& counts) {
  Count all;
  for (const Count& count : counts) {
    all.found += count.found;
    all.is += count.is;
    all.paired += count.paired;
    all.right += count.right;
    all.squared_error_m2 += count.squared_error_m2;
    all.variance_m2 += count.variance_m2;
    all.ticks += count.ticks;
  }
  std::printf("| %s | %s | %s | %s | %ld | %.2f | %.2f |\n", rule.c_str(),
              text_of(share_of(all.right, all.found)).c_str(), text_of(share_of(all.right, all.is)).c_str(),
              text_of(share_of(all.right, all.paired)).c_str(), all.found - all.paired,
              std::sqrt(all.squared_error_m2 / all.ticks), std::sqrt(all.variance_m2 / all.ticks));
}

}  // namespace
}  // namespace cairn::bench

int main(int argc, char** argv) {
  using namespace cairn::bench;
  if (argc < 5 || argc > 6) {
    std::fprintf(stderr, "association_missions MISSION TOLERANCE_M FIRST_SEED COUNT [random]\n");
    return 2;
  }
  try {
    Trials trials({argv[1], std::stod(argv[2]), argc == 6});
    std::printf("| rule | precision | recall | right category | surplus | pose error m | reported m |\n");
    std::printf("|---|---:|---:|---:|---:|---:|---:|\n");
    for (const std::string rule : {"template_sets", "distance"}) {
      std::vector<Count> counts;
      for (int seed = std::stoi(argv[3]); seed < std::stoi(argv[3]) + std::stoi(argv[4]); ++seed)
        counts.push_back(trials.run(rule, seed));
      print(rule, counts);
      std::fflush(stdout);
    }
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return 2;
  }
  return 0;
}
