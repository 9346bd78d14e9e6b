// How a module written in Python is made, and what is said of one that cannot be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "framework/config/config_value.hpp"
#include "tests/plugins/python_module/python_file.hpp"

namespace cairn::testing_python {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::StartsWith;

// Places are those of settings in the file "mission.yaml", whose first lines are `file`, `class` and `settings`.
std::string error_of_making(const std::string& text, const std::string& settings = "") {
  try {
    (void)detector_of(text, settings);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no ConfigError";
}

TEST(MakingAPythonModule, AFileThatIsNotThereIsNamedAtItsPlace) {
  EXPECT_EQ(error_of([] { (void)detector_with("file: /nowhere/it.py\nclass: It\n"); }),
            "mission.yaml:1:7: /nowhere/it.py: no such file");
  EXPECT_THAT(error_of([] { (void)detector_with("file: /tmp\nclass: It\n"); }), HasSubstr("/tmp: is not a plain file"));
  EXPECT_THAT(error_of([] { (void)detector_with("class: It\n"); }), HasSubstr("lacks the key \"file\""));
}

TEST(MakingAPythonModule, AClassThatIsNotThereIsNamedWithTheNearest) {
  EXPECT_THAT(
      error_of_making("class If:\n  pass\n"),
      AllOf(StartsWith("mission.yaml:2:8: "), HasSubstr(" has no class \"It\" (did you mean \"If\"?); it has If")));
  EXPECT_THAT(error_of_making("It = 3\n"), HasSubstr("\"It\" of "));
}

TEST(MakingAPythonModule, AMissingMethodIsNamed) {
  EXPECT_THAT(error_of_making("class It:\n  def __init__(self, context): pass\n"),
              HasSubstr("lacks the method detect()"));
}

TEST(MakingAPythonModule, AnUnknownSettingIsNamedAtItsPlaceWithTheNearest) {
  const std::string text =
      "class It:\n"
      "  def __init__(self, context, diameter_m=0.5): pass\n"
      "  def detect(self, grid, changes): pass\n";
  EXPECT_EQ(error_of_making(text, "{diametr_m: 1}"),
            "mission.yaml:3:12: unknown setting \"diametr_m\" of the class It (did you mean \"diameter_m\"?); known: "
            "diameter_m");
}

TEST(MakingAPythonModule, ASettingThatIsMissingIsNamed) {
  const std::string text =
      "class It:\n"
      "  def __init__(self, context, *, diameter_m): pass\n"
      "  def detect(self, grid, changes): pass\n";
  EXPECT_THAT(error_of_making(text), AllOf(StartsWith("mission.yaml:2:8: "),
                                           HasSubstr("settings lack \"diameter_m\", a parameter of the class It")));
}

TEST(MakingAPythonModule, WhatTheFileRaisesHasItsLineAndTrace) {
  const std::string error = error_of_making("import math\n\nmath.sqrt(-1)\n");
  EXPECT_THAT(error, MatchesRegex("[^\n]*it_[0-9]+\\.py:3:[0-9]+: ValueError: math domain error\nTraceback.*"));
}

TEST(MakingAPythonModule, WhatEndsTheProcessAsItIsImportedEndsAnotherProcess) {
  EXPECT_THAT(error_of_making("import os\nos._exit(0)\n"),
              MatchesRegex("mission.yaml:1:7: [^\n]*it_[0-9]+\\.py: called exit\\(0\\) while it was imported"));
  EXPECT_THAT(error_of_making("import ctypes\nctypes.string_at(0)\n"),
              HasSubstr(".py: crashed (SIGSEGV) while it was imported"));
  ::setenv("CAIRN_MODULE_TRIAL_S", "0.5", 1);
  EXPECT_THAT(error_of_making("while True: pass\n"),
              HasSubstr(".py: did not finish within 500 ms while it was imported"));
  ::unsetenv("CAIRN_MODULE_TRIAL_S");
}

TEST(MakingAPythonModule, ASyntaxErrorHasItsLineAndColumn) {
  EXPECT_THAT(error_of_making("class It:\n  def detect(self:\n"),
              MatchesRegex("[^\n]*it_[0-9]+\\.py:2:13: SyntaxError: [^\n]*\n.*"));
}

TEST(MakingAPythonModule, WhatTheConstructorRaisesHasItsLineThoughItIsRaisedElsewhere) {
  const std::string text =
      "import json\n"
      "class It:\n"
      "  def __init__(self, context):\n"
      "    json.loads('{')\n"
      "  def detect(self, grid, changes): pass\n";
  EXPECT_THAT(error_of_making(text), MatchesRegex("[^\n]*it_[0-9]+\\.py:4:[0-9]+: json.decoder.JSONDecodeError: .*"));
}

TEST(MakingAPythonModule, TheEndOfTheProgramIsAFaultOfTheModule) {
  EXPECT_THAT(error_of_making("import sys\nsys.exit(0)\n"), MatchesRegex("[^\n]*\\.py:2:1: SystemExit: 0\n.*"));
}

TEST(MakingAPythonModule, SettingsAreWhatYamlMeans) {
  const std::string text =
      "class It:\n"
      "  def __init__(self, context, **settings): raise ValueError(repr(settings))\n"
      "  def detect(self, grid, changes): pass\n";
  EXPECT_THAT(error_of_making(text, "{a: 1, b: 0.5, c: true, d: null, e: text, f: '2', g: [1, {h: x}]}"),
              HasSubstr("{'a': 1, 'b': 0.5, 'c': True, 'd': None, 'e': 'text', 'f': '2', 'g': [1, {'h': 'x'}]}"));
}

TEST(MakingAPythonModule, EachObjectHasARunOfTheFileOfItsOwn) {
  const std::string text =
      "count = 0\n"
      "class It:\n"
      "  def __init__(self, context):\n"
      "    global count\n"
      "    count += 1\n"
      "    self.mine = count\n"
      "  def detect(self, grid, changes): pass\n"
      "  def next(self): return {'stamp_s': self.mine, 'odometry': (0, 0)}\n";
  const auto first = sensor_of(text);
  const auto second = sensor_of(text);
  EXPECT_EQ(first->next({}).observation.stamp_s, 1.0);
  EXPECT_EQ(second->next({}).observation.stamp_s, 1.0);
}

TEST(MakingAPythonModule, RandomNumbersAreThoseOfTheSeed) {
  const std::string text =
      "class It:\n"
      "  def __init__(self, context): self.rng = context.rng; self.t = 0\n"
      "  def next(self): self.t += 1; return {'stamp_s': self.t, 'odometry': (self.rng.random(), 0)}\n";
  const auto first = sensor_of(text);
  const auto second = sensor_of(text);
  EXPECT_EQ(first->next({}).observation.T_odom_robot, second->next({}).observation.T_odom_robot);
  EXPECT_NE(first->next({}).observation.T_odom_robot.x_m, 0.0);
}

}  // namespace
}  // namespace cairn::testing_python
