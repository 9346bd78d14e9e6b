#include "framework/modules/trial/child_trial.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <fstream>

#include "framework/modules/module_library.hpp"

namespace cairn {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const fs::path kProgram = fs::path(CAIRN_BINARY_DIR) / "bin" / "cairn";

fs::path file_of(const std::string& fault) {
  return fs::path(CAIRN_BINARY_DIR) / "tests" / "plugin" / "fatal" / fault / (fault + ".so");
}

TrialOutcome outcome_of(const std::string& fault) {
  return ChildTrial(kProgram).outcome_of(file_of(fault));
}

// Much shorter than a program that works would need on a busy machine; these never end.
TrialOutcome outcome_of_hanging(const std::string& fault) {
  return ChildTrial(kProgram, std::chrono::milliseconds(1500)).outcome_of(file_of(fault));
}

TEST(ChildTrial, AGoodFileIsKnownByItsModules) {
  const TrialOutcome outcome = outcome_of("notes_when_opened");
  EXPECT_EQ(outcome.fault, "");
  EXPECT_FALSE(outcome.is_fatal);
  ASSERT_EQ(outcome.modules.size(), 1U);
  EXPECT_EQ(outcome.modules[0].kind, PluginKind::localizer);
  EXPECT_EQ(outcome.modules[0].name, "noted_localizer");
  EXPECT_EQ(outcome.modules[0].summary, "does nothing");
}

TEST(ChildTrial, SaysHowFarAFileCameThatCrashes) {
  EXPECT_EQ(outcome_of("crashes_when_opened").fault, "crashed (SIGSEGV) while it was opened");
  EXPECT_THAT(outcome_of("crashes_when_registering").fault, StartsWith("crashed (SIGABRT) while it registered"));
  EXPECT_EQ(outcome_of("crashes_at_the_end").fault, "crashed (SIGSEGV) while the program ended");
  EXPECT_TRUE(outcome_of("crashes_when_opened").is_fatal);
}

TEST(ChildTrial, AFileThatEndsTheProgramIsNotGoodWhateverItsExitStatus) {
  EXPECT_EQ(outcome_of("exits_0_when_opened").fault, "called exit(0) while it was opened");
  EXPECT_EQ(outcome_of("exits_3_when_registering").fault, "called exit(3) while it registered");
}

TEST(ChildTrial, AFileThatHangsIsGivenUp) {
  EXPECT_THAT(outcome_of_hanging("hangs_when_opened").fault, StartsWith("did not finish within 1500 ms"));
  const TrialOutcome outcome = outcome_of_hanging("hangs_when_registering");
  EXPECT_THAT(outcome.fault, StartsWith("did not finish within 1500 ms"));
  EXPECT_TRUE(outcome.is_fatal);
}

TEST(ChildTrial, WhatAFilePrintsOrThrowsIsShownHarmless) {
  EXPECT_EQ(outcome_of("prints_and_crashes").fault,
            "crashed (SIGSEGV) while it registered; it printed \"\\x1b[2Jout\\x0aerr\\x0d\\x07\"");
  EXPECT_EQ(outcome_of("throws_when_opened").fault, "cannot be opened as a module: no \\x1b[31mlicence\\x0afound");
  const TrialOutcome outcome = outcome_of("throws_when_registering");
  EXPECT_EQ(outcome.fault, "threw while registering: no \\x1b[31mlicence\\x0afound");
  EXPECT_FALSE(outcome.is_fatal);
}

TEST(ChildTrial, AFaultOfTheLoaderIsTheSameAsWithoutATrial) {
  EXPECT_EQ(ChildTrial(kProgram).outcome_of("/nowhere/at_all.so").fault, "no such file");
}

TEST(ChildTrial, AProgramThatCannotBeStartedIsAFault) {
  EXPECT_THAT(ChildTrial("/nowhere/cairn").outcome_of(file_of("notes_when_opened")).fault,
              StartsWith("could not be tried: cannot start a process"));
}

// Notes which processes open the file, and sets how it fares in them.
class OpenedModule : public testing::Test {
 protected:
  OpenedModule() {
    fs::remove(notes_);
    ::setenv("CAIRN_TEST_NOTES", notes_.c_str(), 1);
  }
  ~OpenedModule() override {
    ::unsetenv("CAIRN_TEST_NOTES");
    ::unsetenv("CAIRN_TEST_FATAL");
  }
  [[nodiscard]] int times_opened() const {
    std::ifstream in(notes_);
    int lines = 0;
    for (std::string line; std::getline(in, line);) ++lines;
    return lines;
  }

  const fs::path notes_ = fs::path(testing::TempDir()) / "cairn_opened_module.txt";
};

// Says of every file what it is to say.
class SetTrial : public ModuleTrial {
 public:
  SetTrial(TrialOutcome first, TrialOutcome again) : first_(std::move(first)), again_(std::move(again)) {}
  [[nodiscard]] TrialOutcome outcome_of(const fs::path&) const override { return first_; }
  [[nodiscard]] TrialOutcome try_again(const fs::path&) const override { return again_; }

 private:
  TrialOutcome first_;
  TrialOutcome again_;
};

const TrialOutcome kGood{"", {{PluginKind::localizer, "noted_localizer", "does nothing"}}, false, false};

ModuleLibrary library_with(const TrialOutcome& first, const TrialOutcome& again = {}) {
  return ModuleLibrary({file_of("notes_when_opened").parent_path()}, std::make_shared<SetTrial>(first, again));
}

TEST_F(OpenedModule, AFileIsOpenedWhenAModuleOfItIsAskedForAndOnlyThen) {
  const ModuleLibrary library = library_with(kGood);
  ASSERT_EQ(library.known().size(), 1U);
  EXPECT_EQ(library.known()[0].name, "noted_localizer");
  EXPECT_EQ(library.find_any("other"), nullptr);
  EXPECT_EQ(times_opened(), 0);
  ASSERT_NE(library.find_any("noted_localizer"), nullptr);
  EXPECT_EQ(library.find_any("noted_localizer")->module->summary, "does nothing");
  EXPECT_EQ(library.entries().size(), 1U);
  EXPECT_EQ(times_opened(), 1);
}

TEST_F(OpenedModule, AFileThatFailedItsTrialIsNeverOpened) {
  ::setenv("CAIRN_TEST_FATAL", "1", 1);
  const ModuleLibrary library =
      ModuleLibrary({file_of("notes_when_opened").parent_path()}, std::make_shared<ChildTrial>(kProgram));
  EXPECT_THAT(library.faults(), ElementsAre(HasSubstr("notes_when_opened.so: crashed (SIGABRT) while it was opened")));
  EXPECT_THAT(library.known(), IsEmpty());
  EXPECT_THAT(library.entries(), IsEmpty());
}

TEST_F(OpenedModule, ANameThatIsMissingGivesARememberedFaultAnotherTrial) {
  TrialOutcome crashed;
  crashed.fault = "crashed";
  crashed.is_fatal = true;
  crashed.is_remembered = true;
  const ModuleLibrary library = library_with(crashed, kGood);
  EXPECT_THAT(library.faults(), ElementsAre(HasSubstr("notes_when_opened.so: crashed")));
  EXPECT_NE(library.find_any("noted_localizer"), nullptr);
  EXPECT_THAT(library.faults(), IsEmpty());
  crashed.is_remembered = false;
  EXPECT_EQ(library_with(crashed, kGood).find_any("noted_localizer"), nullptr) << "it was tried just now";
}

TEST_F(OpenedModule, AFileThatNoLongerRegistersWhatItDidInItsTrialIsAFault) {
  TrialOutcome other = kGood;
  other.modules[0].name = "gone";
  const ModuleLibrary library = library_with(other);
  EXPECT_EQ(library.find_any("gone"), nullptr);
  EXPECT_THAT(library.faults(), ElementsAre(HasSubstr("does not register \"gone\" any more")));
}

}  // namespace
}  // namespace cairn
