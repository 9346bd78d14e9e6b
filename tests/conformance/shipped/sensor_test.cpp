// Every shipped module of kind `sensor` passes the suite of its kind.
#include "tests/conformance/sensor.hpp"

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

const std::string kLego = std::string("{file: \"") + CAIRN_SOURCE_DIR + "/tests/data/lego_scans.log\", motors: \"" +
                          CAIRN_SOURCE_DIR + "/tests/data/lego_motors.log\", compass_from_pose: true}";

INSTANTIATE_TEST_SUITE_P(Shipped, SensorConformance,
                         testing::Values(module<Sensor>(kModules, "simulated_robot"),
                                         module<Sensor>(kModules, "simulated_robot", "{fire_all: true}"),
                                         module<Sensor>(kModules, "table_log", kLog),
                                         module<Sensor>(kModules, "carmen_log", kCarmen),
                                         module<Sensor>(kModules, "player_log", config_of("player.log")),
                                         module<Sensor>(kModules, "json_log", config_of("scans.json")),
                                         module<Sensor>(kModules, "lego_log", kLego),
                                         module<Sensor>(kModules, "sonar_from_laser", kDerived)));

}  // namespace
}  // namespace cairn::conformance
