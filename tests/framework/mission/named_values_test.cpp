#include "framework/mission/named_values.hpp"

#include <gmock/gmock.h>

#include "tests/framework/mission/still_modules.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct HandOverConfig {
  std::string from;
  std::string to;
  static void describe(Fields<HandOverConfig>& fields) {
    fields.input("from", &HandOverConfig::from, "taken");
    fields.output("to", &HandOverConfig::to, "given");
  }
};

class HandOver : public Behaviour {
 public:
  Status tick(const WorldView&, BehaviourContext&) override { return {StepState::success, ""}; }
  void halt() override {}
};

ModuleLibrary library() {
  Registrar registrar;
  registrar.add<Behaviour, HandOverConfig>(
      "hand_over", "gives and takes",
      [](const HandOverConfig&, const ModuleContext&) { return std::make_unique<HandOver>(); });
  ModuleLibrary modules({});
  modules.add("(test)", registrar);
  return modules;
}

std::vector<std::string> errors_of(const std::string& steps) {
  const MissionTree tree = read_mission_tree(parse_config_text(steps, "mission.yaml"), "mission.yaml");
  EXPECT_THAT(tree.errors, IsEmpty());
  std::vector<std::string> texts;
  for (const ConfigError& error : missing_inputs(tree.steps, library())) texts.emplace_back(error.what());
  return texts;
}

TEST(NamedValues, AreTheSameAfterTheyWereSaved) {
  NamedValues values;
  values["here"].pose = Pose2{1.25, -0.1, 0.3};
  values["here"].heading_matters = true;
  values["found"].landmarks = {3, 7};
  SavedMap map;
  add_named_values(map, values);
  const NamedValues again = saved_named_values(map);
  ASSERT_EQ(again.size(), 2U);
  EXPECT_EQ(again.at("here").pose, values["here"].pose);
  EXPECT_TRUE(again.at("here").heading_matters);
  EXPECT_THAT(again.at("found").landmarks, ElementsAre(3, 7));
  EXPECT_FALSE(again.at("found").pose);
}

TEST(NamedValues, NothingIsWrittenOfNone) {
  SavedMap map;
  add_named_values(map, {});
  EXPECT_THAT(map.properties, IsEmpty());
  EXPECT_THAT(saved_named_values(map), IsEmpty());
}

TEST(NamedValues, DamagedOnesAreRefusedWithASentence) {
  for (const char* text : {"[]", "{\"a\": {\"pose\": [1, 2]}}", "{\"a\": 3}", "{", "{\"a\": {\"landmarks\": \"x\"}}"}) {
    SavedMap map;
    map.properties["named_values"] = text;
    try {
      (void)saved_named_values(map);
      ADD_FAILURE() << text;
    } catch (const StoreError& error) {
      EXPECT_THAT(error.what(), HasSubstr("cannot be resumed: its property named_values: "));
    }
  }
}

TEST(NamedValues, AStepBeforeMustGiveWhatAnotherTakes) {
  EXPECT_THAT(errors_of("- hand_over: {to: found}\n- hand_over: {from: found}\n"), IsEmpty());
  EXPECT_THAT(
      errors_of("- sequence:\n  - hand_over: {to: found}\n- repeat: {times: 2, do: {hand_over: {from: found}}}\n"),
      IsEmpty());
  EXPECT_THAT(
      errors_of("- hand_over: {from: found}\n- hand_over: {to: found}\n"),
      ElementsAre("mission.yaml:1:21: input: no step before gives \"found\"; a step gives one by `output: NAME`"));
  EXPECT_THAT(errors_of("- hand_over: {to: found}\n- hand_over: {from: fond}\n"),
              ElementsAre(HasSubstr("no step before gives \"fond\" (did you mean \"found\"?); given are: found")));
}

}  // namespace
}  // namespace cairn
