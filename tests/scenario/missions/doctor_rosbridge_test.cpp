// `cairn doctor live` looks at a robot behind a rosbridge_server; a run of it is recorded, and its record draws the
// same map.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/plugins/rosbridge_robot/rosbridge_server.hpp"
#include "tests/scenario/missions/doctor_mission.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string bridged_sensor(const rosbridge_robot::RosbridgeServer& server) {
  return "plugin: rosbridge_robot, host: 127.0.0.1, port: " + std::to_string(server.port()) +
         ", ranges: [{topic: /sonar}]";
}

TEST(DoctorRosbridge, SaysTypeRateAgeFrameAndClockOfEachTopicAndWiggles) {
  const rosbridge_robot::RosbridgeServer server;
  const auto mission = doctor_mission("doctor_rosbridge", bridged_sensor(server));
  const Finished finished = run_cairn({"doctor", "live", mission.string(), "--for", "1"});
  EXPECT_EQ(finished.exit_status, 0) << finished.out << finished.err;
  EXPECT_THAT(finished.out,
              AllOf(HasSubstr("ok  connection"), HasSubstr(" ros 2; rosapi 6 topics; messages not understood 0\n"),
                    HasSubstr("type nav_msgs/msg/Odometry; rate "), HasSubstr("; frame sonar_1; clock "),
                    HasSubstr("type geometry_msgs/msg/Twist; heard by 1 subscriber\n")));
  EXPECT_EQ(server.v_mps, 0.0);
  EXPECT_EQ(server.connections(), 0);
}

TEST(DoctorRosbridge, NamesAVersionOfRosThatIsNotTheServers) {
  const rosbridge_robot::RosbridgeServer server(1);
  const auto mission = doctor_mission("doctor_rosbridge_ros1", bridged_sensor(server));
  const Finished finished = run_cairn({"doctor", "live", mission.string(), "--for", "1"});
  EXPECT_EQ(finished.exit_status, 1);
  EXPECT_THAT(finished.out, AllOf(HasSubstr("BAD connection"),
                                  HasSubstr("rosbridge says: subscribe: Tried to subscribe to topic /odom")));
}

}  // namespace
}  // namespace cairn::testing_program
