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
                                         module<Behaviour>(kModules, "search", "{category: square}"),
                                         module<Behaviour>(kModules, "inspect", "{landmark: nearest square}"),
                                         module<Behaviour>(kModules, "tour", "{places: [[2, 4], L1], order: shortest}"),
                                         module<Behaviour>(kModules, "patrol", "{rounds: forever}"),
                                         module<Behaviour>(kModules, "return_home"),
                                         module<Behaviour>(kModules, "dock", "{landmark: L1, side: right}"),
                                         module<Behaviour>(kModules, "capture_template", "{at: [3, 2.5], name: post}"),
                                         module<Behaviour>(kModules, "plan_query", "{to: L1}"),
                                         module<Behaviour>(kModules, "log", "{text: 'at {place}, {explored}'}"),
                                         module<Behaviour>(kModules, "wait", "{for_s: 4}"),
                                         module<Behaviour>(kModules, "save", "{file: room.cairn}")));

}  // namespace
}  // namespace cairn::conformance
