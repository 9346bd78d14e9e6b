// The wheels are stopped by another thread than the mission's.
#include "tests/conformance/sensor.hpp"

namespace cairn::conformance {
namespace {

INSTANTIATE_TEST_SUITE_P(Shipped, SensorConformance,
                         testing::Values(module<Sensor>(std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn",
                                                        "simulated_robot")));

}  // namespace
}  // namespace cairn::conformance
