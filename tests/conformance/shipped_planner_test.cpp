// Every shipped module of kind `planner` passes the suite of its kind.
#include "tests/conformance/planner.hpp"

namespace cairn::conformance {
namespace {

const std::filesystem::path kModules = std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn";

INSTANTIATE_TEST_SUITE_P(Shipped, PlannerConformance,
                         testing::Values(module<Planner>(kModules, "landmark_search"),
                                         module<Planner>(kModules, "ompl"), module<Planner>(kModules, "hybrid")));

}  // namespace
}  // namespace cairn::conformance
