// The page of `cairn view` in Debian's chromium, driven by playwright-core (npm).
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

namespace fs = std::filesystem;

bool succeeds(const std::string& command) {
  return std::system(command.c_str()) == 0;  // NOLINT(cert-env33-c): both are this test's own words
}

class Browser : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists("/usr/bin/chromium")) GTEST_SKIP() << "chromium is missing (apt-get install chromium)";
    if (!succeeds("node -e \"require('playwright-core')\" 2>/dev/null"))
      GTEST_SKIP() << "playwright-core is missing (npm install playwright-core; NODE_PATH names its node_modules)";
  }
  ~Browser() override { fs::remove_all(folder_); }

  // Empty: the page does all that it should.
  [[nodiscard]] std::string faults_of(const std::string& kind, const std::string& address) const {
    const fs::path said = folder_ / "said.txt";
    const std::string command = "PATH=" CAIRN_BINARY_DIR "/bin:$PATH node " + source_folder() +
                                "/tests/scenario/view/browser.cjs " + kind + " '" + address + "' 2> " + said.string();
    return succeeds(command) ? "" : text_of_file(said) + "(" + command + ")";
  }

  const fs::path folder_ = fresh_folder("browser");
  const fs::path out_ = folder_ / "out";
};

TEST_F(Browser, WatchesSteersAndBrowsesARun) {
  const std::string config = source_folder() + "/config/";
  write_text(folder_ / "world.yaml",
             "bounds_m: [[0, 0], [3, 3]]\nwalls: [{points_m: [[0, 0], [3, 0], [3, 3], [0, 3], [0, 0]]}]\n");
  write_text(folder_ / "mission.yaml",
             "mission: held\nrobot: " + config +
                 "robots/pioneer1.yaml\nworld: world.yaml\n"
                 "start: {at_m: [0.6, 0.6], angle_deg: 0}\n"
                 "sensor: {plugin: simulated_robot}\nlocalizer: {plugin: odometry_compass}\n"
                 "map: {plugin: muriel, cell_m: 0.05}\nplanner: {plugin: hybrid}\n"
                 "steps: [{explore: {until_known_ratio: 0.6, at_most_s: 60}}, {await_orders: }]\n");
  {
    Conversation run(
        {"run", (folder_ / "mission.yaml").string(), "--out", out_.string(), "--pace", "4", "--view", "--control"});
    std::string address = run.hear();
    while (!address.empty() && !address.starts_with("http://")) address = run.hear();
    EXPECT_EQ(faults_of("live", address), "");
    run.send(SIGTERM);  // a page that has failed has not cancelled it
    EXPECT_EQ(run.exit_status(), 1);
  }
  Conversation view({"view", out_.string()});
  EXPECT_EQ(faults_of("run", view.hear()), "");
  view.send(SIGTERM);
  EXPECT_EQ(view.exit_status(), 0);
}

TEST_F(Browser, PlansByTheKeyboardAndChangesASavedMap) {
  ASSERT_EQ(run_cairn({"run", source_folder() + "/config/missions/office.yaml", "--out", out_.string(), "--json"})
                .exit_status,
            0);
  Conversation view({"view", (out_ / "office.cairn").string(), "--edit"});
  EXPECT_EQ(faults_of("map", view.hear()), "");
  view.send(SIGTERM);
  EXPECT_EQ(view.exit_status(), 0);
  EXPECT_TRUE(fs::exists(out_ / "seen.yaml"));
  const Finished plan =
      run_cairn({"plan", (out_ / "office.cairn").string(), "--from", "0.6,0.6", "--to", "pillar_box", "--json"});
  EXPECT_EQ(plan.exit_status, 0) << plan.err;
}

}  // namespace
}  // namespace cairn::testing_program
