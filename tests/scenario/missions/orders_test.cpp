// Orders given to running missions, recorded, and given again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class Orders : public testing::Test {
 protected:
  Orders() : folder_(fresh_folder("orders")), out_(folder_ / "out") {
    const std::string config = source_folder() + "/config/";
    write_text(folder_ / "world.yaml",
               "bounds_m: [[0, 0], [3, 3]]\nwalls: [{points_m: [[0, 0], [3, 0], [3, 3], [0, 3], [0, 0]]}]\n");
    write_text(mission_, "mission: held\nrobot: " + config +
                             "robots/pioneer1.yaml\nworld: world.yaml\n"
                             "start: {at_m: [0.6, 0.6], angle_deg: 0}\n"
                             "sensor: {plugin: simulated_robot}\nlocalizer: {plugin: odometry_compass}\n"
                             "map: {plugin: muriel, cell_m: 0.05}\nplanner: {plugin: hybrid}\n"
                             "steps: [{explore: {until_known_ratio: 0.6, at_most_s: 60}}, {await_orders: }]\n");
  }
  ~Orders() override { fs::remove_all(folder_); }
  [[nodiscard]] Finished order(const std::string& text) const {
    return run_cairn({"mission", "order", out_.string(), text});
  }
  // Without starting a program, which takes as long as the robot may need to carry out the order.
  [[nodiscard]] json ask(const std::string& line) const {
    return json::parse(answer_to(out_ / "control.sock", line + "\n"), nullptr, false);
  }
  // Until the mission's status says so: the program is no faster than the machine.
  void wait_until_doing(const std::string& text) const {
    std::string doing;
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    for (; std::chrono::steady_clock::now() < end; ::usleep(2000)) {
      const json status = ask("status");
      if (!status.is_object()) continue;
      doing = status.value("doing", "");
      if (doing.find(text) != std::string::npos) return;
    }
    ADD_FAILURE() << "never doing " << text << ": " << doing;
  }
  [[nodiscard]] std::vector<std::string> run_of(const fs::path& out, std::vector<std::string> more) const {
    std::vector<std::string> arguments{"run", mission_.string(), "--out", out.string(), "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  fs::path folder_;
  fs::path out_;
  fs::path mission_ = folder_ / "mission.yaml";
};

TEST_F(Orders, AreCarriedOutRecordedAndGiveTheSameMapAgain) {
  Conversation run(run_of(out_, {"--pace", "8"}));
  wait_until_doing("waiting for orders");
  EXPECT_EQ(ask(R"(order {"goto": [2.2, 2.2]})")["taken"], true);
  wait_until_doing("order {\"goto\":[2.2,2.2]}: ");
  EXPECT_EQ(ask(R"(order {"stop": null})")["taken"], true);
  const Finished going = order(R"({"return_home": null})");
  EXPECT_EQ(going.exit_status, 0) << going.err;
  EXPECT_THAT(going.out, HasSubstr("taken at "));
  wait_until_doing("waiting for orders");
  EXPECT_EQ(order(R"({"finish": null})").exit_status, 0);
  EXPECT_EQ(run.exit_status(), 0);

  const std::string record = text_of_file(out_ / "orders.jsonl");
  std::istringstream lines(record);
  std::vector<json> recorded;
  for (std::string line; std::getline(lines, line);) recorded.push_back(json::parse(line));
  ASSERT_EQ(recorded.size(), 4U) << record;
  EXPECT_EQ(recorded[0]["order"], json::parse(R"({"goto": [2.2, 2.2]})"));
  EXPECT_LT(recorded[0]["tick"], recorded[1]["tick"]);

  const Finished again = run_cairn(run_of(folder_ / "again", {"--orders", (out_ / "orders.jsonl").string()}));
  EXPECT_EQ(again.exit_status, 0) << again.err;
  EXPECT_EQ(text_of_file(folder_ / "again" / "orders.jsonl"), record);
  EXPECT_TRUE(text_of_file(folder_ / "again" / "held.cairn") == text_of_file(out_ / "held.cairn"));
}

TEST_F(Orders, BadOnesAreRefusedAndTheMissionGoesOn) {
  Conversation run(run_of(out_, {"--pace", "20"}));
  wait_until_doing("waiting for orders");
  const Finished nowhere = order(R"({"goto": "pilar"})");
  EXPECT_EQ(nowhere.exit_status, 1);
  EXPECT_THAT(nowhere.out, HasSubstr("not taken: no landmark \"pilar\""));
  const Finished misspelt = order(R"({"gotoo": "L1"})");
  EXPECT_EQ(misspelt.exit_status, 2);
  EXPECT_THAT(misspelt.err, HasSubstr("order:1:2: unknown order \"gotoo\" (did you mean \"goto\"?)"));
  const Finished setting = order(R"({"goto": {"landmrk": "L1"}})");
  EXPECT_EQ(setting.exit_status, 1);
  EXPECT_THAT(setting.out, HasSubstr("(did you mean \"landmark\"?)"));
  EXPECT_EQ(run_cairn({"mission", "pause", out_.string()}).exit_status, 0);
  EXPECT_THAT(order(R"({"stop": null})").out, HasSubstr("not taken: the mission is paused"));
  EXPECT_EQ(run_cairn({"mission", "resume", out_.string()}).exit_status, 0);
  EXPECT_EQ(order(R"({"finish": null})").exit_status, 0);
  EXPECT_EQ(run.exit_status(), 0);
}

TEST_F(Orders, WithoutTheStepTheyAreRefused) {
  Conversation run(run_of(out_, {"--pace", "1", "--set", "steps=[{wait: 1000}]"}));
  wait_until_doing("");
  EXPECT_THAT(order(R"({"stop": null})").out, HasSubstr("not taken: no step await_orders is under way"));
  EXPECT_EQ(run_cairn({"mission", "cancel", out_.string()}).exit_status, 0);
  EXPECT_EQ(run.exit_status(), 1);
}

TEST_F(Orders, ABadFileIsRefusedBeforeTheMissionBegins) {
  const fs::path file = folder_ / "orders.jsonl";
  const auto refused = [&](const std::string& text) {
    write_text(file, text);
    const Finished run = run_cairn(run_of(out_, {"--orders", file.string()}));
    EXPECT_EQ(run.exit_status, 2) << run.out;
    return run.err;
  };
  EXPECT_THAT(refused("{\"tick\": 1, \"order\": {\"stop\": null}}\n{\"tick\": 2, \"order\": {\"gotoo\": \"L1\"}}\n"),
              HasSubstr(file.string() + ":2:23: unknown order \"gotoo\" (did you mean \"goto\"?)"));
  EXPECT_THAT(refused("{\"tick\": 2, \"order\": {\"goto\": {\"landmrk\": \"L1\"}}}\n"),
              HasSubstr(file.string() + ":1:32: "));
  EXPECT_THAT(refused("{\"tick\": 2\n"), HasSubstr(file.string() + ":1:"));
  EXPECT_EQ(run_cairn(run_of(out_, {"--orders", (folder_ / "none").string()})).exit_status, 2);
  fs::create_directories(out_);
  write_text(out_ / "orders.jsonl", "");
  const Finished own = run_cairn(run_of(out_, {"--orders", (out_ / "orders.jsonl").string()}));
  EXPECT_EQ(own.exit_status, 2);
  EXPECT_THAT(own.err, HasSubstr("this run would write over it"));
}

TEST_F(Orders, APaceChangesNoByte) {
  const std::string steps = "steps=[{explore: {until_known_ratio: 0.5, at_most_s: 6}}]";
  EXPECT_EQ(run_cairn(run_of(out_, {"--set", steps, "--pace", "max"})).exit_status, 0);
  EXPECT_EQ(run_cairn(run_of(folder_ / "slow", {"--set", steps, "--pace", "4"})).exit_status, 0);
  EXPECT_TRUE(text_of_file(out_ / "held.cairn") == text_of_file(folder_ / "slow" / "held.cairn"));
  const Finished wrong = run_cairn(run_of(out_, {"--pace", "fast"}));
  EXPECT_EQ(wrong.exit_status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("or max"));
}

}  // namespace
}  // namespace cairn::testing_program
