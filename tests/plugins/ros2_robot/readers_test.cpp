// What a robot may say besides its odometry and its sonars: static frames, clouds, bumpers, fields; and who says it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>
#include <thread>

#include "framework/live/steady_time.hpp"
#include "plugins/ros2_robot/dds/endpoints.hpp"
#include "plugins/ros2_robot/messages.hpp"
#include "plugins/ros2_robot/ros2_robot.hpp"

namespace cairn::ros2_robot {
namespace {

using testing::HasSubstr;

// Two tests at once must not meet, nor those of the other file.
int own_domain() {
  return 1 + static_cast<int>(::getpid() % 99);
}

NetworkChoice network() {
  return {own_domain(), true, "", {}};
}

Config config() {
  Config made;
  made.domain = own_domain();
  made.network = Network::localhost;
  made.ranges = {{"/sonars", RangeKind::point_cloud, {}, 0}};
  return made;
}

RobotModel robot() {
  RobotModel model;
  model.sonars.resize(2);
  model.sonars[1].T_robot_sonar = {0.0, 0.1, 1.0};
  return model;
}

class Base {
 public:
  explicit Base(const Config& settings) : link(link_to(settings, robot())) {}

  Participant participant{network()};
  Entity odometry = participant.writer("/odom", nav_msgs_msg_dds__Odometry__desc);
  Entity other_odometry = participant.writer("/odom", nav_msgs_msg_dds__Odometry__desc);
  Entity cloud = participant.writer("/sonars", sensor_msgs_msg_dds__PointCloud__desc);
  Entity bumper = participant.writer("/bumper", std_msgs_msg_dds__Bool__desc);
  Entity field = participant.writer("/field", sensor_msgs_msg_dds__MagneticField__desc);
  std::unique_ptr<live::BaseLink> link;
  char base_frame[10] = "base_link";
  char cloud_frame[10] = "ring";

  void connect() const {
    std::string why;
    for (int i = 0; i < 5 && !link->connect({}, why); ++i) {
    }
  }
  void say_odometry(double stamp_s, const Entity* by = nullptr) {
    Odometry message{};
    message.header = {time_of(stamp_s), base_frame};
    message.child_frame_id = base_frame;
    message.pose.pose.orientation.w = 1.0;
    (void)dds_write((by == nullptr ? odometry : *by).get(), &message);
  }
  void say_cloud(double stamp_s, std::vector<geometry_msgs_msg_dds__Point32_> points) {
    PointCloud message{};
    message.header = {time_of(stamp_s), cloud_frame};
    message.points._buffer = points.data();
    message.points._length = static_cast<std::uint32_t>(points.size());
    (void)dds_write(cloud.get(), &message);
  }
  // What comes of what is said again and again; 3 s at most.
  [[nodiscard]] std::optional<Observation> wait_for(const std::function<void(double stamp_s)>& say,
                                                    const std::function<bool(const Observation&)>& is_it) {
    for (const double begin_s = live::now_s(); live::now_s() - begin_s < 3.0;) {
      stamp_s_ += 0.02;
      say(stamp_s_);
      std::vector<Observation> seen;
      EXPECT_TRUE(link->receive(seen));
      for (Observation& observation : seen)
        if (is_it(observation)) return std::move(observation);
    }
    return std::nullopt;
  }
  [[nodiscard]] std::string fault_of(const std::function<void(double stamp_s)>& say) {
    try {
      (void)wait_for(say, [](const Observation&) { return false; });
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

 private:
  double stamp_s_ = 1000.0;
};

Entity latched_frames(dds_entity_t participant) {
  dds_qos_t* const qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_durability_service(qos, 0, DDS_HISTORY_KEEP_LAST, 10, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED);
  const dds_entity_t topic =
      dds_create_topic(participant, &tf2_msgs_msg_dds__TFMessage__desc, "rt/tf_static", nullptr, nullptr);
  Entity writer(dds_create_writer(participant, topic, qos, nullptr));
  dds_delete_qos(qos);
  return writer;
}

bool has_ranges(const Observation& observation) {
  return observation.ranges.size() == 2;
}

TEST(Ros2Readers, ACloudIsARingOfSonarsInItsFrame) {
  Base base(config());
  const Entity frames = latched_frames(dds_get_participant(base.odometry.get()));
  geometry_msgs_msg_dds__TransformStamped_ ring{};
  ring.header.frame_id = base.base_frame;
  ring.child_frame_id = base.cloud_frame;
  ring.transform.translation.x = 0.5;
  ring.transform.rotation.w = 1.0;
  TFMessage all{};
  all.transforms._buffer = &ring;
  all.transforms._length = 1;
  ASSERT_EQ(dds_write(frames.get(), &all), 0) << "before anybody reads it";
  base.connect();
  const auto seen = base.wait_for(
      [&](double stamp_s) {
        base.say_cloud(stamp_s, {{1.5F, 0.0F, 0.0F}, {-0.5F, 1.1F, 0.0F}});
        base.say_odometry(stamp_s);
      },
      has_ranges);
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen->ranges[0].range_m, 2.0, 1e-6) << "1.5 m before the ring, which is 0.5 m before the robot";
  EXPECT_NEAR(seen->ranges[1].range_m, 1.0, 1e-6);
  EXPECT_EQ(seen->ranges[1].sensor, 1);
}

TEST(Ros2Readers, ACloudWithMorePointsThanTheFileHasSonarsIsAFault) {
  Base base(config());
  base.connect();
  EXPECT_THAT(base.fault_of([&](double stamp_s) {
    base.say_cloud(stamp_s, {{}, {}, {}});
    base.say_odometry(stamp_s);
  }),
              HasSubstr("/sonars: has 3 points, and the robot's file 2 sonars from number 0 on"));
}

TEST(Ros2Readers, ReadingsWaitForTheOdometryOfTheirTime) {
  Config made = config();
  made.mounting = Mounting::file;
  Base base(made);
  base.connect();
  const auto has_any = [](const Observation& observation) { return !observation.ranges.empty(); };
  const auto warm = base.wait_for(
      [&](double stamp_s) {
        base.say_cloud(stamp_s, {{1.0F, 0.0F, 0.0F}});
        base.say_odometry(stamp_s);
      },
      has_any);
  ASSERT_TRUE(warm);
  const auto only_odometry = [&](double stamp_s) { base.say_odometry(stamp_s); };
  ASSERT_TRUE(
      base.wait_for(only_odometry, [&](const Observation& seen) { return seen.stamp_s > warm->stamp_s + 0.3; }));
  double cloud_s = 0.0;
  const auto seen = base.wait_for(
      [&](double stamp_s) {
        if (cloud_s == 0.0) base.say_cloud(cloud_s = stamp_s + 0.1, {{1.0F, 0.0F, 0.0F}});
        base.say_odometry(stamp_s);
      },
      has_any);
  ASSERT_TRUE(seen);
  EXPECT_GE(seen->stamp_s, cloud_s - 1e-3);
  EXPECT_LT(seen->stamp_s, cloud_s + 0.5);
}

TEST(Ros2Readers, BumpersAndTheEarthsFieldAreRead) {
  Config made = config();
  made.bumpers = {"/bumper"};
  made.compass = {"/field", CompassKind::magnetic_field, 0.25};
  Base base(made);
  base.connect();
  const auto seen = base.wait_for(
      [&](double stamp_s) {
        const Bool touched{true};
        (void)dds_write(base.bumper.get(), &touched);
        MagneticField north{};
        north.header = {time_of(stamp_s), base.base_frame};
        north.magnetic_field.x = 2e-5;
        (void)dds_write(base.field.get(), &north);
        base.say_odometry(stamp_s);
      },
      [](const Observation& observation) { return observation.bumped && observation.compass_rad; });
  ASSERT_TRUE(seen);
  EXPECT_NEAR(*seen->compass_rad, 0.25, 1e-9);
}

TEST(Ros2Readers, TwoWhoSendTheOdometryByTurnsAreAFaultAndOneAfterAnotherIsNot) {
  Base base(config());
  base.connect();
  const auto first =
      base.wait_for([&](double stamp_s) { base.say_odometry(stamp_s); }, [](const Observation&) { return true; });
  ASSERT_TRUE(first);
  EXPECT_TRUE(base.wait_for([&](double stamp_s) { base.say_odometry(stamp_s, &base.other_odometry); },
                            [&](const Observation& seen) { return seen.stamp_s > first->stamp_s + 0.1; }));
  EXPECT_THAT(base.fault_of([&](double stamp_s) {
    base.say_odometry(stamp_s);
    base.say_odometry(stamp_s, &base.other_odometry);
  }),
              HasSubstr("two publish /odom: end one of them"));
}

}  // namespace
}  // namespace cairn::ros2_robot
