// Every shipped module of kind `map` passes the suite of its kind.
#include "tests/conformance/map.hpp"

namespace cairn::conformance {
namespace {

const std::filesystem::path kModules = std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn";

INSTANTIATE_TEST_SUITE_P(Shipped, MapperConformance, testing::Values(module<Mapper>(kModules, "bayes_map")));

}  // namespace
}  // namespace cairn::conformance
