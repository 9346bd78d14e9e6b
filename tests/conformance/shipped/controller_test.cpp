// Every shipped module of kind `controller` passes the suite of its kind.
#include "tests/conformance/controller.hpp"

namespace cairn::conformance {
namespace {

const std::filesystem::path kModules = std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn";

INSTANTIATE_TEST_SUITE_P(Shipped, ControllerConformance,
                         testing::Values(module<Controller>(kModules, "pursuit_dwa"),
                                         module<Controller>(kModules, "plain_pursuit")));

}  // namespace
}  // namespace cairn::conformance
