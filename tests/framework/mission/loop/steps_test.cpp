// Trees in a running mission: what the host makes of their ticks, halts and orders.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "framework/reporting/report.hpp"
#include "tests/framework/mission/still_modules.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct ScriptConfig {
  std::string script;  // a letter a tick: R, S, F; r drives; N saves where it cannot; T throws
  static void describe(Fields<ScriptConfig>& fields) {
    fields.text("script", &ScriptConfig::script, "what it does");
    fields.shorthand("script");
  }
};

class Scripted : public Behaviour {
 public:
  explicit Scripted(ScriptConfig config) : config_(std::move(config)) {}
  Status tick(const WorldView&, BehaviourContext& orders) override {
    const char letter = config_.script[std::min(at_++, config_.script.size() - 1)];
    if (letter == 'r') orders.drive({0.1, 0.0});
    if (letter == 'N') return orders.save("no_such_folder/map.cairn");
    if (letter == 'T') throw std::runtime_error("broken");
    const StepState state = letter == 'S'   ? StepState::success
                            : letter == 'F' ? StepState::failure
                                            : StepState::running;
    return {state, letter == 'F' ? "no" : ""};
  }
  void halt() override {
    if (config_.script.ends_with("h")) throw std::runtime_error("cannot halt");
    at_ = 0;
  }

 private:
  ScriptConfig config_;
  std::size_t at_ = 0;
};

class MissionOfTrees : public testing::Test {
 protected:
  MissionOfTrees()
      : folder_(std::filesystem::path(testing::TempDir()) / ("cairn_trees_" + std::to_string(getpid()))),
        library_(still::library()) {
    std::filesystem::create_directories(folder_);
    Registrar registrar;
    registrar.add<Behaviour, ScriptConfig>(
        "script", "does what is written",
        [](const ScriptConfig& config, const ModuleContext&) { return std::make_unique<Scripted>(config); });
    library_.add("(test)", registrar);
  }
  ~MissionOfTrees() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] static Mission mission_of(const std::string& steps) {
    Mission mission = still::mission(100);
    MissionTree tree = read_mission_tree(parse_config_text(steps, "steps.yaml"), "steps.yaml");
    for (const ConfigError& error : tree.errors) ADD_FAILURE() << error.what();
    mission.steps = std::move(tree.steps);
    return mission;
  }
  MissionResult run(const std::string& steps, Listener* listener = nullptr) {
    MissionRunner runner(mission_of(steps), library_, {folder_});
    if (listener != nullptr) runner.subscribe(*listener);
    return runner.run();
  }
  static std::vector<std::string> outcomes(const MissionResult& result) {
    std::vector<std::string> texts;
    for (const NodeReport& node : result.nodes)
      texts.push_back(node.path + " " + node.kind + " " +
                      (node.is_halted                            ? "halted"
                       : node.status.state == StepState::success ? "success"
                                                                 : "failure"));
    return texts;
  }

  const std::filesystem::path folder_;
  ModuleLibrary library_;
};

TEST_F(MissionOfTrees, AFallbackTurnsTheFailureOfAStepIntoASuccess) {
  const MissionResult result = run("[{fallback: [script: RF, script: S]}, {script: S}]");
  EXPECT_EQ(result.outcome, MissionOutcome::done);
  ASSERT_EQ(result.steps.size(), 2U);
  EXPECT_EQ(result.steps[0].name, "fallback");
  EXPECT_THAT(outcomes(result),
              ElementsAre("1 fallback success", "1/1 script failure", "1/2 script success", "2 script success"));
}

TEST_F(MissionOfTrees, AFailedTreeFailsTheMissionWithTheReasonOfItsLeaf) {
  const MissionResult result = run("[{script: S}, {name: try, retry: {times: 2, do: [script: RF]}}]");
  EXPECT_EQ(result.outcome, MissionOutcome::step_failed);
  EXPECT_EQ(result.reason, "step 2 (try): script: no (attempt 2 of 2)");
}

TEST_F(MissionOfTrees, ABehaviourThatHasEndedBeginsAfreshInTheNextRound) {
  const MissionResult result = run("[{repeat: {times: 3, do: [script: RRS, script: RS]}}]");
  EXPECT_EQ(result.outcome, MissionOutcome::done);
  ASSERT_EQ(result.nodes.size(), 4U);
  EXPECT_EQ(result.nodes[2].ticks, 9);
  EXPECT_EQ(result.nodes[3].ticks, 6);
}

TEST_F(MissionOfTrees, ConditionsSeeTheMissionsClock) {
  const MissionResult result = run("[{retry: {times: forever, do: {time_after: 1}}}]");
  EXPECT_EQ(result.outcome, MissionOutcome::done);
  EXPECT_NEAR(result.time_s, 1.0, 0.04);
}

TEST_F(MissionOfTrees, ATimeoutHaltsByTheMissionsClock) {
  const MissionResult result = run("[{force_success: {timeout: {after_s: 0.5, do: {script: R}}}}]");
  EXPECT_EQ(result.outcome, MissionOutcome::done);
  EXPECT_NEAR(result.time_s, 0.5, 0.05);
  EXPECT_THAT(outcomes(result), ElementsAre("1 force_success success", "1/1 timeout failure", "1/1/1 script halted"));
}

TEST_F(MissionOfTrees, TwoThatDriveAtOnceFail) {
  const MissionResult result = run("[{parallel: [{name: left, script: r}, {name: right, script: r}]}]");
  EXPECT_EQ(result.reason, "step 1 (parallel): left (1/1) and right (1/2) drive at the same time");
}

// Where it drives matters more than that a file could not be written.
TEST_F(MissionOfTrees, ASaveThatFailsDoesNotKeepTheStepsAfterItFromBeingDone) {
  const MissionResult result = run("[{sequence: [script: N, script: S]}, {script: N}, {script: S}]");
  EXPECT_EQ(result.outcome, MissionOutcome::map_not_saved);
  EXPECT_THAT(outcomes(result), ElementsAre("1 sequence success", "1/1 script failure", "1/2 script success",
                                            "2 script failure", "3 script success"));
}

TEST_F(MissionOfTrees, AModuleThatThrowsEndsTheMissionAndTheOthersAreHalted) {
  const MissionResult result = run("[{parallel: [script: R, script: RT, script: R]}]");
  EXPECT_EQ(result.outcome, MissionOutcome::module_fault);
  EXPECT_EQ(result.reason, "module script failed in stage behaviour: broken");
  EXPECT_THAT(outcomes(result),
              ElementsAre("1 parallel halted", "1/1 script halted", "1/2 script halted", "1/3 script halted"));
}

TEST_F(MissionOfTrees, EveryoneIsHaltedThoughOneThrowsAtIt) {
  const MissionResult result = run("[{parallel: [script: R, script: Rh]}]");
  EXPECT_EQ(result.outcome, MissionOutcome::step_failed);
  EXPECT_EQ(result.reason,
            "the sensor's data ended before the steps did; module script failed in stage behaviour: cannot halt");
  EXPECT_THAT(outcomes(result), ElementsAre("1 parallel halted", "1/1 script halted", "1/2 script halted"));
}

TEST_F(MissionOfTrees, TheReportReportsOfEveryNode) {
  RunReport report;
  const MissionResult result = run("[{name: a, reactive_sequence: [{time_before: 50}, {script: RRRS}]}]", &report);
  const auto json = nlohmann::json::parse(report.report_json(mission_of("[wait]"), result, {}, {}));
  ASSERT_EQ(json["nodes"].size(), 3U);
  EXPECT_EQ(json["nodes"][1]["path"], "1/1");
  EXPECT_EQ(json["nodes"][1]["kind"], "time_before");
  EXPECT_EQ(json["nodes"][1]["runs"], 4);
  EXPECT_EQ(json["nodes"][2]["outcome"], "success");
  EXPECT_EQ(json["nodes"][2]["ticks"], 4);
  EXPECT_EQ(json["steps"].size(), 1U);
  EXPECT_EQ(json["steps"][0]["step"], "a");
  const std::string events = json["events"].dump();
  EXPECT_THAT(events, HasSubstr("node 1/2 (script) begins"));
  EXPECT_EQ(events.find("node 1/1 (time_before) ends"), events.rfind("node 1/1 (time_before) ends")) << events;
}

TEST_F(MissionOfTrees, AnUnknownBehaviourMayBeMeantForANode) {
  const Mission mission = mission_of("[{sequnce: [script: R]}]");
  try {
    const MissionRunner runner(mission, library_, {folder_});
    FAIL() << "no error";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("steps.yaml:1:3: unknown behaviour plugin \"sequnce\" (did you mean "
                                        "\"sequence\"?); known are: script, still_step; and these nodes: sequence, "));
  }
}

}  // namespace
}  // namespace cairn
