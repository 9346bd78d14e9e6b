// Every shipped module of kind `sensor` passes the suite of its kind.
#include "tests/conformance/sensor.hpp"

namespace cairn::conformance {
namespace {

const std::filesystem::path kModules = std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn";

const std::string kLog = std::string("{file: \"") + CAIRN_SOURCE_DIR + R"(/tests/data/three_sonars.log",
  time_column: 1, x_column: 2, y_column: 3, heading_column: 4, compass_from_pose: true, first_range_column: 5,
  sonars: [{angle_deg: 90}, {angle_deg: 0}, {angle_deg: -90}]})";

INSTANTIATE_TEST_SUITE_P(Shipped, SensorConformance,
                         testing::Values(module<Sensor>(kModules, "simulated_robot"),
                                         module<Sensor>(kModules, "simulated_robot", "{fire_all: true}"),
                                         module<Sensor>(kModules, "table_log", kLog)));

}  // namespace
}  // namespace cairn::conformance
