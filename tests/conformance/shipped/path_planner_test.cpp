// Every shipped module of kind `path_planner` passes the suite of its kind; `ompl` with each of its algorithms, left to
// itself, and however the robot moves.
#include "tests/conformance/path_planner.hpp"

#include "planners/ompl/search/algorithms.hpp"

namespace cairn::conformance {
namespace {

Subject<PathPlanner> ompl_with(const std::string& name, const std::string& config_yaml) {
  return {name, ModuleSource({std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn"}, "ompl", config_yaml)};
}

std::vector<Subject<PathPlanner>> algorithms() {
  std::vector<Subject<PathPlanner>> all;
  for (const auto& [name, algorithm] : algorithm_names()) {
    // FMT* and BFMT* ask for each of their thousand samples before they begin.
    const std::string iterations = name.ends_with("FMT") ? "3000" : "1200";
    all.push_back(ompl_with(
        name,
        "{algorithm: " + name + ", fall_back_to_grid: false, improve_iterations: 50, iterations: " + iterations + "}"));
  }
  return all;
}

std::vector<Subject<PathPlanner>> kinematics() {
  std::vector<Subject<PathPlanner>> all;
  for (const std::string kind : {"differential", "dubins", "reeds_shepp"})
    all.push_back(ompl_with(kind, "{kinematics: " + kind + ", turning_radius_m: 0.2, improve_iterations: 20}"));
  return all;
}

INSTANTIATE_TEST_SUITE_P(Shipped, PathPlannerConformance,
                         testing::Values(ompl_with("ompl", "{}"), ompl_with("margin", "{margin_m: 0.05}"),
                                         ompl_with("unknown", "{unknown: allow}"),
                                         ompl_with("unknown at a cost", "{unknown: cost}")));
INSTANTIATE_TEST_SUITE_P(Algorithms, PathPlannerConformance, testing::ValuesIn(algorithms()));
INSTANTIATE_TEST_SUITE_P(Kinematics, PathPlannerConformance, testing::ValuesIn(kinematics()));

}  // namespace
}  // namespace cairn::conformance
