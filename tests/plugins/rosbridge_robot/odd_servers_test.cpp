// Servers that do what they should not, and what becomes of the wheels.
#include <gmock/gmock.h>

#include <algorithm>
#include <thread>

#include "tests/plugins/rosbridge_robot/rosbridge_fixture.hpp"

namespace cairn::rosbridge_robot {
namespace {

using testing::HasSubstr;

class OddServers : public testing::Test {
 protected:
  void SetUp() override {
    driven = bridged(bridged_config(server));
    ASSERT_EQ(drive_bridged(*driven, 0.6).state, SensorState::observation);
    ASSERT_GT(server.v_mps, 0.0);
  }
  // A fault that names it, with the wheels at rest.
  void expect_fault(const std::string& text) {
    std::jthread watch([this] { EXPECT_TRUE(server.stands_within(0.5)); });
    const SensorStep step = drive_bridged(*driven, 3.0);
    watch.join();
    EXPECT_EQ(step.state, SensorState::fault);
    EXPECT_THAT(step.reason, HasSubstr(text));
    EXPECT_EQ(server.v_mps, 0.0);
  }

  RosbridgeServer server;
  std::unique_ptr<live::LiveRobot> driven;
};

TEST_F(OddServers, MessagesInPiecesAreReadAndTheWheelsStandAfterThem) {
  server.in_pieces = true;
  const SensorStep step = drive_bridged(*driven, 0.6);
  ASSERT_EQ(step.state, SensorState::observation) << step.reason;
  EXPECT_GT(step.observation.T_odom_robot.x_m, 0.1);
  EXPECT_GT(server.v_mps, 0.0);
  EXPECT_TRUE(server.stands_within(0.5)) << "nobody orders";
}

TEST_F(OddServers, UnknownOperationsAndTextThatIsNoJsonAreLeftOutAndCounted) {
  server.with_noise = true;
  ASSERT_EQ(drive_bridged(*driven, 0.6).state, SensorState::observation);
  EXPECT_GT(server.v_mps, 0.0);
  server.say_binary(std::string("\x00\xff\x10", 3));
  ASSERT_EQ(drive_bridged(*driven, 0.3).state, SensorState::observation);
  const ConnectionPart part = driven->connection_parts()[0];
  const auto count = std::ranges::find(part.values, "messages not understood", &ConnectionValue::name);
  ASSERT_NE(count, part.values.end());
  EXPECT_GT(std::stoi(count->text), 10);
  EXPECT_TRUE(server.stands_within(0.5)) << "nobody orders";
}

TEST_F(OddServers, AnErrorOfTheServerIsAFaultWithItsWords) {
  server.say(R"({"op":"status","level":"error","id":"cairn:/scan","msg":"cannot load type of /scan"})");
  expect_fault("rosbridge says: cannot load type of /scan");
}

TEST_F(OddServers, AWarningOfTheServerIsNone) {
  server.say(R"({"op":"status","level":"warning","msg":"slow"})");
  ASSERT_EQ(drive_bridged(*driven, 0.5).state, SensorState::observation);
  EXPECT_GT(server.v_mps, 0.0);
}

TEST_F(OddServers, AMessageWithoutAFieldIsAFaultThatNamesIt) {
  server.say(R"({"op":"publish","topic":"/odom","msg":{"header":{"stamp":{"sec":1,"nanosec":0},"frame_id":""}}})");
  expect_fault("/odom: it has no `child_frame_id`");
}

TEST_F(OddServers, AMessageThatIsTooLongEndsTheConnectionAndItIsMadeAgain) {
  server.say(R"({"op":"publish","topic":"/other","msg":")" + std::string(2 << 20, 'x') + "\"}");
  std::jthread watch([this] { EXPECT_TRUE(server.stands_within(0.5)); });
  const SensorStep step = drive_bridged(*driven, 1.5);
  ASSERT_EQ(step.state, SensorState::observation) << step.reason;
  watch.join();
  EXPECT_GT(server.v_mps, 0.0) << "again";
}

TEST_F(OddServers, AConnectionThatIsCutIsMadeAgainWithTheWheelsAtRestFirst) {
  server.cut();
  std::jthread watch([this] { EXPECT_TRUE(server.stands_within(0.5)); });
  const SensorStep step = drive_bridged(*driven, 1.5);
  ASSERT_EQ(step.state, SensorState::observation) << step.reason;
  watch.join();
  EXPECT_GT(server.v_mps, 0.0) << "again";
  EXPECT_EQ(server.connections(), 2);
}

TEST(OddServersAtFirst, ATopicThatIsNotDeliveredIsAskedForAgain) {
  RosbridgeServer server;
  server.is_deaf_sonar = true;
  const auto driven = bridged(bridged_config(server));
  ASSERT_EQ(drive_bridged(*driven, 0.5).state, SensorState::observation);
  server.is_deaf_sonar = false;
  bool is_seen = false;
  for (const double begin_s = live::now_s(); live::now_s() - begin_s < 4.0 && !is_seen;)
    is_seen = !driven->next({}).observation.ranges.empty();
  EXPECT_TRUE(is_seen);
  for (const auto& request : server.requests("unsubscribe"))
    EXPECT_THAT(request["topic"].get<std::string>(), testing::AnyOf("/sonar", "/tf_static"));
}

TEST(OddServersAtFirst, ATypeThatIsNotTheOneThatIsReadIsAFaultWithTheServersWords) {
  RosbridgeServer server(1);
  const SensorStep step = bridged(bridged_config(server, 2))->next({});
  EXPECT_EQ(step.state, SensorState::fault);
  EXPECT_THAT(step.reason, HasSubstr("rosbridge says: subscribe: Tried to subscribe to topic /odom with"));
}

TEST(OddServersAtFirst, WhatIsConnectedIsSaidTopicByTopic) {
  RosbridgeServer server;
  Config config = bridged_config(server);
  config.ranges.push_back({"/scam", ros::RangeKind::laser, {}, 0});
  const auto driven = bridged(config);
  for (int i = 0; i < 20; ++i) ASSERT_EQ(driven->next({}).state, SensorState::observation);
  std::string text;
  for (const ConnectionPart& part : driven->connection_parts()) {
    text += part.name + ": " + part.problem;
    for (const ConnectionValue& value : part.values) text += "; " + value.name + " " + value.text;
    text += "\n";
  }
  EXPECT_THAT(text, HasSubstr("/: ; ros 2; rosapi 6 topics; messages not understood 0\n"));
  EXPECT_THAT(text, HasSubstr("/odom: ; type nav_msgs/msg/Odometry; rate "));
  EXPECT_THAT(text, HasSubstr("/sonar: ; type sensor_msgs/msg/Range; rate "));
  EXPECT_THAT(text, HasSubstr("; frame sonar_1; clock -0.0"));
  EXPECT_THAT(text, HasSubstr("/scam: nobody publishes it (did you mean \"/scan\"?); type sensor_msgs/msg/LaserScan; "
                              "heard nothing\n"));
  EXPECT_THAT(text, HasSubstr("/e_stop: ; type std_msgs/msg/Bool; heard nothing\n"));
  EXPECT_THAT(text, HasSubstr("/cmd_vel: ; type geometry_msgs/msg/Twist; heard by 1 subscriber\n"));
}

}  // namespace
}  // namespace cairn::rosbridge_robot
