#include <gtest/gtest.h>

#include "framework/contracts/module.hpp"
#include "tests/conformance/detector.hpp"

namespace cairn::conformance {
namespace {

// The suite draws a circle, a square and a triangle; ours is the circle of 0.5 m.
TemplateSet circle_only() {
  TemplateSet set = three_templates();
  std::erase_if(set.shapes, [](const LandmarkShape& shape) { return shape.category != "circle"; });
  return set;
}

INSTANTIATE_TEST_SUITE_P(PillarFinder, DetectorConformance,
                         testing::Values(module<Detector>(PLUGIN_FOLDER, "pillar_finder", "{diameter_m: 0.5}")
                                             .with_robot_file(ROBOT_FILE)
                                             .with_templates(circle_only())));

}  // namespace
}  // namespace cairn::conformance
