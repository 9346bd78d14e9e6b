// A recorded run, watched with the npm client of Foxglove's protocol. CAIRN_NODE_MODULES: a folder in which
// `npm install @foxglove/ws-protocol ws @foxglove/schemas ajv` was called.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;

std::string output_of(const std::string& command) {
  std::string text;
  FILE* const pipe = ::popen(command.c_str(), "r");
  std::array<char, 4096> piece{};
  while (const std::size_t got = std::fread(piece.data(), 1, piece.size(), pipe)) text.append(piece.data(), got);
  (void)::pclose(pipe);
  return text;
}

TEST(FoxgloveView, TheNpmClientReadsARunAndItsMessagesFitThePublishedSchemas) {
  const char* const modules = std::getenv("CAIRN_NODE_MODULES");
  if (modules == nullptr) GTEST_SKIP() << "no CAIRN_NODE_MODULES: @foxglove/ws-protocol";
  const auto out = fresh_folder("foxglove_view");
  const Finished run =
      run_cairn({"run", source_folder() + "/config/missions/office.yaml", "--set", "record_mcap=run.mcap", "--set",
                 "steps.0.explore.at_most_s=4", "--out", out.string(), "--json"});
  ASSERT_TRUE(std::filesystem::exists(out / "run.mcap")) << run.err;
  Conversation view({"view", out.string()});
  const std::string page = view.hear();
  const std::string line = view.hear();
  const std::string address = line.substr(line.find("ws://"));
  const std::string text = output_of("node '" + source_folder() + "/tests/scenario/view/foxglove_client.mjs' '" +
                                     modules + "' '" + address + "' 8");
  view.send(SIGINT);
  EXPECT_EQ(view.exit_status(), 0);
  const json seen = json::parse(text, nullptr, false);
  ASSERT_TRUE(seen.is_object()) << text << page;
  EXPECT_FALSE(seen.contains("error")) << text;
  EXPECT_EQ(seen["name"], "cairn: run.mcap");
  for (const char* topic : {"/pose", "/map", "/ranges", "/tree", "/ros/odom", "/tf_static"})
    EXPECT_GT(seen["counts"].value(topic, 0), 0) << topic;
  EXPECT_TRUE(seen["failures"].empty()) << seen["failures"];
  EXPECT_TRUE(seen["answers"]["1"].contains("answer")) << seen["answers"];
  EXPECT_THAT(seen["answers"]["2"].get<std::string>(), testing::HasSubstr("--control"));
  if (!seen["has_schemas"].get<bool>()) GTEST_SKIP() << "no @foxglove/schemas with ajv";
  EXPECT_GT(seen["checked"].get<int>(), 20);
  EXPECT_TRUE(seen["wrong"].empty()) << seen["wrong"];
}

TEST(FoxgloveView, TheNpmClientWatchesARunAndPausesIt) {
  const char* const modules = std::getenv("CAIRN_NODE_MODULES");
  if (modules == nullptr) GTEST_SKIP() << "no CAIRN_NODE_MODULES: @foxglove/ws-protocol";
  const auto out = fresh_folder("foxglove_live");
  Conversation run({"run", source_folder() + "/config/missions/office.yaml", "--out", out.string(), "--pace", "4",
                    "--view", "--control"});
  std::string line = run.hear();
  while (!line.empty() && line.find("ws://") == std::string::npos) line = run.hear();
  const std::string text = output_of("node '" + source_folder() + "/tests/scenario/view/foxglove_client.mjs' '" +
                                     modules + "' '" + line.substr(line.find("ws://")) + "' 6 3");
  run.send(SIGTERM);
  EXPECT_EQ(run.exit_status(), 1);
  const json seen = json::parse(text, nullptr, false);
  ASSERT_TRUE(seen.is_object()) << text;
  EXPECT_FALSE(seen.contains("error")) << text;
  EXPECT_EQ(seen["name"], "cairn: " + out.filename().string());
  for (const char* topic :
       {"/pose", "/transform", "/map", "/ranges_in_map", "/tree", "/driven_path", "/log", "/status"})
    EXPECT_GT(seen["counts"].value(topic, 0), 0) << topic;
  EXPECT_THAT(seen["answers"]["1"].get<std::string>(), testing::HasSubstr("when it has ended")) << "a plan";
  EXPECT_EQ(seen["answers"]["2"]["state"], "paused") << seen["answers"];
  if (!seen["has_schemas"].get<bool>()) GTEST_SKIP() << "no @foxglove/schemas with ajv";
  EXPECT_GT(seen["checked"].get<int>(), 20);
  EXPECT_TRUE(seen["wrong"].empty()) << seen["wrong"];
}

}  // namespace
}  // namespace cairn::testing_program
