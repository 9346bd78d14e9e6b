// Every shipped module of kind `loop_closer` passes the suite of its kind.
#include "tests/conformance/loop_closer.hpp"

namespace cairn::conformance {
namespace {

const std::filesystem::path kModules = std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn";

INSTANTIATE_TEST_SUITE_P(Shipped, LoopCloserConformance,
                         testing::Values(module<LoopCloser>(kModules, "submap_correlation"),
                                         module<LoopCloser>(kModules, "submap_correlation",
                                                            "{field_sigma_m: 0.15, max_window_m: 3, min_score: 0.6}")));

}  // namespace
}  // namespace cairn::conformance
