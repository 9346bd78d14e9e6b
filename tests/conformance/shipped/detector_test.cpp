// Every shipped module of kind `detector` passes the suite of its kind.
#include "tests/conformance/detector.hpp"

namespace cairn::conformance {
namespace {

const std::filesystem::path kModules = std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn";

INSTANTIATE_TEST_SUITE_P(Shipped, DetectorConformance,
                         testing::Values(module<Detector>(kModules, "template_matcher"),
                                         module<Detector>(kModules, "match_template"),
                                         module<Detector>(kModules, "chamfer"),
                                         module<Detector>(kModules, "generalized_hough")));

}  // namespace
}  // namespace cairn::conformance
