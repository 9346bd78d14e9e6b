#include "framework/planning/clusters_config.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(ClustersConfig, AreTheSizesOfClusteringByDefault) {
  EXPECT_EQ(ClustersConfig{}.sizes(), ClusterSizes{});
  EXPECT_EQ(cluster_sizes_of({}), ClusterSizes{});
}

TEST(ClustersConfig, ComeBackFromASavedMap) {
  ClustersConfig config;
  config.from_landmarks = 12;
  config.max_landmarks = 20;
  config.growth = 3;
  config.narrow_below_m = 0.85;
  config.large_from = 500;
  EXPECT_EQ(cluster_sizes_of({{kClustersProperty, text_of(config)}}), config.sizes());
}

TEST(ClustersConfig, RefuseWhatIsNoSetting) {
  try {
    static_cast<void>(cluster_sizes_of({{kClustersProperty, "{max_landmark: 20}"}}));
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean \"max_landmarks\"?"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace cairn
