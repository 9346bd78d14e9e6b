#include "plugins/common/logs/scan_log.hpp"

#include <gmock/gmock.h>

#include "plugins/common/logs/range_rule.hpp"
#include "tests/plugins/log_files.hpp"

namespace cairn::log_common {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pointwise;

ScanLog log_with_stamps(const std::vector<double>& stamps_s, const LogRules& rules = {}) {
  ScanLog log("some/a.log", rules);
  const std::size_t nothing = log.source("", [] { return std::vector<RangeReading>{}; });
  int line = 10;
  for (const double stamp_s : stamps_s) {
    Scan scan;
    scan.stamp_s = stamp_s;
    scan.line = line++;
    log.add(scan, nothing, {});
  }
  return log;
}

std::vector<double> stamps_of(ScanLog log, std::string* sentence = nullptr) {
  log.finish();
  std::vector<double> stamps_s;
  for (std::size_t i = 0; i < log.size(); ++i) stamps_s.push_back(log.observation(i).stamp_s);
  if (sentence != nullptr) *sentence = log.end_sentence();
  return stamps_s;
}

TEST(ScanLog, KeepsGoodStampsAsTheyStand) {
  std::string sentence;
  EXPECT_THAT(stamps_of(log_with_stamps({976052890.244111, 976052890.5, 976052890.5, 976053000.0}), &sentence),
              ElementsAre(976052890.244111, 976052890.5, 976052890.5, 976053000.0));
  EXPECT_EQ(sentence, "end of a.log after 4 observations");
}

TEST(ScanLog, BridgesAClockThatJumpsAndReportsTheFirstLine) {
  std::string sentence;
  EXPECT_THAT(stamps_of(log_with_stamps({5, 6, 2, 3, 1e9, 1e9 + 2}), &sentence),
              Pointwise(DoubleNear(1e-6), {5.0, 6.0, 6.1, 7.1, 7.2, 9.2}));
  EXPECT_EQ(sentence, "end of a.log after 6 observations; 2 clock jumps bridged, the first at line 12");
}

TEST(ScanLog, StampsNeverGoBackWhateverTheClockDoes) {
  const std::vector<double> stamps_s =
      stamps_of(log_with_stamps({0, 1e308, -1e308, 1e308, 1e-308, 1e17, 1e17 + 16, 3}));
  for (std::size_t i = 1; i < stamps_s.size(); ++i) EXPECT_GE(stamps_s[i], stamps_s[i - 1]);
  EXPECT_LT(stamps_s.back(), 1e9);
}

TEST(ScanLog, RefusesAClockJumpWhenAskedTo) {
  LogRules rules;
  rules.on_clock_jump = ClockJump::refuse;
  try {
    stamps_of(log_with_stamps({5, 6, 2}, rules));
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "some/a.log:12:1: the clock jumps from 6 s to 2 s");
  }
}

TEST(ScanLog, CountsScansWhenTheStampsStandStill) {
  std::string sentence;
  std::vector<double> stuck(30, 1.01893e9);
  stuck[20] = 1.01894e9;  // two changes in thirty scans say nothing
  LogRules rules;
  rules.period_s = 0.5;
  const std::vector<double> stamps_s = stamps_of(log_with_stamps(stuck, rules), &sentence);
  EXPECT_DOUBLE_EQ(stamps_s.front(), 0.0);
  EXPECT_DOUBLE_EQ(stamps_s.back(), 14.5);
  EXPECT_THAT(sentence, HasSubstr("the time stamps stand still: scans taken as 0.5 s apart"));
}

TEST(ScanLog, ReportsKindsItDidNotReadButNotAllOfThem) {
  ScanLog log = log_with_stamps({1});
  for (int i = 0; i < 100; ++i) log.unknown_line("KIND" + std::to_string(i / 2));
  log.unknown_line(std::string(1000, 'K'));
  log.finish();
  EXPECT_EQ(log.end_sentence(),
            "end of a.log after 1 observations; 101 lines of kinds not read: \"KIND0\" 2 \"KIND1\" 2 \"KIND2\" 2 "
            "\"KIND3\" 2 \"KIND4\" 2 \"KIND5\" 2 \"KIND6\" 2 \"KIND7\" 2");
}

TEST(ScanLog, ReportsTheFirstBadLineWithoutTheFolderItLiesIn) {
  LogRules rules;
  rules.on_bad_line = BadLine::skip;
  ScanLog log = log_with_stamps({1}, rules);
  for (int line = 3; line < 5; ++line) log.bad_line(ConfigError({"some/a.log", line, 7}, "no number"));
  log.finish();
  EXPECT_EQ(log.end_sentence(),
            "end of a.log after 1 observations; 2 bad lines skipped, the first: a.log:3:7: no number");
}

TEST(ScanLog, ALogWithoutAScanIsRefused) {
  ScanLog log("a.log", {});
  log.unknown_line("X");
  try {
    log.finish();
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "a.log: the log holds no observation; 1 line of unknown kinds");
  }
}

TEST(ScanLog, ASourceThatCannotBeMadeIsNotRemembered) {
  ScanLog log("a.log", {});
  for (int i = 0; i < 2; ++i)
    EXPECT_THROW(log.source("k", []() -> std::vector<RangeReading> { throw std::runtime_error("no"); }),
                 std::runtime_error);
}

TEST(RangeFrom, HasARuleForEveryOddRange) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto range = [](double value) { return range_from(value, 0.01, {9999, 0}, 0.2, 5.0); };
  EXPECT_DOUBLE_EQ(range(150), 1.5);
  EXPECT_EQ(range(9999), kInfinity);
  EXPECT_EQ(range(0), kInfinity) << "a mark of no echo, not too near";
  EXPECT_EQ(range(501), kInfinity);
  EXPECT_EQ(range(500), 5.0);
  EXPECT_EQ(range(19), -kInfinity);
  EXPECT_EQ(range(kInfinity), kInfinity);
  EXPECT_EQ(range(-kInfinity), -kInfinity);
  EXPECT_TRUE(std::isnan(range(-1)));
  EXPECT_TRUE(std::isnan(range(std::nan(""))));
}

}  // namespace
}  // namespace cairn::log_common
