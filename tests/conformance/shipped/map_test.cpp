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

// What `cairn run --resume` asks of a map.
TEST(ShippedMaps, BeginWithAGridThatIsGivenToThem) {
  for (const char* const name : {"bayes", "himm", "muriel", "murphy"}) {
    const auto subject = module<Mapper>(kModules, name);
    OccupancyGrid so_far = subject.make()->grid();
    so_far.set_log_odds({-3, 70}, LogOdds{300});
    so_far.set_log_odds({12, 5}, LogOdds{-500});
    EXPECT_TRUE(subject.going_on_from(so_far).make()->grid() == so_far) << name;
  }
}

}  // namespace
}  // namespace cairn::conformance
