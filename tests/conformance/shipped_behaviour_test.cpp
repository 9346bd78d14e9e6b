// Every shipped module of kind `behaviour` passes the suite of its kind.
#include "tests/conformance/behaviour.hpp"

namespace cairn::conformance {
namespace {

const std::filesystem::path kModules = std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn";

INSTANTIATE_TEST_SUITE_P(Shipped, BehaviourConformance,
                         testing::Values(module<Behaviour>(kModules, "explore"),
                                         module<Behaviour>(kModules, "goto", "{landmark: nearest square}"),
                                         module<Behaviour>(kModules, "goto", "{at_m: [5, 4]}"),
                                         module<Behaviour>(kModules, "drive", "{points_m: [[2, 1], [2, 4], [1, 4]]}"),
                                         module<Behaviour>(kModules, "wait", "{for_s: 4}"),
                                         module<Behaviour>(kModules, "save", "{file: room.cairn}")));

}  // namespace
}  // namespace cairn::conformance
