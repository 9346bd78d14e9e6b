// What people on a ROS 2 network see of a mission, and the goals that they give. They are another participant of the
// same domain, on this computer only.
#include "plugins/ros2_robot/display_topics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>
#include <thread>

#include "framework/live/live_robot.hpp"
#include "framework/live/steady_time.hpp"
#include "plugins/ros2_robot/ros2_robot.hpp"

namespace cairn::ros2_robot {
namespace {

using testing::HasSubstr;

int domain_of_display() {
  return 20 + static_cast<int>(::getpid() % 80);
}

NetworkChoice network_of_display() {
  return {domain_of_display(), true, "", {}};
}

bool comes_true(const std::function<bool()>& is_true, double within_s = 10.0) {
  for (const double begin_s = live::now_s(); live::now_s() - begin_s < within_s;
       std::this_thread::sleep_for(std::chrono::milliseconds(5)))
    if (is_true()) return true;
  return false;
}

// A mission to be shown, and somebody who looks on.
class Shown : public testing::Test {
 protected:
  Shown() {
    grid.set_log_odds({-2, -1}, -800);
    grid.set_log_odds({1, 0}, 800);
    Landmark square;
    square.category = "square";
    square.T_map_landmark = Pose2{1.0, 2.0, 0.0};
    square_id = graph.add(square);
    char frame[] = "odom";
    display.open(own);
    display.observed({time_of(12.5), frame}, Pose2{1.0, 0.0, 0.0});
  }
  void show() {
    const WorldView world{grid, graph, robot, pose, 3.0, &observation};
    display.show({world, path, {0.2, 0.0}, doing});
  }

  OccupancyGrid grid{0.5};
  LandmarkGraph graph;
  LandmarkId square_id = 0;
  RobotModel robot;
  PoseEstimate pose{Pose2{2.0, 1.0, 0.5}};
  Observation observation;
  std::vector<Pose2> path{Pose2{2.0, 1.0, 0.5}, Pose2{3.0, 1.0, 0.0}};
  std::string doing = "explore: drives to a lookout";
  ShownTopics shown{};
  std::string goal = "/goal_pose";
  Participant own{network_of_display()};
  Participant people{network_of_display()};
  DisplayTopics display{shown, goal};
};

// Shows until a message of the topic has come, and looks at it.
template <class Message>
bool is_shown(const Participant& people, const std::string& topic, const dds_topic_descriptor_t& type, Reading reading,
              const std::function<void()>& show, const std::function<void(const Message&)>& look,
              double within_s = 10.0) {
  const Entity reader = people.reader(topic, type, reading);
  int seen = 0;
  return comes_true(
      [&] {
        show();
        take_all<Message>(reader.get(), [&](const Message& message) {
          if (seen++ == 0) look(message);
        });
        return seen > 0;
      },
      within_s);
}

TEST_F(Shown, TheMapHasItsPlaceAndItsCells) {
  EXPECT_TRUE(is_shown<OccupancyGridMessage>(
      people, "/cairn/map", nav_msgs_msg_dds__OccupancyGrid__desc, Reading::latched, [this] { show(); },
      [](const OccupancyGridMessage& map) {
        EXPECT_STREQ(map.header.frame_id, "map");
        EXPECT_EQ(seconds_of(map.header.stamp), 12.5);
        ASSERT_EQ(map.info.width, 4U);
        ASSERT_EQ(map.info.height, 2U);
        EXPECT_FLOAT_EQ(map.info.resolution, 0.5F);
        EXPECT_DOUBLE_EQ(map.info.origin.position.x, -1.0);
        EXPECT_DOUBLE_EQ(map.info.origin.position.y, -0.5);
        ASSERT_EQ(map.data._length, 8U);
        EXPECT_EQ(static_cast<std::int8_t>(map.data._buffer[0]), 4);
        EXPECT_EQ(static_cast<std::int8_t>(map.data._buffer[1]), -1);
        EXPECT_EQ(static_cast<std::int8_t>(map.data._buffer[7]), 96);
      }));
}

TEST_F(Shown, WhoeverComesLaterGetsTheLastMapToo) {
  const Entity first = people.reader("/cairn/map", nav_msgs_msg_dds__OccupancyGrid__desc);
  int seen = 0;
  ASSERT_TRUE(comes_true([&] {
    show();
    take_all<OccupancyGridMessage>(first.get(), [&](const OccupancyGridMessage&) { ++seen; });
    return seen > 0;
  }));
  // Nothing is sent any more.
  EXPECT_TRUE(is_shown<OccupancyGridMessage>(
      people, "/cairn/map", nav_msgs_msg_dds__OccupancyGrid__desc, Reading::latched, [] {},
      [](const OccupancyGridMessage& map) { EXPECT_EQ(map.data._length, 8U); }));
}

TEST_F(Shown, APoseWithItsCovariance) {
  pose.covariance.diagonal() = Eigen::Vector3d(0.04, 0.09, 0.01);
  pose.covariance(0, 2) = pose.covariance(2, 0) = 0.005;
  EXPECT_TRUE(is_shown<PoseWithCovarianceStamped>(
      people, "/cairn/pose", geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc, Reading::reliable,
      [this] { show(); },
      [](const PoseWithCovarianceStamped& message) {
        const std::optional<Pose2> seen = pose_of(message.pose.pose);
        ASSERT_TRUE(seen);
        EXPECT_NEAR(seen->x_m, 2.0, 1e-12);
        EXPECT_NEAR(seen->theta_rad, 0.5, 1e-12);
        EXPECT_EQ(message.pose.covariance[0], 0.04);
        EXPECT_EQ(message.pose.covariance[7], 0.09);
        EXPECT_EQ(message.pose.covariance[35], 0.01);
        EXPECT_EQ(message.pose.covariance[5], 0.005);
        EXPECT_EQ(message.pose.covariance[30], 0.005);
      }));
}

TEST_F(Shown, ThePlanAndItsEnd) {
  const Entity reader = people.reader("/cairn/plan", nav_msgs_msg_dds__Path__desc, Reading::reliable);
  std::vector<std::uint32_t> lengths;
  const auto shown_twice = [&] {
    show();
    if (!lengths.empty()) path.clear();
    take_all<Path>(reader.get(), [&](const Path& plan) { lengths.push_back(plan.poses._length); });
    return lengths.size() == 2;
  };
  EXPECT_TRUE(comes_true(shown_twice));
  EXPECT_THAT(lengths, testing::ElementsAre(2U, 0U));
}

TEST_F(Shown, LandmarksWithTheirNames) {
  EXPECT_TRUE(is_shown<MarkerArray>(
      people, "/cairn/landmarks", visualization_msgs_msg_dds__MarkerArray__desc, Reading::reliable, [this] { show(); },
      [this](const MarkerArray& markers) {
        ASSERT_EQ(markers.markers._length, 3U);
        EXPECT_EQ(markers.markers._buffer[0].action, 3);
        EXPECT_EQ(markers.markers._buffer[1].id, static_cast<int>(square_id));
        EXPECT_EQ(markers.markers._buffer[1].pose.position.y, 2.0);
        EXPECT_EQ(markers.markers._buffer[2].text, "L" + std::to_string(square_id) + " square");
      }));
}

TEST_F(Shown, DiagnosticsWarnWhileTheRobotIsLost) {
  pose.trust = PoseTrust::lost;
  EXPECT_TRUE(is_shown<DiagnosticArray>(
      people, "/diagnostics", diagnostic_msgs_msg_dds__DiagnosticArray__desc, Reading::reliable, [this] { show(); },
      [](const DiagnosticArray& diagnostics) {
        ASSERT_EQ(diagnostics.status._length, 1U);
        EXPECT_EQ(diagnostics.status._buffer[0].level, 1);
        EXPECT_STREQ(diagnostics.status._buffer[0].message, "explore: drives to a lookout");
      }));
}

TEST_F(Shown, ALostRobotIsOnNoMap) {
  pose.trust = PoseTrust::lost;
  EXPECT_FALSE(is_shown<OccupancyGridMessage>(
      people, "/cairn/map", nav_msgs_msg_dds__OccupancyGrid__desc, Reading::latched, [this] { show(); },
      [](const OccupancyGridMessage&) {}, 1.5));
}

TEST_F(Shown, TheTransformOnlyWhenItIsAskedFor) {
  EXPECT_FALSE(shown.tf);
  ShownTopics with_tf;
  with_tf.tf = true;
  DisplayTopics other(with_tf, goal);
  other.open(own);
  char frame[] = "odom";
  other.observed({time_of(12.5), frame}, Pose2{1.0, 0.0, 0.0});
  const WorldView world{grid, graph, robot, PoseEstimate{Pose2{2.0, 1.0, 0.0}}, 3.0, &observation};
  EXPECT_TRUE(is_shown<TFMessage>(
      people, "/tf", tf2_msgs_msg_dds__TFMessage__desc, Reading::reliable,
      [&] {
        other.show({world, path, {}, doing});
      },
      [](const TFMessage& transforms) {
        ASSERT_EQ(transforms.transforms._length, 1U);
        EXPECT_STREQ(transforms.transforms._buffer[0].child_frame_id, "odom");
        EXPECT_DOUBLE_EQ(transforms.transforms._buffer[0].transform.translation.x, 1.0);
        EXPECT_DOUBLE_EQ(transforms.transforms._buffer[0].transform.translation.y, 1.0);
      }));
}

TEST_F(Shown, AGoalIsAnOrder) {
  const Entity writer = people.writer("/goal_pose", geometry_msgs_msg_dds__PoseStamped__desc);
  ASSERT_TRUE(comes_true([&] { return is_read(writer); }));
  char frame[] = "map";
  char other[] = "odom";
  PoseStamped message{{time_of(1.0), frame}, {{1.5, -2.0, 0.0}, {0.0, 0.0, 1.0, 0.0}}};
  (void)dds_write(writer.get(), &message);
  std::optional<DisplayOrder> given;
  const auto is_given = [&] { return (given = display.next_order()).has_value(); };
  ASSERT_TRUE(comes_true(is_given));
  EXPECT_EQ(given->text, R"({"goto":{"at_m":[1.5000,-2.0000],"angle_deg":180.00}})");
  EXPECT_EQ(given->problem, "");
  message.header.frame_id = other;
  (void)dds_write(writer.get(), &message);
  ASSERT_TRUE(comes_true(is_given));
  EXPECT_THAT(given->problem, HasSubstr("the goal on /goal_pose is in the frame odom, and the map in map"));
  EXPECT_FALSE(display.next_order());
}

Config config_with_start(double wait_s) {
  Config made;
  made.domain = domain_of_display();
  made.network = Network::localhost;
  made.ranges = {{"/sonar", RangeKind::range, {}, 0}};
  made.initial_pose = {"/initialpose", wait_s};
  return made;
}

TEST(InitialPose, IsWhereTheRobotBegins) {
  RobotModel robot;
  robot.sonars.resize(1);
  const Participant people(network_of_display());
  const Entity writer = people.writer("/initialpose", geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc);
  const Config config = config_with_start(20.0);
  const live::LiveRobot driven(link_to(config, robot), config.stop_when, robot);
  std::thread giver([&] {
    EXPECT_TRUE(comes_true([&] { return is_read(writer); }));
    char frame[] = "map";
    PoseWithCovarianceStamped message{};
    message.header.frame_id = frame;
    message.pose.pose = {{4.0, 5.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
    (void)dds_write(writer.get(), &message);
  });
  const std::optional<Pose2> start = driven.start();
  giver.join();
  ASSERT_TRUE(start);
  EXPECT_EQ(*start, (Pose2{4.0, 5.0, 0.0}));
}

TEST(InitialPose, IsSaidToBeWaitedForAndTheWaitCanBeCancelled) {
  RobotModel robot;
  robot.sonars.resize(1);
  const Config config = config_with_start(600.0);
  std::atomic<bool> cancel = false;
  const live::LiveRobot driven(link_to(config, robot, Budget{.cancel = &cancel}), config.stop_when, robot);
  EXPECT_EQ(driven.waits_for(), "");
  std::thread canceller([&] {
    EXPECT_TRUE(comes_true([&] { return !driven.waits_for().empty(); }));
    EXPECT_THAT(driven.waits_for(), HasSubstr("waiting for a pose on /initialpose in the frame map of ROS domain "));
    EXPECT_THAT(driven.waits_for(), HasSubstr(", 600 s at most"));
    cancel = true;
  });
  EXPECT_FALSE(driven.start());
  canceller.join();
  EXPECT_EQ(driven.waits_for(), "");
}

TEST(InitialPose, ThatNobodyGivesIsAFault) {
  RobotModel robot;
  robot.sonars.resize(1);
  const Config config = config_with_start(1.0);
  const live::LiveRobot driven(link_to(config, robot), config.stop_when, robot);
  try {
    (void)driven.start();
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "nobody has given a pose on /initialpose in the frame map for 1 s");
  }
}

}  // namespace
}  // namespace cairn::ros2_robot
