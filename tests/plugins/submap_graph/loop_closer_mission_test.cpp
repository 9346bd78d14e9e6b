// Missions of a log that goes twice round a ring: which loop closer the mission's file names decides what closes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "framework/contracts/module.hpp"
#include "framework/mission/check.hpp"
#include "framework/mission/runner.hpp"
#include "maps/store/map_store.hpp"
#include "tests/plugins/submap_graph/driven_ring.hpp"

namespace cairn {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class RingLog : public Sensor {
 public:
  SensorStep next(const Budget&) override {
    SensorStep step;
    if (next_ >= drive_.size()) return step;
    const DrivenScan& scan = drive_[next_++];
    step.state = SensorState::observation;
    step.observation.stamp_s = 0.5 * static_cast<double>(next_);
    step.observation.T_odom_robot = scan.T_odom_robot;
    for (const Point& point_m : seen_from(walls_, scan.T_map_robot, 120, 0.01, next_))
      step.observation.ranges.push_back(
          {{0.0, 0.0, std::atan2(point_m.y(), point_m.x())}, 0.0, 0.05, 80.0, point_m.norm(), 0});
    return step;
  }
  Drive* drive() override { return nullptr; }

 private:
  std::vector<DrivenScan> drive_ = ring_drive(2, radians(3.0), 0.05);
  std::vector<DrawnWall> walls_ = ring_walls();
  std::size_t next_ = 0;
};

class NeverCloser : public LoopCloser {
 public:
  std::vector<LoopProposal> propose(const LoopQuery&, const Budget&) override { return {}; }
};

// Tries every pose of a window around the guess, a lattice of 0.1 m, for each submap near by.
class ExhaustiveCloser : public LoopCloser {
 public:
  std::vector<LoopProposal> propose(const LoopQuery& query, const Budget&) override {
    std::vector<LoopProposal> proposals;
    if (query.is_afterwards) return proposals;  // under way is enough
    for (std::size_t i = 0; i < query.submaps.size(); ++i) {
      const PassedSubmap& passed = query.submaps[i];
      if (passed.distance_m > 1.0) continue;
      const LikelihoodField field(passed.submap->points_m(), 0.1, 0.12);
      const Pose2 T_submap_guess = inverse(passed.T_map_submap) * query.T_map_node;
      const auto best = search_all(field, query.points_m, {T_submap_guess, 1.0, radians(12.0)}, 0.6);
      if (best)
        proposals.push_back({i, best->T_field_scan, Eigen::Vector3d(200.0, 200.0, 1000.0).asDiagonal(), best->score});
    }
    return proposals;
  }
};

template <class Interface, class Type>
void add(Registrar& registrar, const char* name) {
  registrar.add<Interface, NoConfig>(
      name, "for tests", [](const NoConfig&, const ContextOf<Interface>&) { return std::make_unique<Type>(); });
}

ModuleLibrary library_with_closers() {
  Registrar registrar;
  add<Sensor, RingLog>(registrar, "ring_log");
  add<LoopCloser, NeverCloser>(registrar, "never");
  add<LoopCloser, ExhaustiveCloser>(registrar, "exhaustive");
  ModuleLibrary library({fs::path(CAIRN_BINARY_DIR) / "lib" / "cairn"});
  library.add("(the test's own)", registrar);
  return library;
}

class LoopCloserMission : public testing::Test {
 protected:
  LoopCloserMission() : folder_(fs::path(testing::TempDir()) / ("cairn_closers_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    std::ofstream(folder_ / "ring.yaml") << "mission: ring\nrobot: " << CAIRN_SOURCE_DIR
                                         << "/config/robots/laser_robot.yaml\nsensor: {plugin: ring_log}\n"
                                            "start: {at_m: [1, 1]}\nlocalizer: {plugin: submap_graph}\n"
                                            "map: {plugin: bayes, cell_m: 0.2}\n";
  }
  ~LoopCloserMission() override { fs::remove_all(folder_); }

  // How many loops the saved graph of the mission has.
  [[nodiscard]] std::size_t loops_of(const std::vector<std::string>& overrides) const {
    const Mission mission = load_mission(folder_ / "ring.yaml", overrides);
    const MissionResult result = MissionRunner(mission, library_, {folder_, false, nullptr}).run();
    EXPECT_EQ(result.outcome, MissionOutcome::done) << result.reason;
    const SavedMap map = load_map(folder_ / result.map_file);
    return static_cast<std::size_t>(std::ranges::count(map.submaps.edges, true, &KeptEdge::is_closure));
  }
  [[nodiscard]] std::vector<std::string> errors_of(const std::vector<std::string>& overrides) const {
    return check_mission(folder_ / "ring.yaml", overrides, library_).errors;
  }

  const fs::path folder_;
  const ModuleLibrary library_ = library_with_closers();
};

TEST_F(LoopCloserMission, TheMissionsFileChoosesWhoProposesLoops) {
  EXPECT_GT(loops_of({}), 10U) << "submap_correlation, when it names none";
  EXPECT_GT(loops_of({"loop_closer.plugin=exhaustive"}), 10U);
  EXPECT_EQ(loops_of({"loop_closer.plugin=never"}), 0U);
}

TEST_F(LoopCloserMission, SettingsReachTheSearch) {
  EXPECT_EQ(loops_of({"loop_closer.min_score=1"}), 0U) << "of the default loop closer";
}

TEST_F(LoopCloserMission, ACheckKnowsItsNamesAndSettings) {
  EXPECT_THAT(errors_of({}), IsEmpty());
  EXPECT_THAT(errors_of({"loop_closer.plugin=nevr"}),
              ElementsAre(HasSubstr("unknown loop_closer plugin \"nevr\" (did you mean \"never\"?)")));
  EXPECT_THAT(errors_of({"loop_closer.min_scor=0.6"}), ElementsAre(HasSubstr("did you mean \"min_score\"?")));
  EXPECT_THAT(errors_of({"localizer.plugin=odometry_compass", "loop_closer.min_scor=0.6"}),
              ElementsAre(HasSubstr("did you mean \"min_score\"?")))
      << "whether the localizer takes it or not";
  EXPECT_THAT(errors_of({"loop_closer.min_window_m=8"}), ElementsAre(HasSubstr("must not be above max_window_m")));
  EXPECT_THAT(errors_of({"localizer.min_score=0.6"}), ElementsAre(HasSubstr("is now `loop_closer.min_score`")));
}

}  // namespace
}  // namespace cairn
