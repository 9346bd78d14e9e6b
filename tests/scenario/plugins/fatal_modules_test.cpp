// Module files that crash, hang or end the program when they are opened: one line each, whatever the command.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ContainsRegex;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

const char* const kFatal[] = {"crashes_at_the_end",     "crashes_when_opened",      "crashes_when_registering",
                              "exits_0_when_opened",    "exits_3_when_registering", "hangs_when_opened",
                              "hangs_when_registering", "prints_and_crashes",       "throws_when_opened",
                              "throws_when_registering"};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

// A plugin folder with some of the test modules, and a cache of its own.
class FatalModules : public testing::Test {
 protected:
  FatalModules() {
    fs::create_directories(plugins_);
    ::setenv("CAIRN_MODULE_CACHE", cache_.c_str(), 1);
    ::setenv("CAIRN_MODULE_TRIAL_S", "3", 1);
    ::setenv("CAIRN_TEST_NOTES", notes_.c_str(), 1);
  }
  ~FatalModules() override {
    for (const char* name : {"CAIRN_MODULE_CACHE", "CAIRN_MODULE_TRIAL_S", "CAIRN_TEST_NOTES", "CAIRN_TEST_FATAL"})
      ::unsetenv(name);
  }
  void add(const std::string& module) const {
    const fs::path built = fs::path(CAIRN_BINARY_DIR) / "tests" / "plugin" / "fatal" / module / (module + ".so");
    fs::copy_file(built, file_of(module));
  }
  void add_all() const {
    for (const char* module : kFatal) add(module);
  }
  [[nodiscard]] fs::path file_of(const std::string& module) const { return plugins_ / (module + ".so"); }
  [[nodiscard]] Finished cairn(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--plugins", plugins_.string()});
    return run_cairn(arguments);
  }
  [[nodiscard]] std::size_t times_opened() const { return lines_of(text_of_file(notes_)).size(); }
  // One second at rest, with the localizer.
  [[nodiscard]] std::string mission_with(const std::string& localizer) const {
    write_text(folder_ / "world.yaml", "bounds_m: [[0, 0], [4, 3]]\n");
    write_text(folder_ / "mission.yaml",
               "mission: short\nrobot: " + source_folder() +
                   "/config/robots/pioneer1.yaml\nworld: world.yaml\nstart: {at_m: [1, 1], angle_deg: 0}\n"
                   "sensor: {plugin: simulated_robot}\nlocalizer: {plugin: " +
                   localizer + "}\nmap: {plugin: muriel}\nsteps:\n  - wait: 1\n");
    return (folder_ / "mission.yaml").string();
  }
  [[nodiscard]] Finished run_mission(const std::string& localizer) const {
    return cairn({"run", mission_with(localizer), "--out", (folder_ / "out").string()});
  }

  const fs::path folder_ = fresh_folder("fatal_modules");
  const fs::path plugins_ = folder_ / "plugins";
  const fs::path cache_ = folder_ / "cache";
  const fs::path notes_ = folder_ / "notes.txt";
};

TEST_F(FatalModules, AListHasOneLineForEachAndAllOthers) {
  add_all();
  add("notes_when_opened");
  for (const char* when : {"cold", "warm"}) {
    const Finished finished = cairn({"plugins"});
    EXPECT_EQ(finished.exit_status, 1) << when;
    EXPECT_THAT(finished.out, AllOf(HasSubstr("simulated_robot"), HasSubstr("noted_localizer"))) << when;
    EXPECT_THAT(lines_of(finished.err), AllOf(testing::SizeIs(std::size(kFatal)), Each(StartsWith("not loaded: "))));
    EXPECT_THAT(finished.err, AllOf(HasSubstr("crashes_when_opened.so: crashed (SIGSEGV) while it was opened"),
                                    HasSubstr("hangs_when_opened.so: did not finish within 3 s"),
                                    HasSubstr("exits_0_when_opened.so: called exit(0) while it was opened"),
                                    HasSubstr("crashes_at_the_end.so: crashed (SIGSEGV) while the program ended")))
        << when;
    EXPECT_THAT(finished.err + finished.out, Not(ContainsRegex("[\x01-\x09\x0b-\x1f\x7f]"))) << when;
  }
  EXPECT_EQ(times_opened(), 1U) << "the second list is of what the first one found";
}

TEST_F(FatalModules, CheckHasALineForEveryFileAndOneObjectForAll) {
  add_all();
  const Finished finished = cairn({"plugins", "check", "--json"});
  EXPECT_EQ(finished.exit_status, 1);
  const auto answer = nlohmann::json::parse(finished.out);
  std::size_t bad = 0;
  for (const auto& file : answer["files"]) {
    const bool is_good = file["faults"].empty();
    EXPECT_EQ(is_good, !file["modules"].empty()) << file;
    if (!is_good) ++bad;
  }
  EXPECT_EQ(bad, std::size(kFatal));
  const std::vector<std::string> lines = lines_of(finished.err);
  EXPECT_EQ(lines.size(), answer["files"].size());
  EXPECT_THAT(lines, testing::Contains(AllOf(HasSubstr("muriel.so: ok: map muriel"))));
  EXPECT_THAT(lines, testing::Contains(HasSubstr("exits_3_when_registering.so: called exit(3) while it registered")));
  EXPECT_THAT(lines, testing::Contains(HasSubstr(
                         "throws_when_registering.so: threw while registering: no \\x1b[31mlicence\\x0afound")));
}

TEST_F(FatalModules, CheckOfGoodFilesSucceedsAndTriesThemAnew) {
  add("notes_when_opened");
  const std::string good = file_of("notes_when_opened").string();
  const std::string muriel = std::string(CAIRN_BINARY_DIR) + "/lib/cairn/muriel.so";
  for (std::size_t times : {1U, 2U}) {
    const Finished finished = cairn({"plugins", "check", good, muriel});
    EXPECT_EQ(finished.exit_status, 0) << finished.out << finished.err;
    EXPECT_THAT(lines_of(finished.out),
                testing::ElementsAre(good + ": ok: localizer noted_localizer", muriel + ": ok: map muriel"));
    EXPECT_EQ(times_opened(), times);
  }
}

TEST_F(FatalModules, CheckOfOneFatalFileSaysWhatItDid) {
  add("hangs_when_registering");
  const Finished finished = cairn({"plugins", "check", file_of("hangs_when_registering").string()});
  EXPECT_EQ(finished.exit_status, 1);
  EXPECT_THAT(finished.out, HasSubstr("did not finish within 3 s while it registered"));
}

TEST_F(FatalModules, AMissionRunsBesideThemAsWithoutThem) {
  add_all();
  const Finished checked = cairn({"mission", "check", mission_with("odometry_compass")});
  EXPECT_EQ(checked.exit_status, 0) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("fine"));
  const Finished finished = run_mission("odometry_compass");
  EXPECT_EQ(finished.exit_status, 0) << finished.err;
  EXPECT_THAT(lines_of(finished.err), AllOf(testing::SizeIs(std::size(kFatal)), Each(StartsWith("not loaded: "))));
}

TEST_F(FatalModules, AMissionOpensOnlyTheFilesThatItNames) {
  add("notes_when_opened");
  EXPECT_EQ(run_mission("odometry_compass").exit_status, 0);
  EXPECT_EQ(times_opened(), 1U) << "in its trial";
  EXPECT_EQ(run_mission("odometry_compass").exit_status, 0);
  EXPECT_EQ(times_opened(), 1U);
  EXPECT_EQ(run_mission("noted_localizer").err, "");
  EXPECT_EQ(times_opened(), 2U) << "by the mission";
}

TEST_F(FatalModules, AMissionThatNamesOneIsRefusedUntilItWorksAgain) {
  add("notes_when_opened");
  ::setenv("CAIRN_TEST_FATAL", "1", 1);
  for (const char* when : {"cold", "warm"}) {
    const Finished refused = run_mission("noted_localizer");
    EXPECT_EQ(refused.exit_status, 2) << when;
    EXPECT_THAT(refused.err, AllOf(HasSubstr("unknown localizer plugin \"noted_localizer\""),
                                   HasSubstr("notes_when_opened.so: crashed (SIGABRT) while it was opened")))
        << when;
  }
  ::unsetenv("CAIRN_TEST_FATAL");
  EXPECT_THAT(run_mission("odometry_compass").err, HasSubstr("in an earlier trial")) << "not needed, not tried";
  EXPECT_THAT(run_mission("noted_localizer").err, Not(HasSubstr("unknown localizer")));
  EXPECT_THAT(run_mission("noted_localizer").err, IsEmpty());
}

TEST_F(FatalModules, WithoutACacheAllStaysTheSame) {
  ::setenv("CAIRN_MODULE_CACHE", "off", 1);
  add("crashes_when_opened");
  add("notes_when_opened");
  EXPECT_EQ(run_mission("noted_localizer").exit_status, 0);
  EXPECT_EQ(times_opened(), 2U);
  EXPECT_FALSE(fs::exists(cache_));
}

TEST_F(FatalModules, OtherCommandsSurviveThemToo) {
  add("crashes_when_opened");
  add("exits_3_when_registering");
  EXPECT_EQ(cairn({"plugins", "info", "muriel"}).exit_status, 0);
  EXPECT_THAT(cairn({"plugins", "info", "murial"}).err, HasSubstr("did you mean \"muriel\"?"));
  EXPECT_THAT(cairn({"plugins", "reference"}).err,
              AllOf(HasSubstr("would be incomplete"), HasSubstr("crashes_when_opened.so: crashed (SIGSEGV)")));
}

}  // namespace
}  // namespace cairn::testing_program
