// Every shipped module of kind `sensor` passes the suite of its kind.
#include "tests/conformance/sensor.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <optional>

#include "framework/live/line_socket.hpp"
#include "framework/live/served_robot.hpp"

namespace cairn::conformance {
namespace {

const std::filesystem::path kModules = std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn";

const std::string kLog = std::string("{file: \"") + CAIRN_SOURCE_DIR + R"(/tests/data/three_sonars.log",
  time_column: 1, x_column: 2, y_column: 3, heading_column: 4, compass_from_pose: true, first_range_column: 5,
  sonars: [{angle_deg: 90}, {angle_deg: 0}, {angle_deg: -90}]})";

const std::string kCarmen =
    std::string("{file: \"") + CAIRN_SOURCE_DIR + "/tests/data/carmen.log\", compass_from_pose: true}";

std::string config_of(const std::string& file) {
  return std::string("{file: \"") + CAIRN_SOURCE_DIR + "/tests/data/" + file + "\"}";
}

const std::string kDerived =
    std::string("{source: {plugin: carmen_log, file: \"") + CAIRN_SOURCE_DIR + "/tests/data/carmen.log\"}}";

const std::string kPictures = std::string("{log: {plugin: carmen_log, file: \"") + CAIRN_SOURCE_DIR +
                              "/tests/data/carmen.log\"}, pictures: [{list: rgb.txt}]}";

const std::string kLego = std::string("{file: \"") + CAIRN_SOURCE_DIR + "/tests/data/lego_scans.log\", motors: \"" +
                          CAIRN_SOURCE_DIR + "/tests/data/lego_motors.log\", compass_from_pose: true}";

const std::string kBag =
    std::string("{file: \"") + CAIRN_SOURCE_DIR + "/tests/data/bag.mcap\", ranges: [/scan, /sonar/left, /sonar/right]}";

// Bases without a time of their own: a simulated robot for each connection, an observation each time that it is asked.
class Bases {
 public:
  Bases() : listening_(live::listen_at({path(), {}, 0})), accepting_([this] { accept_all(); }) {}
  ~Bases() {
    is_over_ = true;
    accepting_.join();
    serving_.clear();
    std::filesystem::remove(path());
  }
  static std::string path() {
    return (std::filesystem::path(testing::TempDir()) / ("cairn_bases_" + std::to_string(::getpid()))).string();
  }

 private:
  static constexpr int kNap_ms = 20;
  static constexpr int kTicks = 3000;  // then what it says is no observation, which ends it for good
  static bool has_text(const Descriptor& socket) {
    pollfd ready{socket.get(), POLLIN, 0};
    return ::poll(&ready, 1, kNap_ms) == 1;
  }
  void accept_all() {
    while (!is_over_)
      if (has_text(listening_))
        serving_.emplace_back([this, fd = ::accept(listening_.get(), nullptr, nullptr)] { serve(Descriptor(fd)); });
  }
  void serve(const Descriptor client) const {
    const Subject<Sensor> robot = module<Sensor>(kModules, "simulated_robot");
    live::ServedRobot served(robot.make(), robot.setup().robot);
    live::LineReader reader;
    int ticks = 0;
    while (!is_over_) {
      if (!has_text(client)) continue;
      if (!reader.read(client.get())) return;
      while (const auto line = reader.next()) {
        (void)served.take(*line);
        if (served.take_request())
          (void)live::send_now(client.get(), (++ticks > kTicks ? "the end" : served.tick().line) + "\n");
      }
    }
  }

  std::atomic<bool> is_over_ = false;
  Descriptor listening_;
  std::vector<std::jthread> serving_;
  std::thread accepting_;
};

class BasesOfTheTests : public testing::Environment {
 public:
  void SetUp() override { bases_.emplace(); }
  void TearDown() override { bases_.reset(); }

 private:
  std::optional<Bases> bases_;
};
[[maybe_unused]] const testing::Environment* const kBases = testing::AddGlobalTestEnvironment(new BasesOfTheTests);

const std::string kRemote = "{socket: \"" + Bases::path() + "\"}";

INSTANTIATE_TEST_SUITE_P(Shipped, SensorConformance,
                         testing::Values(module<Sensor>(kModules, "simulated_robot"),
                                         module<Sensor>(kModules, "simulated_robot", "{fire_all: true}"),
                                         module<Sensor>(kModules, "remote_base", kRemote),
                                         module<Sensor>(kModules, "table_log", kLog),
                                         module<Sensor>(kModules, "carmen_log", kCarmen),
                                         module<Sensor>(kModules, "player_log", config_of("player.log")),
                                         module<Sensor>(kModules, "json_log", config_of("scans.json")),
                                         module<Sensor>(kModules, "laser_log", config_of("scans.json")),
                                         module<Sensor>(kModules, "lego_log", kLego),
                                         module<Sensor>(kModules, "mcap_log", kBag),
                                         module<Sensor>(kModules, "picture_log", kPictures),
                                         module<Sensor>(kModules, "sonar_from_laser", kDerived)));

}  // namespace
}  // namespace cairn::conformance
