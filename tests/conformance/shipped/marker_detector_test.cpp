// Every shipped module of kind `marker_detector` passes the suite of its kind.
#include "tests/conformance/marker_detector.hpp"

namespace cairn::conformance {
namespace {

const std::filesystem::path kModules = std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn";

INSTANTIATE_TEST_SUITE_P(Shipped, MarkerDetectorConformance,
                         testing::Values(module<MarkerDetector>(kModules, "april_tags"),
                                         module<MarkerDetector>(kModules, "april_tags", "{decimate: 2, threads: 2}")));

}  // namespace
}  // namespace cairn::conformance
