// Every shipped module of kind `map` passes the suite of its kind.
#include "tests/conformance/map.hpp"

namespace cairn::conformance {
namespace {

const std::filesystem::path kModules = std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn";

// The textbook as printed believes in targets at the rim of a beam that heard nothing; hence keep_sign.
INSTANTIATE_TEST_SUITE_P(Shipped, MapperConformance,
                         testing::Values(module<Mapper>(kModules, "bayes"), module<Mapper>(kModules, "himm"),
                                         module<Mapper>(kModules, "muriel"),
                                         module<Mapper>(kModules, "murphy", "{keep_sign: true}")));

}  // namespace
}  // namespace cairn::conformance
