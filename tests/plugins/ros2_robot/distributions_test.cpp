// Messages as four distributions of ROS 2 define them, read and written by others. CAIRN_NODE_MODULES: a folder in
// which `npm install @foxglove/omgidl-parser @foxglove/rosmsg2-serialization @foxglove/rosmsg-msgs-common` was called.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace cairn::ros2_robot {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

bool has_packages(const fs::path& modules) {
  for (const char* package : {"omgidl-parser", "rosmsg2-serialization", "rosmsg-msgs-common"})
    if (!fs::exists(modules / "node_modules/@foxglove" / package)) return false;
  return true;
}

json passed_through(const std::string& modules, const std::string& distribution) {
  const fs::path found_file = fs::path(testing::TempDir()) / ("distribution_" + std::to_string(::getpid()) + ".json");
  const std::string script = CAIRN_SOURCE_DIR "/tests/plugins/ros2_robot/distributions.mjs";
  const std::string idl = CAIRN_SOURCE_DIR "/plugins/ros2_robot/ros2.idl";
  const std::string domain = std::to_string(1 + ::getpid() % 99);
  std::string command = "node";
  for (const std::string& word : {script, modules, distribution, idl, std::string(CAIRN_ROUND_TRIP), domain})
    command += " '" + word + "'";
  EXPECT_EQ(std::system((command + " > '" + found_file.string() + "'").c_str()), 0);  // NOLINT(cert-env33-c)
  std::ifstream in(found_file);
  const json found = json::parse(in, nullptr, false);
  in.close();
  fs::remove(found_file);
  return found;
}

class Distribution : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(OfRos2, Distribution, testing::Values("ros2galactic", "ros2humble", "ros2iron", "ros2jazzy"));

TEST_P(Distribution, ReadsWhatCairnWritesAndIsReadByIt) {
  const char* const modules = std::getenv("CAIRN_NODE_MODULES");
  if (modules == nullptr || !has_packages(modules))
    GTEST_SKIP() << "CAIRN_NODE_MODULES names no folder with @foxglove/omgidl-parser, rosmsg2-serialization and "
                    "rosmsg-msgs-common";
  const json found = passed_through(modules, GetParam());
  ASSERT_TRUE(found.is_object());
  EXPECT_EQ(found.size(), 20U);
  const std::string distribution = GetParam();
  for (const auto& [type, ours] : found.items()) {
    // Cairn's markers have what Humble added: Galactic's RViz cannot draw them.
    if (distribution == "ros2galactic" && type == "visualization_msgs/MarkerArray") {
      EXPECT_EQ(ours["fields"], "visualization_msgs/Marker: string text, and ours has string texture_resource");
      continue;
    }
    EXPECT_EQ(ours["read"], "same") << type;
    // Cairn reads ranges only, without the field that Iron added at their end.
    if (type == "sensor_msgs/Range" && ours["fields"] != "same") {
      EXPECT_TRUE(distribution == "ros2iron" || distribution == "ros2jazzy") << distribution;
      EXPECT_EQ(ours["fields"], "sensor_msgs/Range: float32 variance, and ours has nothing");
      continue;
    }
    EXPECT_EQ(ours["fields"], "same") << type;
    EXPECT_EQ(ours["written"], "same") << type;
  }
}

}  // namespace
}  // namespace cairn::ros2_robot
