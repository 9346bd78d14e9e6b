// A robot behind a rosbridge_server, and what becomes of its wheels.
#include "plugins/rosbridge_robot/rosbridge_robot.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <iostream>
#include <limits>
#include <thread>

#include "tests/plugins/rosbridge_robot/rosbridge_fixture.hpp"

namespace cairn::rosbridge_robot {
namespace {

using testing::HasSubstr;

TEST(RosbridgeRobot, DrivesAndSeesByEitherVersionOfRos) {
  for (const int ros : {1, 2}) {
    RosbridgeServer server(ros);
    Config config = bridged_config(server, ros);
    config.ranges.push_back({"/scan", ros::RangeKind::laser, {}, 0});
    config.compass.topic = "/imu";
    const auto driven = bridged(config);
    const SensorStep step = drive_bridged(*driven, 1.0);
    ASSERT_EQ(step.state, SensorState::observation) << step.reason;
    EXPECT_NEAR(server.v_mps, 0.2, 1e-9);
    EXPECT_GT(step.observation.T_odom_robot.x_m, 0.05);
    EXPECT_TRUE(step.observation.compass_rad);
    ASSERT_GE(step.observation.ranges.size(), 4U) << "a sonar and three beams";
    EXPECT_EQ(step.observation.ranges[0].sensor, 1) << "by its frame";
    EXPECT_EQ(step.observation.ranges[0].range_m, 2.0);
    const auto advertised = server.requests("advertise");
    ASSERT_FALSE(advertised.empty());
    EXPECT_EQ(advertised[0]["type"], ros == 1 ? "geometry_msgs/Twist" : "geometry_msgs/msg/Twist");
  }
}

TEST(RosbridgeRobot, AsksForOneMessageAtATimeAndForSonarsOfOneTopicForAllOfThem) {
  RosbridgeServer server;
  Config config = bridged_config(server);
  config.ranges.push_back({"/scan", ros::RangeKind::laser, {}, 0});
  config.scan_every_ms = 100;
  const auto driven = bridged(config);
  ASSERT_EQ(driven->next({}).state, SensorState::observation);
  std::map<std::string, nlohmann::json> asked;
  for (const auto& request : server.requests("subscribe")) asked[request["topic"]] = request;
  EXPECT_EQ(asked["/odom"]["queue_length"], 1);
  EXPECT_EQ(asked["/odom"]["throttle_rate"], 0);
  EXPECT_EQ(asked["/sonar"]["queue_length"], 3);
  EXPECT_EQ(asked["/scan"]["queue_length"], 1);
  EXPECT_EQ(asked["/scan"]["throttle_rate"], 100);
}

TEST(RosbridgeRobot, DrivesByStampedVelocitiesWhenTheSettingsSaySo) {
  RosbridgeServer server;
  server.wants_stamped = true;
  Config config = bridged_config(server);
  config.command.kind = CommandKind::twist_stamped;
  const auto driven = bridged(config);
  ASSERT_EQ(drive_bridged(*driven, 0.7).state, SensorState::observation);
  EXPECT_NEAR(server.v_mps, 0.2, 1e-9);
}

TEST(RosbridgeRobot, ARangeThatIsNullIsBadOrNoEchoAsTheSettingsSay) {
  RosbridgeServer server;
  server.range_m = std::numeric_limits<double>::quiet_NaN();
  Config config = bridged_config(server);
  const auto last_range = [](live::LiveRobot& driven) {
    for (int i = 0; i < 100; ++i)
      if (const SensorStep step = driven.next({}); !step.observation.ranges.empty())
        return step.observation.ranges[0].range_m;
    return 0.0;
  };
  EXPECT_TRUE(std::isnan(last_range(*bridged(config))));
  config.null_range = NullRange::no_echo;
  EXPECT_TRUE(std::isinf(last_range(*bridged(config))));
}

TEST(RosbridgeRobot, StandsWhenNobodyOrdersOrTheBaseIsSilentOrInAnEmergency) {
  RosbridgeServer server;
  const auto driven = bridged(bridged_config(server));
  (void)drive_bridged(*driven, 0.7);
  ASSERT_GT(server.v_mps, 0.0);
  EXPECT_TRUE(server.stands_within(0.5)) << "nobody orders";
  (void)drive_bridged(*driven, 0.5);
  ASSERT_GT(server.v_mps, 0.0);
  server.say(R"({"op":"publish","topic":"/e_stop","msg":{"data":true}})");
  (void)drive_bridged(*driven, 0.3);
  EXPECT_EQ(server.v_mps, 0.0) << "emergency";
  server.say(R"({"op":"publish","topic":"/e_stop","msg":{"data":false}})");
  (void)drive_bridged(*driven, 0.5);
  ASSERT_GT(server.v_mps, 0.0);
  server.is_silent = true;
  std::thread again([&server] {
    EXPECT_TRUE(server.stands_within(0.5)) << "silent";
    server.is_silent = false;
  });
  EXPECT_EQ(driven->next({}).state, SensorState::observation);
  again.join();
}

TEST(RosbridgeRobot, StandsAtOnceWhenToldToOrDestroyed) {
  RosbridgeServer server;
  auto driven = bridged(bridged_config(server));
  (void)drive_bridged(*driven, 0.7);
  ASSERT_GT(server.v_mps, 0.0);
  driven->drive()->stop();
  EXPECT_TRUE(server.stands_within(0.15));
  (void)drive_bridged(*driven, 0.5);
  ASSERT_GT(server.v_mps, 0.0);
  driven.reset();
  EXPECT_TRUE(server.stands_within(0.3));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(server.v_mps, 0.0) << "and is not sent on by an earlier order";
}

TEST(RosbridgeRobot, StandsWhenItsProcessIsKilledOrHaltedAndGoesOnAfterwards) {
  for (const int signal : {SIGKILL, SIGSTOP}) {
    RosbridgeServer server;
    const std::string port = std::to_string(server.port());
    const pid_t process = ::fork();
    if (process == 0) {
      ::execl(CAIRN_ROSBRIDGE_DRIVER, CAIRN_ROSBRIDGE_DRIVER, port.c_str(), nullptr);
      ::_exit(127);
    }
    ASSERT_TRUE(server.drives_within(20.0)) << signal;
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    const double begin_s = live::now_s();
    ::kill(process, signal);
    EXPECT_TRUE(server.stands_within(0.5)) << signal;
    std::cout << (signal == SIGKILL ? "SIGKILL" : "SIGSTOP") << ": the wheels stand after " << live::now_s() - begin_s
              << " s\n";
    ::kill(process, SIGCONT);
    if (signal == SIGSTOP) {
      EXPECT_TRUE(server.drives_within(1.0));
    }
    ::kill(process, SIGKILL);
    ::waitpid(process, nullptr, 0);
    EXPECT_TRUE(server.stands_within(0.5)) << signal;
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    EXPECT_EQ(server.v_mps, 0.0) << signal;
    EXPECT_EQ(server.connections(), 0) << "the guard has ended, too";
  }
}

TEST(RosbridgeRobot, SaysWhoIsThereWhenItsTopicIsNot) {
  RosbridgeServer server;
  Config config = bridged_config(server);
  config.odometry = "/odon";
  config.stop_when.reconnect_s = 1.0;
  EXPECT_THAT(bridged(config)->next({}).reason,
              HasSubstr("nobody publishes /odon (did you mean \"/odom\"?); there are /cmd_vel, /e_stop, /imu, /odom"));
  server.has_rosapi = false;
  EXPECT_THAT(bridged(config)->next({}).reason, HasSubstr("nothing comes on /odon: does its driver run?"));
}

TEST(RosbridgeRobot, SaysThatThereIsNoServer) {
  Config config;
  {
    const RosbridgeServer gone;
    config = bridged_config(gone);
  }
  config.stop_when.reconnect_s = 0.2;
  EXPECT_THAT(bridged(config)->next({}).reason, HasSubstr("/ cannot be connected to: Connection refused"));
}

TEST(RosbridgeRobot, SettingsThatCannotBeAreRefused) {
  const RosbridgeServer server;
  const auto refusal = [&](auto change) -> std::string {
    Config made = bridged_config(server);
    change(made);
    try {
      (void)link_to(made, bridged_robot());
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal([](Config& c) { c.odometry = "odom"; }),
              HasSubstr("rosbridge_robot: `odometry` is \"odom\"; a topic is given by its full name"));
  EXPECT_THAT(refusal([](Config& c) { c.path = "ws"; }), HasSubstr("`path` is \"ws\"; it begins with a slash"));
  EXPECT_THAT(refusal([](Config& c) { c.ranges[0].kind = ros::RangeKind::point_cloud2; }),
              HasSubstr("/sonar is a PointCloud2, which is not read in JSON"));
}

}  // namespace
}  // namespace cairn::rosbridge_robot
