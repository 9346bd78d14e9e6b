// Rerun's viewer draws a recording's grid: @rerun-io/web-viewer (npm) in Debian's chromium, driven by playwright-core.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

namespace fs = std::filesystem;

bool runs(const std::string& command) {
  return std::system(command.c_str()) == 0;  // NOLINT(cert-env33-c): this test's own words
}

TEST(RerunViewer, DrawsTheRecordedGrid) {
  const std::string client = "node " + source_folder() + "/tests/scenario/view/rerun.cjs ";
  if (!fs::exists("/usr/bin/chromium")) GTEST_SKIP() << "chromium is missing (apt-get install chromium)";
  if (!runs(client + "--is-there 2>/dev/null"))
    GTEST_SKIP() << "playwright-core or @rerun-io/web-viewer is missing (npm install playwright-core "
                    "@rerun-io/web-viewer; NODE_PATH names their node_modules)";
  const fs::path folder = fresh_folder("rerun");
  ASSERT_EQ(run_cairn({"run", source_folder() + "/config/missions/office.yaml", "--set", "record_mcap=run.mcap",
                       "--out", folder.string()})
                .exit_status,
            0);
  const fs::path said = folder / "said.txt";
  EXPECT_TRUE(runs(client + (folder / "run.mcap").string() + " 2> " + said.string())) << text_of_file(said);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace cairn::testing_program
