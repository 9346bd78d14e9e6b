// Every shipped module of kind `sensor` passes the suite of its kind.
#include "tests/conformance/sensor.hpp"

namespace cairn::conformance {
namespace {

const std::filesystem::path kModules = std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn";

INSTANTIATE_TEST_SUITE_P(Shipped, SensorConformance, testing::Values(module<Sensor>(kModules, "simulated_robot")));

}  // namespace
}  // namespace cairn::conformance
