// The parts of the host that steps need, over fakes, for the tests of this folder.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "framework/mission/loop/behaviour_requests.hpp"
#include "tests/framework/mission/still_modules.hpp"
#include "tests/framework/modules/test_clock.hpp"

namespace cairn {

// Answers with the straight line.
class StraightPlanner : public Planner {
 public:
  PlanResult plan(const PlanRequest& request, const WorldView& world, const Budget&) const override {
    ++asked;
    knew_hierarchies = world.hierarchies != nullptr;
    PlanResult result;
    result.outcome = PlanOutcome::solved;
    if (request.from.pose && request.to.pose) {
      result.path = {*request.from.pose, *request.to.pose};
      result.length_m = (request.from.pose->position() - request.to.pose->position()).norm();
    }
    if (returns_nan && !result.path.empty()) result.path.back().theta_rad = std::numeric_limits<double>::quiet_NaN();
    return result;
  }
  mutable int asked = 0;
  mutable bool knew_hierarchies = false;
  bool returns_nan = false;
};

class RecordingDrive : public Drive {
 public:
  void command(const Twist& twist, double /*valid_for_s*/) override { commands.push_back(twist); }
  void stop() noexcept override { commands.emplace_back(); }
  std::vector<Twist> commands;
};

class StillController : public Controller {
 public:
  ControlResult control(const ControlRequest&, const WorldView&) override { return {}; }
};

// Keeps the names of the events.
class EventNames : public Listener {
 public:
  void on(const Event& event, const MissionView&) override { names.push_back(std::visit(Name{}, event)); }
  std::vector<std::string> names;

 private:
  struct Name {
    std::string operator()(const MapSaved& e) const { return "saved " + e.file_name; }
    std::string operator()(const Autosaved& e) const { return "autosaved " + e.file_name; }
    std::string operator()(const AutosaveFailed&) const { return "autosave failed"; }
    std::string operator()(const Message& e) const { return e.sentence; }
    std::string operator()(const PlanDone&) const { return "plan"; }
    std::string operator()(const PathStarted& e) const { return "path of " + std::to_string(e.path.size()); }
    template <class Other>
    std::string operator()(const Other&) const {
      return "other";
    }
  };
};

class HostFixture : public testing::Test {
 protected:
  HostFixture() {
    std::filesystem::create_directories(folder_);
    mission_.steps.clear();
    mission_.config.planner.name = "straight";
    built_.planner = planner_;
    world_.grid = &grid_;
    publisher_.subscribe(events_);
  }
  ~HostFixture() override { std::filesystem::remove_all(folder_); }

  static OccupancyGrid free_floor() {
    OccupancyGrid grid(0.1);
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 30; ++x) grid.set_log_odds({x, y}, -1000);
    return grid;
  }
  // Made when first asked for, so that a test can change the mission before.
  StagedModules& modules() {
    if (!modules_) modules_ = std::make_unique<StagedModules>(built_, mission_, time_);
    return *modules_;
  }
  Planning& planning() {
    if (!planning_)
      planning_ = std::make_unique<Planning>(mission_, modules(), world_.graph, ClusterTree{}, monitor_, Budget{});
    return *planning_;
  }
  MapSaving& saving() {
    if (!saving_)
      saving_ = std::make_unique<MapSaving>(
          mission_, MapSaving::Options{folder_, autosaves_, is_resumed_, time_}, planning(), world_, publisher_,
          [this](ClusterTree clusters) { return content(std::move(clusters)); }, [this] { return submaps_; });
    return *saving_;
  }
  HostParts host() {
    return {mission_, modules().clock,      world_,   publisher_, monitor_, planning(),
            saving(), modules().controller, tracker_, orders_};
  }
  void attach_drive() { monitor_.attach({drive_, modules().clock, modules().drive}); }
  [[nodiscard]] virtual SavedMap content(ClusterTree clusters) const {
    SavedMap map;
    map.grid = grid_;
    map.graph = graph_;
    map.clusters = std::move(clusters);
    map.progress = progress_;
    return map;
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      ("cairn_host_" + std::to_string(getpid()) + "_" + testing::UnitTest::GetInstance()->current_test_info()->name());
  const std::shared_ptr<TestClock> time_ = std::make_shared<TestClock>();
  Mission mission_ = still::mission(10);
  MissionModules built_;
  const std::shared_ptr<StraightPlanner> planner_ = std::make_shared<StraightPlanner>();
  const std::shared_ptr<RecordingDrive> drive_ = std::make_shared<RecordingDrive>();
  bool autosaves_ = false;
  bool is_resumed_ = false;
  MissionProgress progress_;
  KeptSubmaps submaps_;
  OccupancyGrid grid_ = free_floor();
  LandmarkGraph graph_;
  WorldState world_{mission_.robot, graph_, Pose2{}};
  LandmarkTracker tracker_{mission_.config.landmarks, mission_.robot, {}};
  Publisher publisher_{world_};
  OrderInbox inbox_;
  Orders orders_{&inbox_, {}, folder_};
  EventNames events_;
  CollisionMonitor monitor_{CollisionMonitorConfig{}, mission_.robot};
  std::unique_ptr<StagedModules> modules_;
  std::unique_ptr<Planning> planning_;
  std::unique_ptr<MapSaving> saving_;
};

}  // namespace cairn
