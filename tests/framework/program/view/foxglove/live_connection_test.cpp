#include "framework/program/view/foxglove/live_connection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "maps/base/base64.hpp"

namespace cairn {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::IsEmpty;
using LiveFrames = FoxgloveConnection::Frames;

// The payloads of a subscription.
std::vector<json> heard(const LiveFrames& frames, char subscription) {
  constexpr std::size_t kHead = 13;
  std::vector<json> all;
  for (const auto& frame : frames)
    if (!frame.is_text && frame.bytes[0] == 1 && frame.bytes[1] == subscription)
      all.push_back(json::parse(frame.bytes.substr(kHead)));
  return all;
}

std::string tile(std::uint8_t ol) {
  return base64(std::vector<std::uint8_t>(64 * 64, ol));
}

class LiveConnectionTest : public testing::Test {
 protected:
  LiveFrames subscribe(int id, LiveChannel channel) {
    return connection_.on_text(
        json{{"op", "subscribe"}, {"subscriptions", {{{"id", id}, {"channelId", static_cast<int>(channel)}}}}}.dump());
  }
  LiveFrames take(const json& line) { return connection_.take(line.dump()); }
  void begin() {
    (void)take({{"ok", true},
                {"mission", "m"},
                {"tree", {{{"path", "1"}, {"kind", "explore"}, {"name", "look"}, {"children", json::array()}}}}});
  }
  static json pose(double x_m) { return {{"x_m", x_m}, {"y_m", 0.0}, {"theta_rad", 0.0}}; }
  static json landmark(int id) {
    return {{"id", id},          {"label", "L" + std::to_string(id)},
            {"category", "box"}, {"x", 1.0},
            {"y", 2.0},          {"degree", 0.5},
            {"sightings", 3}};
  }

  LiveConnection connection_{"run", "session", {}};
};

TEST_F(LiveConnectionTest, OffersChannelsWithoutControlOfTime) {
  const LiveFrames frames = connection_.greeting();
  EXPECT_FALSE(json::parse(frames[0].bytes).contains("dataEndTime"));
  EXPECT_EQ(json::parse(frames[1].bytes)["channels"].size(), 11U);
}

TEST_F(LiveConnectionTest, SendsWhatIsSubscribedAsItComes) {
  begin();
  EXPECT_THAT(subscribe(3, live_pose), IsEmpty());
  const LiveFrames frames = take({{"time_s", 1.5}, {"pose", pose(2.0)}, {"log", {{1.5, "hello"}}}});
  ASSERT_EQ(heard(frames, 3).size(), 1U);
  EXPECT_EQ(heard(frames, 3)[0]["pose"]["position"]["x"], 2.0);
  EXPECT_EQ(heard(frames, 3)[0]["timestamp"]["nsec"], 500'000'000);
  EXPECT_THAT(connection_.on_text(R"({"op":"unsubscribe","subscriptionIds":[3]})"), IsEmpty());
  EXPECT_THAT(heard(take({{"time_s", 2.0}, {"pose", pose(3.0)}}), 3), IsEmpty());
}

TEST_F(LiveConnectionTest, ALateSubscriptionGetsHowThingsStand) {
  begin();
  (void)take({{"time_s", 1.0},
              {"landmarks", {landmark(1), landmark(2)}},
              {"nodes", {{"1", "running", "to the door"}}},
              {"log", {{1.0, "hello"}}}});
  (void)take({{"time_s", 2.0}, {"retired", {1}}});
  const auto landmarks = heard(subscribe(4, live_landmarks), 4);
  ASSERT_EQ(landmarks.size(), 1U);
  EXPECT_NE(landmarks[0].dump().find("L2"), std::string::npos);
  const auto nodes = heard(subscribe(5, live_tree), 5);
  ASSERT_EQ(nodes.size(), 1U);
  EXPECT_EQ(nodes[0]["name"], "look");
  EXPECT_EQ(nodes[0]["state"], "running");
  EXPECT_THAT(heard(subscribe(6, live_log), 6), IsEmpty()) << "what has happened is over";
}

TEST_F(LiveConnectionTest, TheMapComesOnceASecondAndHoldsItsTiles) {
  begin();
  (void)take(
      {{"time_s", 1.0},
       {"grid",
        {{"cell_m", 0.1}, {"origin_m", {0.0, 0.0}}, {"box", {{"x", -2}, {"y", 0}, {"width", 4}, {"height", 2}}}}},
       {"tiles", {{-1, 0, tile(0)}, {0, 0, tile(255)}}}});
  EXPECT_EQ(heard(subscribe(7, live_map), 7).size(), 1U);
  const auto grids = heard(connection_.advance(1.0, 1), 7);
  ASSERT_EQ(grids.size(), 1U);
  EXPECT_EQ(grids[0]["column_count"], 4);
  EXPECT_DOUBLE_EQ(grids[0]["pose"]["position"]["x"].get<double>(), -0.2);
  EXPECT_THAT(bytes_of_base64(grids[0]["data"].get<std::string>()), ElementsAre(0, 0, 255, 255, 0, 0, 255, 255));
  EXPECT_THAT(heard(connection_.advance(1.0, 1), 7), IsEmpty()) << "nothing has changed";
  (void)take({{"time_s", 3.0}, {"tiles", {{0, 0, tile(0)}}}});
  EXPECT_THAT(heard(connection_.advance(0.5, 1), 7), IsEmpty());
  EXPECT_EQ(heard(connection_.advance(0.5, 1), 7).size(), 1U);
}

TEST_F(LiveConnectionTest, WhatIsNotUnderstoodIsToldAndTheEndToo) {
  for (const char* line : {"", "[]", R"({"tiles":[[0,0,"x"]]})", R"({"landmarks":[{}]})", R"({"pose":3})"}) {
    const LiveFrames frames = connection_.take(line);
    ASSERT_FALSE(frames.empty()) << line;
    EXPECT_EQ(json::parse(frames.back().bytes)["op"], "status") << line;
  }
  EXPECT_EQ(json::parse(take({{"ok", false}, {"error", "already watched by 8"}})[0].bytes)["message"],
            "already watched by 8");
  const LiveFrames frames = take({{"ended", true}, {"status", json::object()}});
  EXPECT_EQ(json::parse(frames.back().bytes)["message"], "the mission has ended");
}

TEST_F(LiveConnectionTest, AMapOfTooManyCellsIsToldAndTheRestIsShown) {
  begin();
  (void)take({{"time_s", 1.0},
              {"pose", pose(2.0)},
              {"grid",
               {{"cell_m", 0.1},
                {"origin_m", {0.0, 0.0}},
                {"box", {{"x", 0}, {"y", 0}, {"width", 40000}, {"height", 40000}}}}}});
  const LiveFrames refused = subscribe(7, live_map);
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_NE(refused[0].bytes.find("40000 x 40000"), std::string::npos);
  EXPECT_EQ(connection_.advance(1.0, 1).size(), 1U);
  EXPECT_EQ(heard(subscribe(8, live_pose), 8).size(), 1U);
}

}  // namespace
}  // namespace cairn
