#include "framework/program/mission/watch_text.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace cairn {
namespace {

using nlohmann::json;

WatchFrame small_frame() {
  WatchFrame frame;
  frame.tick = 7;
  frame.time_s = 0.35;
  frame.cell_m = 0.05;
  frame.bounds = {{0, 0}, {10, 20}};
  frame.pose.T_map_robot = {1.0, 2.0, 0.0};
  return frame;
}

TEST(WatchText, WritesTilesAsBase64) {
  WatchFrame frame = small_frame();
  frame.tiles.push_back({{-1, 2}, {}});
  frame.tiles[0].ol.fill(127);
  frame.tiles[0].ol[0] = 255;
  const json line = json::parse(WatchText().line_of(frame));
  const auto text = line["tiles"][0][2].get<std::string>();
  EXPECT_EQ(line["tiles"][0][0], -1);
  EXPECT_EQ(text.size(), 5464U);  // of 4096 bytes
  EXPECT_EQ(text.substr(0, 8), "/39/f39/");
  EXPECT_EQ(text.substr(5456), "f39/fw==");
}

TEST(WatchText, WritesRangesWhereTheyAreInTheMap) {
  WatchFrame frame = small_frame();
  const double none = std::numeric_limits<double>::infinity();
  frame.ranges = {{0.1, {1.5, 2.0, 1.0}, {{0.5, 0.0, 1.0}, 0.1, 0.1, 5.0, 1.25, 0}},
                  {0.2, {1.0, 2.0, 0.0}, {{0.0, 0.0, 0.0}, 0.0, 0.1, 5.0, none, 1}}};
  const json line = json::parse(WatchText().line_of(frame));
  EXPECT_EQ(line["ranges"],
            json::parse(R"([[1.5, 2.0, 1.0, 0.1, 1.25, "echo"], [1.0, 2.0, 0.0, 0.0, 5.0, "no_echo"]])"));
}

TEST(WatchText, WritesTheTimesOfTheStages) {
  WatchFrame frame = small_frame();
  EXPECT_FALSE(json::parse(WatchText().line_of(frame)).contains("times"));
  StageTime time;
  time.stage = "map";
  time.module = "muriel";
  time.count = 7;
  time.own_s = 0.25;
  frame.times = {time};
  EXPECT_EQ(json::parse(WatchText().line_of(frame))["times"], json::parse(R"([["map", "muriel", 7, 0.25]])"));
}

TEST(WatchText, WritesNodesPlanAndBoundsWhenTheyHaveChanged) {
  WatchText text;
  WatchFrame frame = small_frame();
  NodeReport node;
  node.path = "1";
  node.is_running = true;
  node.doing = "driving";
  frame.nodes = {node};
  frame.plan = std::make_shared<WatchPlan>();
  const json first = json::parse(text.line_of(frame));
  EXPECT_EQ(first["nodes"], json::parse(R"([["1", "running", "driving"]])"));
  EXPECT_EQ(first["plan"]["points"], json::array());
  EXPECT_EQ(first["grid"]["box"]["height"], 20);
  const json second = json::parse(text.line_of(frame));
  for (const char* key : {"nodes", "plan", "grid"}) EXPECT_FALSE(second.contains(key)) << key;
  frame.plan.reset();
  frame.nodes[0].is_running = false;
  frame.nodes[0].status = {StepState::failure, "blocked"};
  frame.bounds.max.y = 21;
  const json third = json::parse(text.line_of(frame));
  EXPECT_EQ(third["nodes"], json::parse(R"([["1", "failure", "blocked"]])"));
  EXPECT_TRUE(third["plan"].is_null());
  EXPECT_EQ(third["grid"]["box"]["height"], 21);
}

TEST(WatchText, TheLastFrameHasNoPose) {
  WatchFrame frame;
  frame.is_last = true;
  frame.lines = {{1.0, "saved \xff.cairn"}};
  const json line = json::parse(WatchText().line_of(frame));
  EXPECT_FALSE(line.contains("pose"));
  EXPECT_FALSE(line.contains("grid"));
  EXPECT_EQ(line["log"][0][1], "saved \xEF\xBF\xBD.cairn") << "bytes that are no text do not end the stream";
}

TEST(WatchText, BeginsWithTheTree) {
  TreeNode step;
  step.path = "1";
  step.name = "round";
  step.choice.name = "retry";
  step.children.resize(1);
  const json line = json::parse(WatchText::first_line("held", {step}, 0.2));
  EXPECT_EQ(line["ok"], true);
  EXPECT_EQ(line["tree"][0]["kind"], "retry");
  EXPECT_EQ(line["tree"][0]["name"], "round");
  EXPECT_EQ(line["tree"][0]["children"].size(), 1U);
}

}  // namespace
}  // namespace cairn
