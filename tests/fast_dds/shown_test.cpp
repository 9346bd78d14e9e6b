// What Cairn shows of a mission, as somebody with Fast DDS reads it, and the goals that they give.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plugins/ros2_robot/display_topics.hpp"
#include "tests/fast_dds/messages_by_hand.hpp"
#include "tests/fast_dds/stranger.hpp"

namespace cairn::fast_dds {
namespace {

using testing::ElementsAre;

class ShownToAStranger : public testing::Test {
 protected:
  ShownToAStranger() {
    grid.set_log_odds({-2, -1}, -800);
    grid.set_log_odds({1, 0}, 800);
    Landmark square;
    square.category = "square";
    square.T_map_landmark = Pose2{1.0, 2.0, 0.0};
    graph.add(square);
    pose.covariance.diagonal() = Eigen::Vector3d(0.04, 0.09, 0.01);
    shown.tf = true;
    char frame[] = "odom";
    display.open(own);
    display.observed({ros2_robot::time_of(12.5), frame}, Pose2{1.0, 0.0, 0.0});
  }
  void show() {
    const WorldView world{grid, graph, robot, pose, 3.0, &observation};
    display.show({world, path, {0.2, 0.0}, doing});
  }
  // The first message of a topic; shows until it has come.
  Bytes first_of(const std::string& topic, const std::string& type, Offer wish = {}) {
    const auto reader = people.reader(topic, type, wish);
    Bytes first;
    (void)comes_true([&] {
      show();
      std::vector<Bytes> all = reader->take();
      if (!all.empty()) first = std::move(all.front());
      return !first.empty();
    });
    return first;
  }

  OccupancyGrid grid{0.5};
  LandmarkGraph graph;
  RobotModel robot;
  PoseEstimate pose{Pose2{2.0, 1.0, 0.0}};
  Observation observation;
  std::vector<Pose2> path{Pose2{2.0, 1.0, 0.0}, Pose2{3.0, 1.0, 0.0}};
  std::string doing = "explore";
  ros2_robot::ShownTopics shown{};
  std::string goal = "/goal_pose";
  ros2_robot::Participant own{{own_domain(), true, "", {}}};
  Stranger people{own_domain()};
  ros2_robot::DisplayTopics display{shown, goal};
};

TEST_F(ShownToAStranger, TheMapAlsoForThoseWhoComeLate) {
  constexpr const char* kGrid = "nav_msgs::msg::dds_::OccupancyGrid_";
  const Bytes first = first_of("/cairn/map", kGrid);
  ASSERT_FALSE(first.empty());
  HandGrid read;
  EXPECT_EQ(read_all(first, [&](Cdr& from) { read = read_grid(from); }), 0U);
  EXPECT_EQ(read.header.frame, "map");
  EXPECT_EQ(read.header.sec, 12);
  EXPECT_EQ(read.resolution, 0.5F);
  EXPECT_EQ(read.width, 4U);
  EXPECT_EQ(read.height, 2U);
  EXPECT_THAT(read.origin, ElementsAre(-1.0, -0.5, 0.0, 0.0, 0.0, 0.0, 1.0));
  EXPECT_THAT(read.cells, ElementsAre(4, 255, 255, 255, 255, 255, 255, 96));
  // Nothing is written any more.
  const auto late = people.reader("/cairn/map", kGrid, Offer{true, true});
  std::vector<Bytes> all;
  EXPECT_TRUE(comes_true([&] {
    all = late->take();
    return !all.empty();
  }));
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all[0], first);
}

TEST_F(ShownToAStranger, ThePose) {
  const Bytes first = first_of("/cairn/pose", "geometry_msgs::msg::dds_::PoseWithCovarianceStamped_");
  ASSERT_FALSE(first.empty());
  PoseNumbers read{};
  std::array<double, 36> covariance{};
  EXPECT_EQ(read_all(first,
                     [&](Cdr& from) {
                       (void)read_header(from);
                       from >> read >> covariance;
                     }),
            0U);
  EXPECT_THAT(read, ElementsAre(2.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0));
  EXPECT_EQ(covariance[7], 0.09);
  EXPECT_EQ(covariance[35], 0.01);
}

TEST_F(ShownToAStranger, ThePlan) {
  const Bytes first = first_of("/cairn/plan", "nav_msgs::msg::dds_::Path_");
  ASSERT_FALSE(first.empty());
  std::vector<double> x_m;
  EXPECT_EQ(read_all(first,
                     [&](Cdr& from) {
                       (void)read_header(from);
                       std::uint32_t count = 0;
                       from >> count;
                       for (std::uint32_t i = 0; i < count; ++i) {
                         (void)read_header(from);
                         PoseNumbers numbers{};
                         from >> numbers;
                         x_m.push_back(numbers[0]);
                       }
                     }),
            0U);
  EXPECT_THAT(x_m, ElementsAre(2.0, 3.0));
}

TEST_F(ShownToAStranger, Landmarks) {
  const Bytes first = first_of("/cairn/landmarks", "visualization_msgs::msg::dds_::MarkerArray_");
  ASSERT_FALSE(first.empty());
  std::vector<HandMarker> markers;
  EXPECT_EQ(read_all(first,
                     [&](Cdr& from) {
                       std::uint32_t count = 0;
                       from >> count;
                       for (std::uint32_t i = 0; i < count; ++i) markers.push_back(read_marker(from));
                     }),
            0U);
  ASSERT_EQ(markers.size(), 3U);
  EXPECT_THAT(markers[0].id_type_action, ElementsAre(0, 0, 3));
  EXPECT_EQ(markers[1].group, "landmarks");
  EXPECT_THAT(markers[1].pose, ElementsAre(1.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0));
  EXPECT_EQ(markers[2].text, "L1 square");
}

TEST_F(ShownToAStranger, DiagnosticsAndTheTransform) {
  std::vector<HandStatus> read;
  const Bytes first = first_of("/diagnostics", "diagnostic_msgs::msg::dds_::DiagnosticArray_");
  ASSERT_FALSE(first.empty());
  EXPECT_EQ(read_all(first, [&](Cdr& from) { read = read_diagnostics(from); }), 0U);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].message, "explore");
  EXPECT_EQ(read[0].values[0], (std::pair<std::string, std::string>("pose", "tracking")));
  std::vector<HandTransform> transforms;
  const Bytes transform = first_of("/tf", "tf2_msgs::msg::dds_::TFMessage_");
  ASSERT_FALSE(transform.empty());
  EXPECT_EQ(read_all(transform, [&](Cdr& from) { transforms = read_transforms(from); }), 0U);
  ASSERT_EQ(transforms.size(), 1U);
  EXPECT_EQ(transforms[0].header.frame, "map");
  EXPECT_EQ(transforms[0].child, "odom");
  EXPECT_THAT(transforms[0].pose, ElementsAre(1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0));
}

TEST_F(ShownToAStranger, TheirGoalIsAnOrder) {
  const auto writer = people.writer("/goal_pose", "geometry_msgs::msg::dds_::PoseStamped_");
  // Their writer knows of our reader before our reader knows of them; what is written between is for nobody.
  std::optional<DisplayOrder> given;
  ASSERT_TRUE(comes_true([&] {
    writer->write(written([](Cdr& to) {
      write_header(to, {1, 0, "map"});
      to << PoseNumbers{1.5, -2.0, 0.0, 0.0, 0.0, 0.0, 1.0};
    }));
    return (given = display.next_order()).has_value();
  }));
  EXPECT_EQ(given->text, R"({"goto":{"at_m":[1.5000,-2.0000],"angle_deg":0.00}})");
}

}  // namespace
}  // namespace cairn::fast_dds
