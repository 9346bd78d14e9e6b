// Missions that are watched on their control socket while they run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "framework/program/mission/control_socket.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class WatchedMissions : public testing::Test {
 protected:
  WatchedMissions() : folder_(fresh_folder("watch")) {
    const std::string config = source_folder() + "/config/";
    write_text(folder_ / "world.yaml",
               "bounds_m: [[0, 0], [3, 3]]\nwalls: [{points_m: [[0, 0], [3, 0], [3, 3], [0, 3], [0, 0]]}]\n");
    write_text(mission_, "mission: held\nseed: 3\nrobot: " + config +
                             "robots/pioneer1.yaml\nworld: world.yaml\n"
                             "start: {at_m: [0.6, 0.6], angle_deg: 0}\n"
                             "sensor: {plugin: simulated_robot}\nlocalizer: {plugin: odometry_compass}\n"
                             "map: {plugin: muriel, cell_m: 0.05}\nplanner: {plugin: hybrid}\n"
                             "steps: [{explore: {until_known_ratio: 1.0, at_most_s: 60}}, {goto: [2, 2]}]\n");
  }
  ~WatchedMissions() override { fs::remove_all(folder_); }

  // Slow enough to be watched.
  [[nodiscard]] std::vector<std::string> run_into(const fs::path& out, const std::string& pace) const {
    return {"run", mission_.string(), "--out", out.string(), "--pace", pace};
  }
  // Once it listens.
  static Descriptor watch(const fs::path& out) {
    for (int i = 0; i < 2000; ++i) {
      try {
        MissionConnection connection = connect_to_mission(out);
        if (connection.reached == Reached::answered && write_line(connection.socket.get(), "watch"))
          return std::move(connection.socket);
      } catch (const std::exception&) {  // there is no folder yet
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ADD_FAILURE() << "never listened";
    return Descriptor();
  }
  static std::string all_of(const Descriptor& socket, std::size_t max_bytes) {
    std::string text;
    char piece[65536];
    for (ssize_t got = 1; text.size() < max_bytes && (got = ::recv(socket.get(), piece, sizeof piece, 0)) > 0;)
      text.append(piece, static_cast<std::size_t>(got));
    return text;
  }
  void expect_same(const fs::path& a, const fs::path& b) const {
    for (const char* file : {"held.cairn", "report.json", "track.json"})
      EXPECT_TRUE(text_of_file(folder_ / a / file) == text_of_file(folder_ / b / file)) << b << ": " << file;
  }

  fs::path folder_;
  fs::path mission_ = folder_ / "mission.yaml";
};

TEST_F(WatchedMissions, GiveTheSameBytesAsAlone) {
  EXPECT_EQ(run_cairn(run_into(folder_ / "alone", "1000")).exit_status, 0);
  std::string stream;
  {
    Conversation run(run_into(folder_ / "watched", "20"));
    stream = all_of(watch(folder_ / "watched"), 1'000'000'000);
    EXPECT_EQ(run.exit_status(), 0);
  }
  expect_same("alone", "watched");
  {
    Conversation run(run_into(folder_ / "stalled", "20"));
    const Descriptor stalled = watch(folder_ / "stalled");
    EXPECT_EQ(run.exit_status(), 0);
  }
  expect_same("alone", "stalled");
  {
    Conversation run(run_into(folder_ / "left", "20"));
    (void)all_of(watch(folder_ / "left"), 10'000);  // and it has gone
    EXPECT_EQ(run.exit_status(), 0);
  }
  expect_same("alone", "left");

  std::istringstream lines(stream);
  std::vector<json> frames;
  for (std::string line; std::getline(lines, line);) frames.push_back(json::parse(line));
  ASSERT_GE(frames.size(), 5U);
  EXPECT_EQ(frames[0]["tree"][1]["kind"], "goto");
  EXPECT_EQ(frames.back()["status"]["outcome"], "done");
  EXPECT_THAT(stream, testing::HasSubstr(R"("nodes":[["1","running")"));
  EXPECT_THAT(stream, testing::HasSubstr(R"(["2","success")"));
  EXPECT_THAT(stream, testing::HasSubstr(R"("plan":{"time_s")"));
  EXPECT_THAT(stream, testing::HasSubstr("saved held.cairn")) << "what comes after the last tick";
}

}  // namespace
}  // namespace cairn::testing_program
