#include "plugins/behaviours/errands/records.hpp"

#include <gmock/gmock.h>

#include "framework/files/template_file.hpp"
#include "tests/plugins/behaviours/fake_host.hpp"
#include "tests/plugins/behaviours/written_config.hpp"

namespace cairn::behaviours {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kRoom = R"(
  ##############################
  #............................#
  #............................#
  #............................#
  #............................#
  #...............####.........#
  #...............####.........#
  #...............####.........#
  #...............####.........#
  #............................#
  #............................#
  #....R.......................#
  #............................#
  #............................#
  ##############################
)";

FakeHost room() {
  FakeHost host(kRoom, {.all_known = true});
  host.graph.add(landmark_at("box", {1.8, 0.8, 0.0}, {1.8, 0.4, 0.0}));
  return host;
}

CaptureTemplate capture(const std::string& yaml) {
  return CaptureTemplate(config_of<CaptureTemplateConfig>(yaml));
}

TEST(CaptureTemplate, WritesATemplateThatLoads) {
  FakeHost host = room();
  CaptureTemplate step = capture("{at: L1, name: crate}");
  const Status status = host.tick(step);
  ASSERT_EQ(status.state, StepState::success) << status.reason;
  EXPECT_THAT(status.reason, HasSubstr("wrote crate.yaml: crate, 0."));
  ASSERT_TRUE(host.written.contains("crate.yaml"));
  const LandmarkShape shape = parse_landmark_shape(host.written["crate.yaml"], "crate.yaml");
  EXPECT_EQ(shape.category, "crate");
  ASSERT_EQ(shape.contour.polygons_m.size(), 1U);
  // A block of 0.4 m, one cell inside its edges, its corners cut.
  EXPECT_NEAR(shape.contour.outer_diameter_m(), 0.3 * std::sqrt(2.0), 0.1) << host.written["crate.yaml"];
}

TEST(CaptureTemplate, OfAPlaceWithNothingFails) {
  FakeHost host = room();
  CaptureTemplate step = capture("{at: [0.5, 1.1], name: air, file: nothing.yaml, radius_m: 0.2}");
  const Status status = host.tick(step);
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_THAT(status.reason, HasSubstr("no template of air: "));
  EXPECT_TRUE(host.written.empty());
  CaptureTemplate unknown = capture("{at: nearest bax, name: crate}");
  EXPECT_THAT(host.tick(unknown).reason, HasSubstr("(did you mean \"box\"?)"));
}

TEST(CaptureTemplate, ReportsWhereItsSettingsAreWrong) {
  EXPECT_THAT(error_of([] { capture("{at: L1, name: crate, file: ../crate.yaml}"); }),
              HasSubstr("mission.yaml:1:29: file"));
  EXPECT_EQ(error_of([] { capture("{at: L1, name: crate, file: report.json}"); }),
            "mission.yaml:1:29: file must end in .yaml, found \"report.json\"");
  EXPECT_THAT(error_of([] { capture("{at: L1, name: 3d box}"); }), HasSubstr("mission.yaml:1:16: category must be"));
  EXPECT_THAT(error_of([] { capture("{at: L1}"); }), HasSubstr("name"));
  EXPECT_THAT(error_of([] { capture("{at: L1, nam: crate}"); }), HasSubstr("(did you mean \"name\"?)"));
}

TEST(PlanQuery, AsksTheWholeQuestion) {
  FakeHost host = room();
  PlanQuery step(
      config_of<PlanQueryConfig>("{from: L2, to: nearest box, avoid: [L3], closed: [R4], alternatives: 2, cost: time, "
                                 "explain: true, file: a.jsonl}"));
  EXPECT_EQ(host.tick(step), (Status{StepState::success, "L2 -> nearest box: answered into a.jsonl"}));
  ASSERT_EQ(host.asked.size(), 1U);
  EXPECT_EQ(host.asked[0].from, "L2");
  EXPECT_EQ(host.asked[0].to, "nearest box");
  EXPECT_THAT(host.asked[0].avoid, ElementsAre("L3"));
  EXPECT_THAT(host.asked[0].closed, ElementsAre("R4"));
  EXPECT_EQ(host.asked[0].alternatives, 2);
  EXPECT_EQ(host.asked[0].cost, "time");
  EXPECT_TRUE(host.asked[0].explain);
  PlanQuery usual(config_of<PlanQueryConfig>("L1"));
  EXPECT_EQ(host.tick(usual).reason, "here -> L1: answered into answers.jsonl");
}

TEST(PlanQuery, ReportsWhereItsSettingsAreWrong) {
  const auto ask = [](const char* yaml) { return PlanQuery(config_of<PlanQueryConfig>(yaml)); };
  EXPECT_EQ(error_of([&] { ask("{to: L1, file: answers.txt}"); }),
            "mission.yaml:1:16: file must end in .jsonl, found \"answers.txt\"");
  EXPECT_THAT(error_of([&] { ask("{to: L1, cost: tme}"); }), HasSubstr("mission.yaml:1:16"));
  EXPECT_THAT(error_of([&] { ask("{to: L1, cost: tme}"); }), HasSubstr("(did you mean \"time\"?)"));
  EXPECT_THAT(error_of([&] { ask("{to: \"\"}"); }), HasSubstr("mission.yaml:1:6: plan_query: from and to"));
  EXPECT_THAT(error_of([&] { ask("{to: L1, via: [L2], alternatives: 1}"); }), HasSubstr("not for a tour"));
  EXPECT_THAT(error_of([&] { ask("{too: L1}"); }), HasSubstr("(did you mean \"to\"?)"));
}

TEST(Log, SaysALineWithTheValuesOfTheMoment) {
  FakeHost host = room();
  host.time_s = 12.0;
  Log step(
      config_of<LogConfig>("'at {place} after {time}: {landmarks} landmarks, {nearest} in {distance}, battery "
                           "{battery}, {{so}}'"));
  EXPECT_EQ(host.tick(step).state, StepState::success);
  EXPECT_THAT(host.said, ElementsAre("at (0.55, 0.35) after 12 s: 1 landmarks, L1 (box) in 1.33 m, battery unknown, "
                                     "{so}"));
  host.observe = [](const FakeHost&) {
    Observation seen;
    seen.battery_ratio = 0.256;
    return seen;
  };
  host.graph = {};
  Log other(config_of<LogConfig>("'{battery} {nearest} {distance} {explored} {area}'"));
  EXPECT_EQ(host.tick(other).reason, "26 % no landmark unknown 100.0 % 4.5 m2");
}

TEST(Log, ReportsNamesThatItDoesNotKnow) {
  const auto log = [](const char* yaml) { return Log(config_of<LogConfig>(yaml)); };
  EXPECT_EQ(
      error_of([&] { log("{text: 'at {plce}'}"); }),
      "mission.yaml:1:8: text: there is no {plce} (did you mean \"place\"?); there are {area}, {battery}, {distance}, "
      "{explored}, {landmarks}, {nearest}, {place} and {time}");
  EXPECT_THAT(error_of([&] { log("'at {place'"); }), HasSubstr("a { without its other brace; write {{ for one"));
  EXPECT_THAT(error_of([&] { log("'at place}'"); }), HasSubstr("a } without its other brace; write }} for one"));
  EXPECT_THAT(error_of([&] { log("[1]"); }), HasSubstr("mission.yaml:1:1"));
}

}  // namespace
}  // namespace cairn::behaviours
