#include "framework/program/map/exchange_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(ExchangeReport, AnUnknownExtensionIsRefusedWithTheNearestAndAllKnownOnes) {
  EXPECT_THAT(
      [] {
        fail_extension("maps/a.grap", "imported", {".graph", ".map"});
      },
      ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("maps/a.grap: cannot be imported: unknown extension \".grap\""),
                                              HasSubstr(".graph"), HasSubstr("known are .graph, .map"))));
}

TEST(ExchangeReport, AMissingExtensionIsRefusedAsSuch) {
  EXPECT_THAT([] { fail_extension("a", "exported to", {".map"}); },
              ThrowsMessage<std::runtime_error>(HasSubstr("a: cannot be exported to: it has no extension")));
}

TEST(ExchangeReport, EveryWarningNamesItsFileOnce) {
  EXPECT_THAT(about("a.yaml", {"a lift: left out", "a.yaml:3:1: no name"}),
              ElementsAre("a.yaml: a lift: left out", "a.yaml:3:1: no name"));
}

}  // namespace
}  // namespace cairn
