#include "framework/files/fault_rates.hpp"

#include <gtest/gtest.h>

#include "framework/config/config_value.hpp"

namespace cairn {
namespace {

FaultRates loaded(const std::string& text) {
  return load_config<FaultRates>(parse_config_text(text, "m.yaml"), "per_hour");
}

std::string error_of(const std::string& text) {
  try {
    (void)loaded(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(FaultRates, EachKindHasItsOwnAndNoneStrikesUnasked) {
  const FaultRates rates = loaded("{dead: 1, stuck: 2, slip: 3, compass_jump: 4, silent: 5, kidnap: 6, deaf: 7}");
  EXPECT_EQ(rates.dead, 1.0);
  EXPECT_EQ(rates.stuck, 2.0);
  EXPECT_EQ(rates.slip, 3.0);
  EXPECT_EQ(rates.compass_jump, 4.0);
  EXPECT_EQ(rates.silent, 5.0);
  EXPECT_EQ(rates.kidnap, 6.0);
  EXPECT_EQ(rates.deaf, 7.0);
  const FaultRates none = loaded("{}");
  EXPECT_EQ(none.dead + none.stuck + none.slip + none.compass_jump + none.silent + none.kidnap + none.deaf, 0.0);
}

TEST(FaultRates, WhatIsNoRateIsReportedWithItsPlace) {
  EXPECT_EQ(error_of("{silent: -1}"), "m.yaml:1:10: silent must be a number from 0 to 3600 1/h, found \"-1\"");
  EXPECT_EQ(error_of("{kidnapp: 1}"),
            "m.yaml:1:2: unknown key \"kidnapp\" in per_hour (did you mean \"kidnap\"?); known: dead, stuck, slip, "
            "compass_jump, silent, kidnap, deaf");
}

}  // namespace
}  // namespace cairn
