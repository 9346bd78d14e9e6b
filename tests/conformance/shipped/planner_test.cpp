// Every shipped module of kind `planner` passes the suite of its kind; so do `ompl` and `landmark_search` alone, in the
// place of one.
#include "tests/conformance/planner.hpp"

namespace cairn::conformance {
namespace {

const std::filesystem::path kModules = std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn";

std::vector<Subject<Planner>> kinematics() {
  std::vector<Subject<Planner>> all;
  for (const std::string kind : {"differential", "dubins", "reeds_shepp"})
    all.push_back({"hybrid over " + kind, ModuleSource({kModules}, "hybrid",
                                                       "{route: {plugin: ompl, kinematics: " + kind +
                                                           ", turning_radius_m: 0.2, improve_iterations: 20}}")});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Shipped, PlannerConformance,
                         testing::Values(module<Planner>(kModules, "landmark_search"),
                                         module<Planner>(kModules, "ompl"), module<Planner>(kModules, "hybrid")));
INSTANTIATE_TEST_SUITE_P(Kinematics, PlannerConformance, testing::ValuesIn(kinematics()));

}  // namespace
}  // namespace cairn::conformance
