#include "framework/mission/modules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "framework/modules/fence.hpp"
#include "tests/framework/mission/still_modules.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class MissionModulesTest : public testing::Test {
 protected:
  [[nodiscard]] std::string error_of(const Mission& mission) const {
    try {
      (void)build_modules(mission, library_);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "no error";
  }
  const ModuleLibrary library_ = still::library();
  Mission mission_ = still::mission(10);
};

TEST_F(MissionModulesTest, AreBuiltAsTheMissionNamesThem) {
  mission_.config.start.at_m = {1.0, 2.0};
  const MissionModules built = build_modules(mission_, library_);
  EXPECT_NE(built.sensor, nullptr);
  EXPECT_NE(built.localizer, nullptr);
  EXPECT_NE(built.mapper, nullptr);
  EXPECT_NE(built.detector, nullptr);
  EXPECT_EQ(built.planner, nullptr) << "none is named";
  EXPECT_EQ(built.behaviours.size(), 1U);
  EXPECT_EQ(built.T_map_start, (Pose2{1.0, 2.0, 0.0}));
  EXPECT_EQ(built.begin_s, 0.0);
}

TEST_F(MissionModulesTest, AnUnknownBehaviourNamesThoseThatThereAre) {
  mission_.steps.front().choice.name = "still_stp";
  EXPECT_THAT(error_of(mission_), HasSubstr("unknown behaviour plugin \"still_stp\" (did you mean \"still_step\"?); "
                                            "known are: still_step; and these nodes: "));
}

TEST_F(MissionModulesTest, AMissionThatDrivesWithoutAWordOnStepsIsRefused) {
  mission_.steps.clear();
  EXPECT_THAT(error_of(mission_), HasSubstr("the mission has no steps, and still_sensor drives"));
}

TEST_F(MissionModulesTest, ACheckFindsEveryModuleThatIsWrong) {
  EXPECT_TRUE(check_modules(mission_, library_).empty());
  mission_.config.localizer.name = "no_localizer";
  mission_.steps.front().choice.name = "no_step";
  const std::vector<std::string> errors = check_modules(mission_, library_);
  EXPECT_THAT(errors, ElementsAre(HasSubstr("no_localizer"), HasSubstr("no_step")));
}

class ClosingLocalizer : public still::Localizer {
 public:
  explicit ClosingLocalizer(std::shared_ptr<LoopCloser> taken) : closer(std::move(taken)) {}
  const std::shared_ptr<LoopCloser> closer;
};

class CountedCloser : public LoopCloser {
 public:
  CountedCloser() { ++made; }
  std::vector<LoopProposal> propose(const LoopQuery&, const Budget&) override { return {}; }
  static inline int made = 0;
};

// A library with a localizer that takes a loop closer, and one of that kind.
ModuleLibrary library_that_closes() {
  Registrar registrar;
  registrar.add<Localizer, NoConfig>("closing_localizer", "takes a loop closer",
                                     [](const NoConfig&, const LocalizerContext& context) {
                                       return std::make_unique<ClosingLocalizer>(context.loop_closer());
                                     });
  registrar.add<LoopCloser, NoConfig>("counted_closer", "finds none", [](const NoConfig&, const ModuleContext&) {
    return std::make_unique<CountedCloser>();
  });
  ModuleLibrary library = still::library();
  library.add("(the test's own)", registrar);
  return library;
}

TEST_F(MissionModulesTest, ALocalizerThatTakesALoopCloserGetsOneOfItsOwn) {
  const ModuleLibrary library = library_that_closes();
  mission_.config.loop_closer.name = "counted_closer";
  mission_.config.localizer.name = "closing_localizer";
  CountedCloser::made = 0;
  const MissionModules built = build_modules(mission_, library);
  EXPECT_EQ(CountedCloser::made, 1);
  EXPECT_NE(dynamic_cast<const ClosingLocalizer&>(*built.localizer).closer, nullptr);
}

TEST_F(MissionModulesTest, ANamedLoopCloserThatNobodyTakesIsCheckedAllTheSame) {
  const ModuleLibrary library = library_that_closes();
  mission_.config.loop_closer.name = "counted_closer";
  (void)build_modules(mission_, library);
  mission_.config.loop_closer.name = "counted_close";
  EXPECT_THROW((void)build_modules(mission_, library), ConfigError);
}

TEST_F(MissionModulesTest, ADefaultLoopCloserThatIsNotInstalledIsMissedByWhoTakesItOnly) {
  const ModuleLibrary library = library_that_closes();
  EXPECT_TRUE(check_modules(mission_, library).empty());
  (void)build_modules(mission_, library);
  mission_.config.localizer.name = "closing_localizer";
  EXPECT_THAT(check_modules(mission_, library), ElementsAre(HasSubstr("unknown loop_closer plugin")));
  EXPECT_THROW((void)build_modules(mission_, library), ConfigError);
}

// Proposes these, whatever it is asked.
class FixedCloser : public LoopCloser {
 public:
  explicit FixedCloser(std::vector<LoopProposal> proposals) : proposals_(std::move(proposals)) {}
  std::vector<LoopProposal> propose(const LoopQuery&, const Budget&) override { return proposals_; }

 private:
  std::vector<LoopProposal> proposals_;
};

std::string fault_of_proposals(std::vector<LoopProposal> proposals) {
  FencedLoopCloser closer(std::make_shared<FixedCloser>(std::move(proposals)), "fixed_closer",
                          std::make_shared<CallsUnderWay>(0));
  const std::vector<PassedSubmap> submaps(2);
  LoopQuery query;
  query.submaps = submaps;
  try {
    (void)closer.propose(query, Budget{});
  } catch (const ModuleFault& fault) {
    return fault.what();
  }
  return {};
}

TEST(FencedLoopCloser, TwoProposalsForOneSubmapAreAFault) {
  EXPECT_EQ(fault_of_proposals({LoopProposal{1, {}}, LoopProposal{0, {}}}), "");
  EXPECT_EQ(fault_of_proposals({LoopProposal{1, {}}, LoopProposal{1, {}}}),
            "module fixed_closer failed in stage loop closer: proposed two loops with submap 2 of 2");
}

TEST_F(MissionModulesTest, ACheckMakesANamedLoopCloserWhoeverTakesIt) {
  mission_.config.loop_closer.name = "no_closer";
  EXPECT_THAT(check_modules(mission_, library_that_closes()), ElementsAre(HasSubstr("no_closer")));
  mission_.config.localizer.name = "closing_localizer";
  EXPECT_THAT(check_modules(mission_, library_that_closes()), ElementsAre(HasSubstr("no_closer"))) << "reported once";
}

class FaultySensor : public Sensor {
 public:
  explicit FaultySensor(bool is_simulated) : is_simulated_(is_simulated) {}
  SensorStep next(const Budget&) override {
    SensorStep step;
    step.state = SensorState::fault;
    step.reason = "the robot cannot start in a wall";
    return step;
  }
  [[nodiscard]] const GroundTruthSource* truth() const override { return is_simulated_ ? &truth_ : nullptr; }

 private:
  struct NoTruth : GroundTruthSource {
    [[nodiscard]] std::optional<GroundTruth> last_truth() const override { return std::nullopt; }
  };
  NoTruth truth_;
  bool is_simulated_;
};

TEST_F(MissionModulesTest, ACheckFindsAStartInAWorldThatTheSensorRefuses) {
  Registrar registrar;
  registrar.add<Sensor, NoConfig>("faulty_sensor", "has a fault at once", [](const NoConfig&, const SensorContext&) {
    return std::make_unique<FaultySensor>(true);
  });
  registrar.add<Sensor, NoConfig>("live_sensor", "of a real robot", [](const NoConfig&, const SensorContext&) {
    return std::make_unique<FaultySensor>(false);
  });
  ModuleLibrary library = still::library();
  library.add("(the test's own)", registrar);
  mission_.config.sensor.name = "faulty_sensor";
  mission_.config.sensor.config.entries.clear();
  mission_.start_place = {"m.yaml", 5, 16};
  EXPECT_TRUE(check_modules(mission_, library).empty()) << "without a world there is no wall";
  mission_.world = World{};
  EXPECT_THAT(check_modules(mission_, library), ElementsAre("m.yaml:5:16: the robot cannot start in a wall"));
  mission_.config.sensor.name = "live_sensor";
  EXPECT_TRUE(check_modules(mission_, library).empty()) << "a sensor of a real robot is not asked";
}

TEST_F(MissionModulesTest, GoOnWithAMapThatTheMapModuleMustTakeOver) {
  SavedMap map;
  map.grid = OccupancyGrid(0.1);
  map.properties = {{"mission", "still"},
                    {"seed", "1"},
                    {"robot", mission_.robot.name},
                    {"robot_radius_m", std::to_string(mission_.robot.radius_m)}};
  map.progress = MissionProgress{.time_s = 8.0, .step_name = mission_.steps.front().name, .T_map_robot = {3, 4, 0}};
  const MissionModules built = build_modules(mission_, library_, &map);
  EXPECT_EQ(built.begin_s, 8.0);
  EXPECT_EQ(built.T_map_start, (Pose2{3.0, 4.0, 0.0}));
  map.grid.set_log_odds({1, 1}, 500);
  EXPECT_THROW((void)build_modules(mission_, library_, &map), StoreError) << "still_map begins with an empty grid";
}

TEST(ModuleSeed, IsAnotherForEachMissionKindAndIndex) {
  std::set<std::uint64_t> seeds;
  for (std::int64_t mission = 0; mission < 20; ++mission)
    for (const PluginKind kind :
         {PluginKind::sensor, PluginKind::localizer, PluginKind::planner, PluginKind::behaviour})
      for (const std::size_t index : {0, 1, 2, 100, 101, 102, 10000}) seeds.insert(module_seed(mission, kind, index));
  EXPECT_EQ(seeds.size(), 20U * 4U * 7U);
  EXPECT_EQ(module_seed(7, PluginKind::sensor), module_seed(7, PluginKind::sensor, 0));
}

}  // namespace
}  // namespace cairn
