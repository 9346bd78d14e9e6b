#include "framework/program/common/refusal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using testing::ThrowsMessage;

TEST(Refusal, WhatIsNotRefusedIsHandedOn) {
  EXPECT_EQ(refused_about("a.cairn", [] { return 3; }), 3);
}

TEST(Refusal, SaysWhatItIsAbout) {
  EXPECT_THAT([] { refused_about("a.cairn", [] { throw std::invalid_argument("no cells"); }); },
              ThrowsMessage<std::runtime_error>("a.cairn: no cells"));
}

TEST(Refusal, OtherErrorsPassUnchanged) {
  EXPECT_THROW(refused_about("a.cairn", [] { throw std::out_of_range("a bug"); }), std::out_of_range);
}

}  // namespace
}  // namespace cairn
