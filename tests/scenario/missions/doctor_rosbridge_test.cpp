// `cairn doctor live` looks at a robot behind a rosbridge_server; a run of it is recorded, and its record draws the
// same map.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "maps/store/map_store.hpp"
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

TEST(DoctorRosbridge, SaysTypeRateAgeFrameAndClockOfEachTopic) {
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

TEST(LiveRecording, OfARobotBehindRosbridgePlayedBackGivesTheSameMapBitForBit) {
  const rosbridge_robot::RosbridgeServer server;
  const auto mission = doctor_mission("rosbridge_recording", bridged_sensor(server));
  const auto folder = mission.parent_path();
  const Finished first = run_cairn({"run", mission.string(), "--set", "steps=[wait: 3]", "--out", folder.string()});
  ASSERT_EQ(first.exit_status, 0) << first.out << first.err;
  write_text(folder / "replay.yaml",
             "mission: replay\nrobot: robot.yaml\nsensor: {plugin: carmen_log, file: rosbridge_recording.log.gz}\n"
             "localizer: {plugin: odometry_compass}\nmap: {plugin: muriel}\n");
  const Finished second = run_cairn({"run", (folder / "replay.yaml").string(), "--out", folder.string()});
  ASSERT_EQ(second.exit_status, 0) << second.out << second.err;
  const SavedMap recorded = load_map((folder / "rosbridge_recording.cairn").string());
  const SavedMap replayed = load_map((folder / "replay.cairn").string());
  EXPECT_GT(recorded.grid.bounds().width(), 10);
  EXPECT_TRUE(recorded.grid == replayed.grid) << "OG1 differs";
}

TEST(LiveRecording, AnotherRunKeepsTheEarlierOneAndNoneMakesNone) {
  const rosbridge_robot::RosbridgeServer server;
  const auto mission = doctor_mission("rosbridge_twice", bridged_sensor(server));
  const auto folder = mission.parent_path() / "out";
  const std::vector<std::string> run{"run", mission.string(), "--set", "steps=[wait: 1]", "--out", folder.string()};
  ASSERT_EQ(run_cairn(run).exit_status, 0);
  const std::string first = text_of_file(folder / "rosbridge_twice.log.gz");
  ASSERT_EQ(run_cairn(run).exit_status, 0);
  EXPECT_EQ(text_of_file(folder / "rosbridge_twice.log.gz"), first);
  EXPECT_TRUE(std::filesystem::exists(folder / "rosbridge_twice.2.log.gz"));
  std::vector<std::string> unrecorded = run;
  unrecorded.insert(unrecorded.end(), {"--set", "record=none"});
  ASSERT_EQ(run_cairn(unrecorded).exit_status, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "rosbridge_twice.3.log.gz"));
  EXPECT_FALSE(std::filesystem::exists(folder / "none"));
}

TEST(LiveRecording, ASimulationMakesNone) {
  const auto folder = fresh_folder("simulation_recording");
  const Finished run = run_cairn(
      {"run", source_folder() + "/config/missions/office.yaml", "--set", "steps=[wait: 1]", "--out", folder.string()});
  ASSERT_EQ(run.exit_status, 0) << run.out << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "office.log.gz"));
}

TEST(LiveRecording, AResumedRunReplacesNone) {
  const auto folder = fresh_folder("resumed_recording");
  std::vector<std::string> run{"run", source_folder() + "/config/missions/office.yaml", "--out", folder.string()};
  for (const char* setting : {"steps=[wait: 1]", "record=run.log", "record_mcap=run.mcap"})
    run.insert(run.end(), {"--set", setting});
  ASSERT_EQ(run_cairn(run).exit_status, 0);
  const std::string log = text_of_file(folder / "run.log");
  const std::string mcap = text_of_file(folder / "run.mcap");
  run.insert(run.end(), {"--resume", (folder / "office.cairn").string()});
  (void)run_cairn(run);
  EXPECT_EQ(text_of_file(folder / "run.log"), log);
  EXPECT_EQ(text_of_file(folder / "run.mcap"), mcap);
  EXPECT_TRUE(std::filesystem::exists(folder / "run.2.log"));
  EXPECT_TRUE(std::filesystem::exists(folder / "run.2.mcap"));
}

}  // namespace
}  // namespace cairn::testing_program
