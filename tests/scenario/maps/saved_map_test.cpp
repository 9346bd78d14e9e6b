// What becomes of the map when a mission is killed, or cannot write.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>

#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

// The office without a planner: a second or two of work.
fs::path small_mission(const fs::path& folder, const std::string& autosave, const std::string& steps) {
  const std::string config = source_folder() + "/config/";
  write_text(folder / "mission.yaml", "mission: office\nseed: 7\nrobot: " + config +
                                          "robots/pioneer1.yaml\nworld: " + config + "worlds/office.yaml\n" +
                                          "start: {at_m: [0.6, 0.6], angle_deg: 0}\n"
                                          "sensor: {plugin: simulated_robot}\nlocalizer: {plugin: odometry_compass}\n"
                                          "map: {plugin: muriel, cell_m: 0.05}\n"
                                          "detector: {plugin: template_matcher, templates: " +
                                          config + "templates, coarse_cells: 5}\n" + "autosave: " + autosave +
                                          "\nsteps: " + steps + "\n");
  return folder / "mission.yaml";
}

const char* const kExplore = "[explore: {until_known_ratio: 0.95, at_most_s: 900}, wait: 5, save: office.cairn]";

Finished run_mission(const fs::path& mission, const fs::path& out, std::vector<std::string> more = {},
                     const Circumstances& circumstances = {}) {
  std::vector<std::string> arguments = {"run", mission.string(), "--out", out.string(), "--json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_cairn(arguments, circumstances);
}

TEST(SavedMap, AnAutosaveChangesNothingButGoesWhenTheMissionEnds) {
  const fs::path folder = fresh_folder("autosave");
  const fs::path mission = small_mission(folder, "{every_s: 0.02}", kExplore);
  const Finished with = run_mission(mission, folder / "with");
  const Finished without = run_mission(mission, folder / "without", {"--set", "autosave.every_s=0"});
  ASSERT_EQ(with.exit_status, 0) << with.err;
  ASSERT_EQ(without.exit_status, 0) << without.err;
  EXPECT_GT(json::parse(with.out)["autosave"]["saved"], 1);
  EXPECT_EQ(json::parse(without.out)["autosave"]["saved"], 0);
  EXPECT_EQ(text_of_file(folder / "with/report.json"), text_of_file(folder / "without/report.json"));
  EXPECT_EQ(text_of_file(folder / "with/office.cairn"), text_of_file(folder / "without/office.cairn"));
  EXPECT_FALSE(fs::exists(folder / "with/office.autosave.cairn"));
}

struct Kills {
  int files = 0;
  int resumed = 0;
  int ended_before = 0;
  std::vector<double> losses_s;  // wall clock from taking the copy in the file to the kill
};

double number_behind(const std::string& text, const std::string& what) {
  return std::stod(text.substr(text.find(what) + what.size()));
}

// The last autosave that was published, against what is in the file.
void expect_all_up_to_the_last_autosave(const Killed& killed, double age_s, const SavedMap& map, Kills& kills) {
  const auto last = std::find_if(killed.lines.rbegin(), killed.lines.rend(), [](const Killed::Line& line) {
    return line.text.find("autosaved") != std::string::npos;
  });
  ASSERT_NE(last, killed.lines.rend());
  ASSERT_TRUE(map.progress);
  EXPECT_GE(map.progress->time_s + 0.0006, number_behind(last->text, "(state at "));
  if (killed.has_ended) return;
  kills.losses_s.push_back(age_s + 1e-3 * number_behind(last->text, "s, written in "));
}

void kill_and_go_on(const fs::path& mission, const fs::path& out, double delay_s, Kills& kills) {
  const Killed killed = kill_cairn({"run", mission.string(), "--out", out.string()}, "autosaved", delay_s);
  fs::path file = out / "office.autosave.cairn";
  kills.ended_before += killed.has_ended ? 1 : 0;
  if (!fs::exists(file)) file = out / "office.cairn";  // the mission had saved its map
  const std::chrono::duration<double> age = fs::file_time_type::clock::now() - fs::last_write_time(file);
  std::string reported;
  for (const Killed::Line& line : killed.lines) reported += line.text + "\n";
  SavedMap map;
  ASSERT_NO_THROW(map = load_map(file)) << (killed.has_ended ? "it had ended by itself: " : "") << reported;
  ++kills.files;
  expect_all_up_to_the_last_autosave(killed, age.count(), map, kills);
  const Finished resumed = run_mission(mission, out, {"--resume", file.string()});
  ASSERT_EQ(resumed.exit_status, 0) << resumed.err;
  const json report = json::parse(resumed.out);
  EXPECT_EQ(report["outcome"], "done");
  EXPECT_EQ(report["resumed_s"].get<double>(), std::round(map.progress->time_s * 1e6) / 1e6);
  EXPECT_GE(report["landmarks"].size(), map.graph.landmarks().size());
  EXPECT_GE(load_map(out / "office.cairn").driven_path.size(), map.driven_path.size());
  ++kills.resumed;
}

// CAIRN_KILLS=200 for the figures of docs/results/saved_maps.md.
TEST(SavedMap, IsWholeAfterAKillAtAnyMomentAndTheMissionGoesOnFromIt) {
  const char* const wanted = std::getenv("CAIRN_KILLS");
  const int count = wanted == nullptr ? 5 : std::atoi(wanted);
  const fs::path folder = fresh_folder("kills");
  const double every_s = wanted == nullptr ? 0.1 : 0.5;
  const fs::path mission = small_mission(folder, "{every_s: " + std::to_string(every_s) + "}", kExplore);
  const Finished whole = run_mission(mission, folder / "whole");
  ASSERT_EQ(whole.exit_status, 0) << whole.err;
  const double longest_s = json::parse(whole.out)["wall_s"];
  std::mt19937_64 random(11);
  Kills kills;
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    const fs::path out = folder / "killed";
    fs::remove_all(out);
    kill_and_go_on(mission, out, longest_s * static_cast<double>(random() >> 11) * 0x1.0p-53, kills);
  }
  EXPECT_EQ(kills.files, count);
  EXPECT_EQ(kills.resumed, count);
  if (wanted == nullptr || kills.losses_s.empty()) return;
  std::ranges::sort(kills.losses_s);
  const auto more = std::ranges::count_if(kills.losses_s, [&](double loss_s) { return loss_s > every_s; });
  std::printf(
      "%d kills, %d after the mission's end; %d files open, %d resumed; lost: median %.3f s, most %.3f s, %d more "
      "than the interval of %.1f s\n",
      count, kills.ended_before, kills.files, kills.resumed, kills.losses_s[kills.losses_s.size() / 2],
      kills.losses_s.back(), static_cast<int>(more), every_s);
}

// An autosave that was written in parts, against the same map written as a whole.
TEST(SavedMap, AMissionGoesOnFromItsAutosaveAsFromAWholeMap) {
  const fs::path folder = fresh_folder("parts");
  const fs::path mission = small_mission(folder, "{every_s: 0.02}", kExplore);
  (void)kill_cairn({"run", mission.string(), "--out", (folder / "killed").string()}, "autosaved", 0.4);
  const fs::path parts = folder / "parts.cairn";
  fs::path left = folder / "killed/office.autosave.cairn";
  if (!fs::exists(left)) left = folder / "killed/office.cairn";
  fs::copy_file(left, parts);
  save_map(folder / "whole.cairn", load_map(parts));
  for (const std::string name : {"parts", "whole"}) {
    const std::string map = folder / (name + ".cairn");
    const Finished resumed = run_mission(mission, folder / name, {"--resume", map});
    ASSERT_EQ(resumed.exit_status, 0) << resumed.err;
  }
  for (const char* file : {"report.json", "office.cairn"})
    EXPECT_TRUE(text_of_file(folder / "parts" / file) == text_of_file(folder / "whole" / file)) << file;
}

TEST(SavedMap, HoweverManyRunsAreKilledInAFolderTwoAutosavesAreKept) {
  const fs::path folder = fresh_folder("two");
  const fs::path mission = small_mission(folder, "{every_s: 0.02}", kExplore);
  for (int i = 0; i < 4; ++i)
    (void)kill_cairn({"run", mission.string(), "--out", (folder / "out").string()}, "autosaved", 0.0);
  std::vector<std::string> autosaves;
  for (const auto& entry : fs::directory_iterator(folder / "out"))
    if (const std::string name = entry.path().filename(); name.starts_with("office.autosave"))
      autosaves.push_back(name);
  EXPECT_THAT(autosaves, testing::UnorderedElementsAre("office.autosave.cairn", "office.autosave.1.cairn"));
  for (const std::string& name : autosaves) EXPECT_NO_THROW((void)load_map(folder / "out" / name));
}

TEST(SavedMap, EveryMapModulesMissionIsGoneOnWith) {
  for (const std::string map : {"bayes", "himm", "murphy", "muriel"}) {
    SCOPED_TRACE(map);
    const fs::path folder = fresh_folder("resume_" + map);
    const fs::path mission = small_mission(folder, "{}", "[wait: 20, save: office.cairn]");
    const std::string module = "map={plugin: " + map + ", cell_m: 0.05}";
    ASSERT_EQ(run_mission(mission, folder / "out", {"--set", module, "--set", "at_most_s=8"}).exit_status, 1);
    const fs::path saved = folder / "out/office.cairn";
    const SavedMap first = load_map(saved);
    const Finished resumed = run_mission(mission, folder / "out", {"--set", module, "--resume", saved.string()});
    ASSERT_EQ(resumed.exit_status, 0) << resumed.err;
    EXPECT_NEAR(json::parse(resumed.out)["resumed_s"].get<double>(), first.progress->time_s, 1e-6);
    const SavedMap last = load_map(saved);
    EXPECT_GT(last.progress->time_s, first.progress->time_s + 19.0);
    EXPECT_FALSE(last.grid == first.grid);
    EXPECT_EQ(united(last.grid.bounds(), first.grid.bounds()), last.grid.bounds());
  }
}

// The part that the map holds is skipped: together the two runs are the one in a single piece.
TEST(SavedMap, ARecordedRunIsGoneOnWith) {
  const fs::path folder = fresh_folder("resume_log");
  const fs::path driven = small_mission(folder, "{}", "[explore: {until_known_ratio: 0.95, at_most_s: 60}]");
  (void)run_mission(driven, folder / "out", {"--set", "record=run.log"});
  const std::string config = source_folder() + "/config/";
  write_text(folder / "log.yaml", "mission: replay\nrobot: " + config + "robots/pioneer1.yaml\nsensor: {plugin: " +
                                      "carmen_log, file: out/run.log}\nlocalizer: {plugin: odometry_compass}\n" +
                                      "map: {plugin: bayes, cell_m: 0.05}\n");
  ASSERT_EQ(run_mission(folder / "log.yaml", folder / "whole").exit_status, 0);
  ASSERT_EQ(run_mission(folder / "log.yaml", folder / "part", {"--set", "at_most_s=20"}).exit_status, 1);
  const fs::path part = folder / "part/replay.cairn";
  const Finished resumed = run_mission(folder / "log.yaml", folder / "rest", {"--resume", part.string()});
  ASSERT_EQ(resumed.exit_status, 0) << resumed.err;
  const SavedMap whole = load_map(folder / "whole/replay.cairn");
  const SavedMap rest = load_map(folder / "rest/replay.cairn");
  EXPECT_EQ(rest.progress->time_s, whole.progress->time_s);
  EXPECT_EQ(rest.progress->readings, whole.progress->readings);
  EXPECT_EQ(rest.grid.bounds(), whole.grid.bounds());
}

TEST(SavedMap, AnotherMissionsRobotsOrCellsMapIsRefused) {
  const fs::path folder = fresh_folder("resume");
  const fs::path mission = small_mission(folder, "{}", "[wait: 1]");
  ASSERT_EQ(run_mission(mission, folder / "out").exit_status, 0);
  const fs::path map = folder / "out/office.cairn";
  const std::string before = text_of_file(map);
  const auto refusal = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--resume", map.string()});
    const Finished run = run_mission(mission, folder / "out", more);
    EXPECT_EQ(run.exit_status, 2);
    EXPECT_THAT(run.err, HasSubstr(map.string() + ": cannot go on with this mission: "));
    return run.err;
  };
  EXPECT_THAT(refusal({"--set", "mission=attic"}),
              HasSubstr("the map was made by mission \"office\", the mission's is \"attic\""));
  EXPECT_THAT(refusal({"--set", "robot=" + source_folder() + "/config/robots/small_car.yaml"}),
              HasSubstr("with robot"));
  EXPECT_THAT(refusal({"--set", "map.cell_m=0.1"}), HasSubstr("the map has cells of 0.05 m, the mission's of 0.1 m"));
  EXPECT_THAT(refusal({"--seed", "8"}), HasSubstr("the map was made with seed \"7\", the mission's is \"8\""));
  small_mission(folder, "{}", "[wait: 1, wait: 2, wait: 3]");
  EXPECT_THAT(refusal({}), HasSubstr("the map was saved at step 2, the end; in this mission there comes wait"));
  EXPECT_EQ(text_of_file(map), before);
}

TEST(SavedMap, WhatARunHasLeftThatDidNotEndIsKept) {
  const fs::path folder = fresh_folder("earlier");
  const fs::path mission = small_mission(folder, "{}", "[wait: 1]");
  ASSERT_EQ(run_mission(mission, folder / "out").exit_status, 0);
  fs::copy_file(folder / "out/office.cairn", folder / "out/office.autosave.cairn");
  const Finished run = run_mission(mission, folder / "out");
  EXPECT_EQ(run.exit_status, 0);
  EXPECT_THAT(run.err, HasSubstr("an earlier run here did not end: its map is kept as"));
  EXPECT_NO_THROW((void)load_map(folder / "out/office.autosave.1.cairn"));
}

// What the program says when nothing more can be written: all of it, and soon.
void expect_a_clear_end(const Finished& run, const std::string& why) {
  EXPECT_EQ(run.exit_status, 1) << run.err;
  EXPECT_THAT(run.err, HasSubstr("autosave failed, the mission continues: "));
  const json report = json::parse(run.out);
  EXPECT_EQ(report["outcome"], "map_not_saved");
  EXPECT_THAT(report["reason"], HasSubstr("the map could not be saved: "));
  EXPECT_THAT(report["reason"], HasSubstr(why));
  EXPECT_EQ(report["map"], "");
  EXPECT_GT(report["autosave"]["failed"], 0);
  EXPECT_THAT(report["autosave"]["reason"], HasSubstr(why));
  EXPECT_GT(report["time_s"], 4.9);  // the steps behind the save were done too
}

TEST(SavedMap, AMissionOnAFullDiskGoesOnAndSaysThatItsMapIsNotSaved) {
  const fs::path folder = fresh_folder("full");
  const fs::path mission = small_mission(folder, "{every_s: 0.01}", "[save: office.cairn, wait: 5]");
  ASSERT_EQ(run_mission(mission, folder / "warm").exit_status, 0);
  const fs::path out = folder / "out";
  fs::create_directories(out);
  write_text(out / "office.cairn", text_of_file(folder / "warm/office.cairn"));
  expect_a_clear_end(run_mission(mission, out, {}, {1024, false}), "File too large");
  EXPECT_EQ(text_of_file(out / "office.cairn"), text_of_file(folder / "warm/office.cairn")) << "the old map is lost";
}

TEST(SavedMap, AMissionInAReadOnlyFolderGoesOnAndSaysThatItsMapIsNotSaved) {
  const fs::path folder = fresh_folder("read_only");
  const fs::path mission = small_mission(folder, "{every_s: 0.01}", "[save: office.cairn, wait: 5]");
  const fs::path out = folder / "out";
  fs::create_directories(out);
  fs::permissions(out, fs::perms(0555));
  const Finished run = run_mission(mission, out, {}, {{}, true});
  if (run.exit_status == 126 || run.exit_status == 127) GTEST_SKIP() << "nobody may not run the program";
  expect_a_clear_end(run, "Permission denied");
  EXPECT_TRUE(fs::is_empty(out));
}

TEST(SavedMap, AFinishedMapIsKeptWhenALaterRunDoesNotEnd) {
  const fs::path folder = fresh_folder("finished");
  const fs::path mission = small_mission(folder, "{}", "[wait: 6]");
  ASSERT_EQ(run_mission(mission, folder / "out").exit_status, 0);
  const std::string finished = text_of_file(folder / "out/office.cairn");
  const Finished cut = run_mission(mission, folder / "out", {"--set", "at_most_s=2"});
  EXPECT_EQ(cut.exit_status, 1);
  EXPECT_THAT(cut.err, HasSubstr("the map of an earlier one that did is kept as office.1.cairn"));
  EXPECT_EQ(text_of_file(folder / "out/office.1.cairn"), finished);
  ASSERT_EQ(run_mission(mission, folder / "out").exit_status, 0);
  EXPECT_FALSE(fs::exists(folder / "out/office.2.cairn"));
}

TEST(SavedMap, TwoRunsDoNotWriteIntoOneFolder) {
  const fs::path folder = fresh_folder("held");
  const fs::path mission = small_mission(folder, "{}", "[wait: 6]");
  fs::create_directories(folder / "out");
  const int held = ::open((folder / "out/.cairn.lock").c_str(), O_RDWR | O_CREAT, 0600);
  ASSERT_EQ(::flock(held, LOCK_EX), 0);
  ASSERT_EQ(::write(held, "4321\n", 5), 5);
  const Finished second = run_mission(mission, folder / "out");
  EXPECT_EQ(second.exit_status, 2);
  EXPECT_THAT(second.err, HasSubstr("another run (process 4321) is writing into this folder"));
  ::close(held);
  EXPECT_EQ(run_mission(mission, folder / "out").exit_status, 0);
}

TEST(SavedMap, AutosavesHaveANameOfTheirOwn) {
  const fs::path folder = fresh_folder("names");
  for (const std::string name : {"office.cairn", "report.json", "../x.cairn"}) {
    const Finished run = run_mission(small_mission(folder, "{file: " + name + "}", "[wait: 1]"), folder / "out");
    EXPECT_EQ(run.exit_status, 2) << name;
    EXPECT_THAT(run.err, HasSubstr("mission.yaml:10:18: autosave.file: ")) << name;
  }
  const fs::path saves = small_mission(folder, "{file: a.cairn}", "[save: a.cairn]");
  const Finished run = run_mission(saves, folder / "out");
  EXPECT_EQ(run.exit_status, 1);
  EXPECT_THAT(run.err + run.out, HasSubstr("a.cairn is the name of the mission's autosaves"));
}

TEST(SavedMap, IsCheckedAndRepairedByTheProgram) {
  const fs::path folder = fresh_folder("repair");
  const fs::path mission = small_mission(folder, "{}", "[wait: 3]");
  ASSERT_EQ(run_mission(mission, folder).exit_status, 0);
  const std::string map = folder / "office.cairn";
  EXPECT_EQ(run_cairn({"map", "check", map, "--json"}).exit_status, 0);
  const std::string sound = text_of_file(map);
  const std::string damaged = sound.substr(0, sound.size() * 2 / 3);
  write_text(map, damaged);
  const Finished check = run_cairn({"map", "check", map, "--json"});
  EXPECT_EQ(check.exit_status, 2);
  const json found = json::parse(check.out);
  EXPECT_EQ(found["outcome"], "damaged");
  EXPECT_FALSE(found["lost"].empty());
  EXPECT_THAT(check.err, HasSubstr("is truncated: "));
  const std::string repaired = folder / "repaired.cairn";
  EXPECT_EQ(run_cairn({"map", "repair", map, "-o", map}).exit_status, 2);
  const Finished repair = run_cairn({"map", "repair", map, "-o", repaired, "--json"});
  EXPECT_EQ(repair.exit_status, 0) << repair.err;
  EXPECT_EQ(json::parse(repair.out)["lost"], found["lost"]);
  EXPECT_EQ(text_of_file(map), damaged);
  EXPECT_EQ(run_cairn({"map", "check", repaired}).exit_status, 0);

  std::string misspelt = sound;
  misspelt[misspelt.find("CREATE TABLE tiles")] = 'K';
  write_text(map, misspelt);
  const Finished misspelt_check = run_cairn({"map", "check", map, "--json"});
  EXPECT_EQ(misspelt_check.exit_status, 2);
  EXPECT_EQ(json::parse(misspelt_check.out)["lost"], json::array());
  const Finished all_saved = run_cairn({"map", "repair", map, "-o", repaired, "--json"});
  EXPECT_EQ(json::parse(all_saved.out)["outcome"], "repaired") << "nothing is lost, but the file was damaged";
  EXPECT_TRUE(text_of_file(repaired) == sound);
}

TEST(SavedMap, ARepairReportsTheValuesThatItCouldNotMend) {
  const fs::path folder = fresh_folder("repair_values");
  ASSERT_EQ(run_mission(small_mission(folder, "{}", "[wait: 1]"), folder).exit_status, 0);
  SavedMap map = load_map(folder / "office.cairn");
  map.driven_path.push_back({1e18, 0.0, 0.0});
  const std::string far = folder / "far.cairn";
  save_map(far, map);
  ASSERT_EQ(run_cairn({"map", "check", far}).exit_status, 2);
  const Finished repair = run_cairn({"map", "repair", far, "-o", folder / "repaired.cairn", "--json"});
  EXPECT_EQ(repair.exit_status, 2);
  const json report = json::parse(repair.out);
  EXPECT_EQ(report["outcome"], "bad_values");
  EXPECT_FALSE(report["bad_values"].empty());
  EXPECT_THAT(repair.err, HasSubstr("repaired.cairn: still holds values that cannot be true\n"));
}

}  // namespace
}  // namespace cairn::testing_program
