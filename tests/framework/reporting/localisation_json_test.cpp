#include "framework/reporting/localisation_json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace cairn {
namespace {

TEST(LocalisationJson, ADoubtHasItsCauseAndWhatCameOfIt) {
  PoseCheck check;
  PoseLook look;
  look.driven_m = 6.5;
  look.believed.score = 0.9;
  check.update(look);
  WatchFigures figures;
  figures.doubts.push_back({12.5, DoubtCause::jump, check});
  const auto json = nlohmann::json::parse(doubts_json(figures));
  ASSERT_EQ(json.size(), 1U);
  EXPECT_EQ(json[0]["begun_s"], 12.5);
  EXPECT_EQ(json[0]["cause"], "jump");
  EXPECT_EQ(json[0]["verdict"], "stayed");
  EXPECT_EQ(json[0]["looks"][0]["believed"]["score"], 0.9);
}

TEST(LocalisationJson, ARobotThatIsStillLostHasNoPlace) {
  WatchFigures figures;
  figures.carried.push_back({20.0, 55.0, 2.0});
  figures.carried.push_back({90.0, 80.0, 3.0, 120.0, 7.5, {1.0, 2.0, 0.0}});
  const auto json = nlohmann::json::parse(carried_json(figures));
  ASSERT_EQ(json.size(), 2U);
  EXPECT_EQ(json[0]["noticed_s"], 20.0);
  EXPECT_EQ(json[0]["distance_m"], 55.0);
  EXPECT_EQ(json[0]["driven_m"], 2.0);
  EXPECT_FALSE(json[0].contains("found_s"));
  EXPECT_EQ(json[1]["found_s"], 120.0);
  EXPECT_EQ(json[1]["searched_m"], 7.5);
  EXPECT_EQ(json[1]["found_at"]["y_m"], 2.0);
}

}  // namespace
}  // namespace cairn
