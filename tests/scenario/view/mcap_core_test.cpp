// A recording, read with the npm package @mcap/core. CAIRN_NODE_MODULES: a folder in which `npm install @mcap/core` was
// called.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json read_with_npm(const fs::path& recording) {
  const fs::path said = recording.parent_path() / "said.json";
  const std::string command = "node '" + source_folder() + "/tests/scenario/view/mcap_core.mjs' '" +
                              std::getenv("CAIRN_NODE_MODULES") + "' '" + recording.string() + "' > '" + said.string() +
                              "'";
  EXPECT_EQ(std::system(command.c_str()), 0);  // NOLINT(cert-env33-c): this test's own words
  return json::parse(text_of_file(said), nullptr, false);
}

TEST(McapCore, ReadsARecordingWithItsChecksumsAndNotADamagedOne) {
  const char* const modules = std::getenv("CAIRN_NODE_MODULES");
  if (modules == nullptr || !fs::exists(fs::path(modules) / "node_modules/@mcap/core"))
    GTEST_SKIP() << "CAIRN_NODE_MODULES names no folder with @mcap/core";
  if (!fs::exists("/usr/bin/zstd")) GTEST_SKIP() << "zstd is missing (apt-get install zstd)";
  const fs::path out = fresh_folder("mcap_core");
  const Finished run =
      run_cairn({"run", source_folder() + "/config/missions/office.yaml", "--set", "record_mcap=run.mcap", "--set",
                 "steps.0.explore.at_most_s=20", "--out", out.string(), "--json"});
  ASSERT_TRUE(fs::exists(out / "run.mcap")) << run.err;
  const json seen = read_with_npm(out / "run.mcap");
  ASSERT_FALSE(seen.contains("error")) << seen;
  EXPECT_EQ(seen["messages"], seen["streamed"]);
  EXPECT_EQ(seen["attachments"], 3);
  EXPECT_GT(seen["chunks"], 1);
  for (const char* topic : {"/pose", "/map", "/ranges", "/tree", "/log", "/ros/odom", "/ros/range", "/ros/map"})
    EXPECT_GT(seen["topics"].value(topic, 0), 0) << topic;

  std::string bytes = text_of_file(out / "run.mcap");
  bytes[bytes.size() / 3] = static_cast<char>(bytes[bytes.size() / 3] ^ 1);
  std::ofstream(out / "damaged.mcap", std::ios::binary) << bytes;
  EXPECT_TRUE(read_with_npm(out / "damaged.mcap").contains("error"));
  fs::remove_all(out);
}

}  // namespace
}  // namespace cairn::testing_program
