#include "framework/modules/trial/cached_trial.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <thread>
#include <vector>

namespace cairn {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

// Counts how often it is asked.
class CountingTrial : public ModuleTrial {
 public:
  CountingTrial(std::atomic<int>& count, TrialOutcome& outcome) : count_(count), outcome_(outcome) {}
  [[nodiscard]] TrialOutcome outcome_of(const fs::path&) const override {
    ++count_;
    return outcome_;
  }

 private:
  std::atomic<int>& count_;
  TrialOutcome& outcome_;
};

class CachedTrialOfAFile : public testing::Test {
 protected:
  CachedTrialOfAFile() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    write("some code");
    outcome_.modules = {{PluginKind::map, "one", "a map"}};
  }
  ~CachedTrialOfAFile() override { fs::remove_all(folder_); }
  void write(const std::string& bytes) const { std::ofstream(file_, std::ios::binary) << bytes; }
  // A new one each time: only the folder remembers.
  [[nodiscard]] CachedTrial trial(const fs::path& cache) {
    return {std::make_unique<CountingTrial>(count_, outcome_), cache};
  }
  [[nodiscard]] TrialOutcome outcome() { return trial(folder_ / "cache").outcome_of(file_); }
  void fail_fatally() {
    outcome_ = {};
    outcome_.fault = "crashed";
    outcome_.is_fatal = true;
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / ("cairn_cached_trial_" + std::to_string(::getpid()));
  const fs::path file_ = folder_ / "module.so";
  std::atomic<int> count_ = 0;
  TrialOutcome outcome_;
};

TEST_F(CachedTrialOfAFile, AGoodFileIsTriedOnce) {
  EXPECT_FALSE(outcome().is_remembered);
  const TrialOutcome second = outcome();
  EXPECT_TRUE(second.is_remembered);
  EXPECT_EQ(second.fault, "");
  ASSERT_EQ(second.modules.size(), 1U);
  EXPECT_EQ(second.modules[0].name, "one");
  EXPECT_EQ(count_, 1);
}

TEST_F(CachedTrialOfAFile, AnotherFileWithTheSameBytesIsTheSame) {
  (void)outcome();
  fs::copy_file(file_, folder_ / "copy.so");
  EXPECT_TRUE(trial(folder_ / "cache").outcome_of(folder_ / "copy.so").is_remembered);
}

TEST_F(CachedTrialOfAFile, AChangedFileIsTriedAnew) {
  (void)outcome();
  write("same size");
  EXPECT_FALSE(outcome().is_remembered);
  EXPECT_EQ(count_, 2);
}

TEST_F(CachedTrialOfAFile, ACrashIsRememberedAndTheMessageSaysSo) {
  fail_fatally();
  EXPECT_EQ(outcome().fault, "crashed");
  EXPECT_EQ(outcome().fault, "crashed (in an earlier trial; `cairn plugins check` tries again)");
  EXPECT_TRUE(outcome().is_fatal);
  EXPECT_EQ(count_, 1);
}

TEST_F(CachedTrialOfAFile, AFaultThatMayGoAwayByItselfIsNotRemembered) {
  outcome_ = {};
  outcome_.fault = "a library is missing";
  (void)outcome();
  EXPECT_FALSE(outcome().is_remembered);
  EXPECT_EQ(count_, 2);
}

TEST_F(CachedTrialOfAFile, AnotherTrialRenewsWhatIsRemembered) {
  fail_fatally();
  (void)outcome();
  outcome_ = {};
  EXPECT_EQ(trial(folder_ / "cache").try_again(file_).fault, "");
  EXPECT_EQ(outcome().fault, "");
  EXPECT_EQ(count_, 2);
  outcome_.fault = "a library is missing";
  (void)trial(folder_ / "cache").try_again(file_);
  EXPECT_FALSE(outcome().is_remembered);
}

TEST_F(CachedTrialOfAFile, ABrokenEntryCountsAsNotThere) {
  (void)outcome();
  for (const auto& entry : fs::directory_iterator(folder_ / "cache")) {
    fs::resize_file(entry.path(), fs::file_size(entry.path()) - 1);
    EXPECT_FALSE(outcome().is_remembered);
    std::fstream(entry.path(), std::ios::in | std::ios::out).seekp(30).put('#');
    EXPECT_FALSE(outcome().is_remembered);
  }
  EXPECT_TRUE(outcome().is_remembered);
}

TEST_F(CachedTrialOfAFile, WithoutAFolderThatCanBeWrittenEachTrialIsNew) {
  std::ofstream(folder_ / "plain file");
  for (const fs::path& cache : {fs::path(), folder_ / "plain file", folder_ / "plain file" / "below"}) {
    EXPECT_EQ(trial(cache).outcome_of(file_).fault, "");
    EXPECT_FALSE(trial(cache).outcome_of(file_).is_remembered) << cache;
  }
}

TEST_F(CachedTrialOfAFile, WhatIsNoPlainFileIsLeftToTheTrial) {
  EXPECT_FALSE(trial(folder_ / "cache").outcome_of(folder_ / "none.so").is_remembered);
  EXPECT_FALSE(trial(folder_ / "cache").outcome_of(folder_).is_remembered);
  EXPECT_EQ(count_, 2);
}

TEST_F(CachedTrialOfAFile, ManyThreadsMayAskAtOnce) {
  const CachedTrial shared = trial(folder_ / "cache");
  std::vector<TrialOutcome> outcomes(6);
  {
    std::vector<std::jthread> threads;
    for (TrialOutcome& outcome : outcomes) threads.emplace_back([&] { outcome = shared.outcome_of(file_); });
  }
  for (const TrialOutcome& outcome : outcomes) {
    EXPECT_EQ(outcome.fault, "");
    ASSERT_EQ(outcome.modules.size(), 1U);
    EXPECT_EQ(outcome.modules[0].name, "one");
  }
  EXPECT_GE(count_, 1);
  EXPECT_TRUE(outcome().is_remembered);
}

}  // namespace
}  // namespace cairn
