#include "framework/experiments/contacts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using testing::HasSubstr;

std::vector<ExperimentRow> rows_with(const std::vector<double>& speeds_mps) {
  std::vector<ExperimentRow> rows(2);
  for (ExperimentRow& row : rows) {
    row.mission = "office";
    row.variant = "left";
    row.seed = 7;
  }
  for (const double speed_mps : speeds_mps) rows[1].contacts.push_back({3.0, {speed_mps, false}});
  return rows;
}

ExperimentConfig config_of(std::optional<double> max_mps) {
  ExperimentConfig config;
  config.variants = {{"left", {}}};
  config.max_contact_mps = max_mps;
  return config;
}

TEST(Contacts, TheTableCountsThemAndThoseThatWereTooFast) {
  const std::string table = contacts_table(config_of(0.1), rows_with({0.05, 0.2, 0.1}));
  EXPECT_THAT(table, HasSubstr("| office | left | 2 | 0 | 3 | 0.200 | 1 | 7 |")) << table;
}

TEST(Contacts, WithoutALimitThereIsNeitherATableNorAFailure) {
  EXPECT_EQ(contacts_table(config_of(std::nullopt), rows_with({0.5})), "");
  EXPECT_TRUE(keeps_contact_limit(config_of(std::nullopt), rows_with({0.5})));
}

TEST(Contacts, TheLimitIsKeptUpToItself) {
  EXPECT_TRUE(keeps_contact_limit(config_of(0.1), rows_with({0.1})));
  EXPECT_FALSE(keeps_contact_limit(config_of(0.1), rows_with({0.05, 0.11})));
}

}  // namespace
}  // namespace cairn
