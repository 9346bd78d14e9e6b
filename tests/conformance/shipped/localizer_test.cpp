// Every shipped module of kind `localizer` passes the suite of its kind.
#include "tests/conformance/localizer.hpp"

namespace cairn::conformance {
namespace {

const std::filesystem::path kModules = std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn";

INSTANTIATE_TEST_SUITE_P(Shipped, LocalizerConformance,
                         testing::Values(module<Localizer>(kModules, "odometry_compass"),
                                         module<Localizer>(kModules, "scan_to_map"),
                                         module<Localizer>(kModules, "submap_graph")));

}  // namespace
}  // namespace cairn::conformance
