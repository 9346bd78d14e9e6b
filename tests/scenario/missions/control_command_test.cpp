// Missions held from outside while they run, and gone on with inside a step.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

fs::path mission_in(const fs::path& folder, const std::string& steps, const std::string& more = "") {
  const std::string config = source_folder() + "/config/";
  if (!fs::exists(folder / "world.yaml"))
    write_text(folder / "world.yaml",
               "bounds_m: [[0, 0], [3, 3]]\nwalls: [{points_m: [[0, 0], [3, 0], [3, 3], [0, 3], [0, 0]]}]\n");
  write_text(folder / "mission.yaml", "mission: held\nrobot: " + config +
                                          "robots/pioneer1.yaml\nworld: world.yaml\n"
                                          "start: {at_m: [0.6, 0.6], angle_deg: 0}\n"
                                          "sensor: {plugin: simulated_robot}\nlocalizer: {plugin: odometry_compass}\n"
                                          "map: {plugin: muriel, cell_m: 0.05}\n" +
                                          more + "steps: " + steps + "\n");
  return folder / "mission.yaml";
}

json status_of(const fs::path& out) {
  const Finished asked = run_cairn({"mission", "status", out.string(), "--json"});
  return asked.exit_status == 0 ? json::parse(asked.out) : json::object();
}

// As often as it takes: the program is no faster than the machine.
json status_in(const fs::path& out, const std::string& state, double after_s = 0.0) {
  json status;
  for (int i = 0; i < 400; ++i) {
    status = status_of(out);
    if (status.value("state", "") == state && status.value("time_s", 0.0) >= after_s) return status;
  }
  ADD_FAILURE() << "never " << state << ": " << status;
  return status;
}

class Control : public testing::Test {
 protected:
  Control() : folder_(fresh_folder("control")), out_(folder_ / "out") {}
  ~Control() override { fs::remove_all(folder_); }
  [[nodiscard]] Finished report(const std::string& command) const {
    return run_cairn({"mission", command, out_.string()});
  }
  [[nodiscard]] std::vector<std::string> run_of(const fs::path& mission, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"run", mission.string(), "--out", out_.string(), "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  fs::path folder_;
  fs::path out_;
};

TEST_F(Control, PauseResumeStatusAndCancelReachARunningMission) {
  Conversation run(run_of(mission_in(folder_, "[wait: 1000]"), {"--realtime"}));
  const json running = status_in(out_, "running");
  EXPECT_EQ(running["mission"], "held");
  EXPECT_EQ(running["step_name"], "wait");
  EXPECT_EQ(running["node"], "1");
  EXPECT_NEAR(running["eta_s"].get<double>() + running["time_s"].get<double>(), 1000.0, 0.1);
  struct stat socket {};
  ASSERT_EQ(::stat((out_ / "control.sock").c_str(), &socket), 0);
  EXPECT_EQ(socket.st_mode & 0777U, 0600U) << "others may not control it";

  const Finished paused = report("pause");
  EXPECT_EQ(paused.exit_status, 0) << paused.err;
  EXPECT_THAT(paused.out, HasSubstr("mission held is paused at "));
  const json first = status_in(out_, "paused");
  const json second = status_in(out_, "paused");
  EXPECT_EQ(first["time_s"], second["time_s"]) << "the clock stands";
  EXPECT_GT(second["paused_s"], first["paused_s"]) << "while readings still come";

  EXPECT_THAT(report("resume").out, HasSubstr("mission held resumed at "));
  (void)status_in(out_, "running", second["time_s"].get<double>() + 0.1);
  const Finished cancelled = report("cancel");
  EXPECT_EQ(cancelled.exit_status, 0) << cancelled.err;
  EXPECT_THAT(cancelled.out, HasSubstr("mission held has ended: cancelled, saved held.cairn"));
  EXPECT_EQ(run.exit_status(), 1);
  EXPECT_NO_THROW((void)load_map(out_ / "held.cairn"));
  EXPECT_FALSE(fs::exists(out_ / "control.sock"));
  EXPECT_EQ(status_of(out_)["outcome"], "cancelled");
  const json report = json::parse(text_of_file(out_ / "report.json"));
  ASSERT_EQ(report["pauses"].size(), 1U);
  EXPECT_GT(report["pauses"][0]["for_s"], 0.0);
  EXPECT_EQ(report["node_runs"].size(), 1U);
  EXPECT_EQ(report["node_runs"][0]["outcome"], "halted");
}

TEST_F(Control, SignalsPauseAndLetGoOn) {
  Conversation run(run_of(mission_in(folder_, "[wait: 1000]"), {"--realtime"}));
  (void)status_in(out_, "running");
  run.send(SIGUSR1);
  (void)status_in(out_, "paused");
  run.send(SIGUSR2);
  (void)status_in(out_, "running");
  run.send(SIGTERM);
  EXPECT_EQ(run.exit_status(), 1);
}

// As timeout(1) does: to the program and to its group.
TEST_F(Control, ReportedTwoTerminationsAtOnceAreOne) {
  Conversation run(run_of(mission_in(folder_, "[wait: 1000]"), {"--realtime"}));
  (void)status_in(out_, "running");
  run.send(SIGTERM);
  std::this_thread::sleep_for(std::chrono::milliseconds(5));  // two that wait are one for the kernel too
  run.send(SIGTERM);
  EXPECT_EQ(run.exit_status(), 1);
  EXPECT_TRUE(fs::exists(out_ / "report.json"));
}

TEST_F(Control, ReportedWhereNothingRunsItSaysSo) {
  const Finished nowhere = run_cairn({"mission", "pause", (folder_ / "no").string()});
  EXPECT_EQ(nowhere.exit_status, 2);
  EXPECT_THAT(nowhere.err, HasSubstr("there is no such folder"));
  fs::create_directories(out_);
  EXPECT_EQ(report("cancel").exit_status, 2);
  EXPECT_THAT(report("cancel").err, HasSubstr("no mission runs in this folder"));
  EXPECT_THAT(report("status").err, HasSubstr("no mission runs in this folder, and none has ended here"));
  const Finished misspelt = run_cairn({"mission", "paus", out_.string()});
  EXPECT_EQ(misspelt.exit_status, 2);
  EXPECT_THAT(misspelt.err, HasSubstr("did you mean \"pause\"?"));
  ASSERT_EQ(run_cairn(run_of(mission_in(folder_, "[wait: 1]"))).exit_status, 0);
  EXPECT_EQ(status_of(out_)["state"], "ended");
  EXPECT_EQ(status_of(out_)["outcome"], "done");
  EXPECT_EQ(report("pause").exit_status, 2);
}

TEST_F(Control, WhatIsNoCommandIsRefusedAndTheMissionGoesOn) {
  Conversation run(run_of(mission_in(folder_, "[wait: 1000]"), {"--realtime"}));
  (void)status_in(out_, "running");
  const json unknown = json::parse(answer_to(out_ / "control.sock", "resum\n"));
  EXPECT_EQ(unknown["ok"], false);
  EXPECT_THAT(unknown["error"].get<std::string>(), HasSubstr("did you mean \"resume\"?"));
  const json long_one = json::parse(answer_to(out_ / "control.sock", std::string(100000, 'x')));
  EXPECT_THAT(long_one["error"].get<std::string>(), HasSubstr("one line of at most 1024 bytes"));
  EXPECT_EQ(json::parse(answer_to(out_ / "control.sock", "status\n"))["state"], "running");
  EXPECT_EQ(report("cancel").exit_status, 0);
  EXPECT_EQ(run.exit_status(), 1);
}

TEST_F(Control, NobodyWaitsForTheAnswerToAnother) {
  Conversation run(run_of(mission_in(folder_, "[wait: 1000]"), {"--realtime"}));
  (void)status_in(out_, "running");
  // Connected, and says nothing: it is listened to for two seconds.
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  (out_ / "control.sock").string().copy(name.sun_path, sizeof name.sun_path - 1);
  const int silent = ::socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(::connect(silent, reinterpret_cast<const sockaddr*>(&name), sizeof name), 0);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(json::parse(answer_to(out_ / "control.sock", "status\n"))["state"], "running");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(1900));
  ::close(silent);
  EXPECT_EQ(report("cancel").exit_status, 0);
  EXPECT_EQ(run.exit_status(), 1);
}

std::size_t runs_of(const json& report, const std::string& path, const std::string& outcome) {
  return static_cast<std::size_t>(std::ranges::count_if(
      report["node_runs"], [&](const json& run) { return run["path"] == path && run["outcome"] == outcome; }));
}

// Killed in the third second of five rounds of a second.
TEST_F(Control, AMissionThatWasKilledGoesOnInTheRoundThatWasUnderWay) {
  const fs::path mission =
      mission_in(folder_, "[repeat: {times: 5, do: [wait: 0.5, wait: 0.5]}, wait: 1]", "autosave: {every_s: 0.05}\n");
  const Killed killed =
      kill_cairn({"run", mission.string(), "--out", out_.string(), "--realtime"}, "step 1/1/2: wait", 1.8);
  ASSERT_FALSE(killed.has_ended);
  const fs::path map = out_ / "held.autosave.cairn";
  EXPECT_EQ(status_of(out_)["state"], "cut_short");
  const Finished pause = report("pause");
  EXPECT_EQ(pause.exit_status, 2);
  EXPECT_THAT(pause.err, HasSubstr("was cut short; cairn run --resume " + map.string()));
  const json state = json::parse(load_map(map).properties.at("tree_state"));
  const auto rounds = state["running"][0]["rounds"].get<std::size_t>();
  ASSERT_GE(rounds, 1U);
  ASSERT_LE(rounds, 3U);
  const Finished resumed = run_cairn(run_of(mission, {"--resume", map.string()}));
  ASSERT_EQ(resumed.exit_status, 0) << resumed.err;
  const json report = json::parse(text_of_file(out_ / "report.json"));
  EXPECT_EQ(runs_of(report, "1/1", "success"), 5 - rounds);
  EXPECT_EQ(runs_of(report, "1", "success"), 1U);
  EXPECT_EQ(runs_of(report, "2", "success"), 1U);
}

TEST_F(Control, AnotherTreeBeginsTheStepAfreshAndADamagedStateIsRefused) {
  const fs::path mission = mission_in(folder_, "[repeat: {times: 3, do: {wait: 2}}]");
  ASSERT_EQ(run_cairn(run_of(mission, {"--set", "at_most_s=3"})).exit_status, 1);
  const fs::path map = folder_ / "cut.cairn";
  fs::copy_file(out_ / "held.cairn", map);
  const Finished whole = run_cairn(run_of(mission, {"--resume", map.string()}));
  ASSERT_EQ(whole.exit_status, 0) << whole.err;
  EXPECT_EQ(runs_of(json::parse(text_of_file(out_ / "report.json")), "1/1", "success"), 2U);
  (void)mission_in(folder_, "[repeat: {times: 4, do: {wait: 2}}]");
  const Finished other = run_cairn(run_of(mission, {"--resume", map.string()}));
  ASSERT_EQ(other.exit_status, 0) << other.err;
  EXPECT_THAT(other.err, HasSubstr("step 1 (repeat) is not written as when the map was saved: it begins afresh"));
  EXPECT_EQ(runs_of(json::parse(text_of_file(out_ / "report.json")), "1/1", "success"), 4U);

  (void)mission_in(folder_, "[repeat: {times: 3, do: {wait: 2}}]");
  for (const std::string bad : {"{", "{\"running\":[{\"path\":\"1\"}]}", "{\"running\":{}}"}) {
    SavedMap damaged = load_map(map);
    damaged.properties["tree_state"] = bad;
    save_map(folder_ / "damaged.cairn", damaged);
    const Finished refused = run_cairn(run_of(mission, {"--resume", (folder_ / "damaged.cairn").string()}));
    EXPECT_EQ(refused.exit_status, 2) << bad;
    EXPECT_THAT(refused.err, HasSubstr("damaged.cairn: cannot be resumed: its property tree_state: ")) << bad;
  }
}

TEST_F(Control, TheTimeOfPausesIsKeptSinceTheWorldWentOnMeanwhile) {
  const fs::path mission = mission_in(folder_, "[wait: 4]");
  write_text(folder_ / "world.yaml", text_of_file(folder_ / "world.yaml") +
                                         "doors: [{from_m: [2.2, 0.1], to_m: [2.2, 1.1], closed_s: [[8, 100]]}]\n");
  ASSERT_EQ(run_cairn(run_of(mission, {"--set", "at_most_s=2"})).exit_status, 1);
  const fs::path map = folder_ / "cut.cairn";
  SavedMap saved = load_map(out_ / "held.cairn");
  EXPECT_FALSE(saved.properties.contains("paused_s"));
  const auto grid_after = [&](const std::string& paused_s) {
    saved.properties["paused_s"] = paused_s;
    save_map(map, saved);
    EXPECT_EQ(run_cairn(run_of(mission, {"--resume", map.string()})).exit_status, 0);
    return load_map(out_ / "held.cairn");
  };
  const SavedMap soon = grid_after("1.5");
  const SavedMap later = grid_after("20");
  EXPECT_EQ(later.properties.at("paused_s"), "20");
  const auto is_seen = [](const SavedMap& of, const Point& at) { return of.grid.log_odds(of.grid.cell_at(at)); };
  EXPECT_GT(is_seen(later, {2.2, 0.6}), is_seen(soon, {2.2, 0.6})) << "the door has closed while the mission paused";
  for (const std::string bad : {"soon", "-1", "nan", "1e300", "2 s"}) {
    saved.properties["paused_s"] = bad;
    save_map(map, saved);
    const Finished refused = run_cairn(run_of(mission, {"--resume", map.string()}));
    EXPECT_EQ(refused.exit_status, 2) << bad;
    EXPECT_THAT(refused.err, HasSubstr("its property paused_s is \"" + bad + "\", not a time in seconds")) << bad;
  }
}

TEST_F(Control, AnotherWorldIsRefusedUnlessTheUserSaysSo) {
  const fs::path mission = mission_in(folder_, "[wait: 5]");
  ASSERT_EQ(run_cairn(run_of(mission, {"--set", "at_most_s=2"})).exit_status, 1);
  std::ofstream(folder_ / "world.yaml", std::ios::app) << "# moved\n";
  const std::string map = out_ / "held.cairn";
  const Finished refused = run_cairn(run_of(mission, {"--resume", map}));
  EXPECT_EQ(refused.exit_status, 2);
  EXPECT_THAT(refused.err, HasSubstr("the map was made in another world than"));
  EXPECT_EQ(run_cairn(run_of(mission, {"--resume", map, "--other-world"})).exit_status, 0);
}

}  // namespace
}  // namespace cairn::testing_program
