#include "framework/mission/history.hpp"

#include <gtest/gtest.h>

#include "framework/mission/mission.hpp"

namespace cairn {
namespace {

TEST(HistoryConfig, IsASectionOfTheMission) {
  const std::string file = std::string(CAIRN_SOURCE_DIR) + "/config/missions/office.yaml";
  EXPECT_EQ(load_mission(file).config.history.max_path_poses, 12000U);
  const Mission mission = load_mission(file, {"history.max_path_poses=500", "history.max_samples=60"});
  EXPECT_EQ(mission.config.history.max_path_poses, 500U);
  EXPECT_EQ(mission.config.history.max_samples, 60U);
  EXPECT_THROW((void)load_mission(file, {"history.max_events=0"}), ConfigError);
}

}  // namespace
}  // namespace cairn
