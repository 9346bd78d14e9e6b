// Every shipped module of kind `route_planner` passes the suite of its kind.
#include "tests/conformance/route_planner.hpp"

namespace cairn::conformance {
namespace {

const std::filesystem::path kModules = std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn";

INSTANTIATE_TEST_SUITE_P(Shipped, RoutePlannerConformance,
                         testing::Values(module<RoutePlanner>(kModules, "landmark_search"),
                                         module<RoutePlanner>(kModules, "flat_search")));

}  // namespace
}  // namespace cairn::conformance
