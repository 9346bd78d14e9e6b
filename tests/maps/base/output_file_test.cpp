#include "maps/base/output_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

namespace cairn {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

class OutputFile : public testing::Test {
 protected:
  OutputFile() { fs::create_directories(folder_); }
  ~OutputFile() override { fs::remove_all(folder_); }

  static std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_)) all.push_back(entry.path().filename().string());
    return all;
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / ("cairn_output_file_" + std::to_string(::getpid()));
  const fs::path file_ = folder_ / "a.json";
};

TEST_F(OutputFile, HoldsWhatWasWrittenLastAndNothingLiesBesideIt) {
  replace_file(file_, "a long text");
  replace_file(file_, std::string_view("b\0c", 3));
  EXPECT_EQ(text_of(file_), std::string("b\0c", 3));
  EXPECT_THAT(names(), testing::ElementsAre("a.json"));
}

TEST_F(OutputFile, ALinkAtTheTargetIsReplacedAndNotFollowed) {
  const fs::path victim = folder_ / "victim";
  std::ofstream(victim) << "precious";
  for (const fs::path& to : {victim, folder_ / "not_there"}) {
    fs::remove(file_);
    fs::create_symlink(to, file_);
    replace_file(file_, "text");
    EXPECT_FALSE(fs::is_symlink(file_));
    EXPECT_EQ(text_of(file_), "text");
  }
  EXPECT_EQ(text_of(victim), "precious");
  EXPECT_FALSE(fs::exists(folder_ / "not_there"));
}

TEST_F(OutputFile, AFollowedLinkStaysAndItsFileIsReplaced) {
  const fs::path real = folder_ / "real";
  std::ofstream(real) << "old";
  fs::create_symlink("real", file_);
  replace_file(file_, "new", {.links = Links::follow});
  EXPECT_TRUE(fs::is_symlink(file_));
  EXPECT_EQ(text_of(real), "new");
}

TEST_F(OutputFile, WhatIsPlantedBesideItIsTakenAwayAndNotFollowed) {
  const fs::path victim = folder_ / "victim";
  const fs::path beside = folder_ / ".a.json.saving";
  std::ofstream(victim) << "precious";
  fs::create_symlink(victim, beside);
  replace_file(file_, "one");
  EXPECT_EQ(text_of(file_), "one");
  fs::create_hard_link(victim, beside);
  replace_file(file_, "two");
  EXPECT_EQ(text_of(file_), "two");
  ASSERT_EQ(::mkfifo(beside.c_str(), 0600), 0);
  replace_file(file_, "three");
  EXPECT_EQ(text_of(file_), "three");
  EXPECT_EQ(text_of(victim), "precious");
  EXPECT_FALSE(fs::exists(beside));
}

TEST_F(OutputFile, WhatAKilledWriterHasLeftIsWrittenOver) {
  std::ofstream(folder_ / ".a.json.saving") << "half of a longer text";
  replace_file(file_, "whole");
  EXPECT_EQ(text_of(file_), "whole");
  EXPECT_THAT(names(), testing::ElementsAre("a.json"));
}

TEST_F(OutputFile, KeepsTheModeOfTheFileThatItReplaces) {
  replace_file(file_, "one");
  fs::permissions(file_, fs::perms(0600));
  replace_file(file_, "two");
  EXPECT_EQ(fs::status(file_).permissions(), fs::perms(0600));
}

TEST_F(OutputFile, ExchangedFilesHaveEachOthersContentAndTheModesOfTheirNames) {
  const fs::path other = folder_ / "b.json";
  write_file(file_, "a");
  write_file(other, "b");
  fs::permissions(file_, fs::perms(0640));
  ASSERT_TRUE(exchange_files(file_, other));
  EXPECT_EQ(text_of(file_), "b");
  EXPECT_EQ(text_of(other), "a");
  EXPECT_EQ(fs::status(file_).permissions(), fs::perms(0640));
  EXPECT_FALSE(exchange_files(file_, folder_ / "missing.json"));
  EXPECT_EQ(text_of(file_), "b");
}

TEST_F(OutputFile, WhatCannotBeWrittenIsNamedAndTheOldContentStays) {
  write_file(file_, "old");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{100, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  // Some bytes of it fit: the short write is no success.
  EXPECT_THAT([&] { write_file(file_, std::string(1000, 'x')); },
              ThrowsMessage<std::runtime_error>(HasSubstr("a.json: cannot be written: File too large")));
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(text_of(file_), "old");
  EXPECT_THAT(names(), testing::ElementsAre("a.json"));
  EXPECT_THAT([&] { write_file(folder_ / "no" / "a", "x"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no/a: cannot be written: No such file or directory")));
  EXPECT_THAT([&] { write_file(folder_, "x"); },
              ThrowsMessage<std::runtime_error>(HasSubstr(": cannot be written: Is a directory")));
}

TEST_F(OutputFile, AFullDeviceIsAnErrorAndStaysADevice) {
  EXPECT_THAT([] { write_file("/dev/full", "x"); },
              ThrowsMessage<std::runtime_error>("/dev/full: cannot be written: No space left on device"));
  EXPECT_NO_THROW(write_file("/dev/null", "x"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(OutputFile, APipeThatNobodyReadsIsAnErrorAndNoWait) {
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  EXPECT_THROW(write_file(file_, "x"), std::runtime_error);
  EXPECT_TRUE(fs::is_fifo(file_));
}

TEST_F(OutputFile, WritersOfOneFileTakeTurns) {
  std::vector<std::thread> writers;
  for (int i = 0; i < 8; ++i)
    writers.emplace_back([this, i] {
      for (int n = 0; n < 500; ++n)
        replace_file(file_, std::string(10'000, static_cast<char>('a' + i)), {.sync = false});
    });
  for (std::thread& writer : writers) writer.join();
  const std::string text = text_of(file_);
  EXPECT_EQ(text, std::string(10'000, text.at(0)));
  EXPECT_THAT(names(), testing::ElementsAre("a.json"));
}

TEST_F(OutputFile, TextIsAddedToAPlainFileOnly) {
  append_to_file(file_, "a");
  append_to_file(file_, "b");
  EXPECT_EQ(text_of(file_), "ab");
  fs::create_symlink(file_, folder_ / "link");
  EXPECT_THROW(append_to_file(folder_ / "link", "c"), OutputError);
  fs::create_hard_link(file_, folder_ / "other");
  EXPECT_THROW(append_to_file(file_, "c"), OutputError);
  EXPECT_EQ(text_of(file_), "ab");
}

TEST_F(OutputFile, AGrowingFileIsInPlaceAtOnceAndFollowsNoLink) {
  const fs::path victim = folder_ / "victim";
  std::ofstream(victim) << "precious";
  fs::create_symlink(victim, file_);
  GrowingFile growing(file_);
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(file_)));
  growing.append(std::string(100'000, 'x'));
  EXPECT_EQ(fs::file_size(file_), 100'000U);
  growing.append("y");
  growing.close();
  EXPECT_EQ(fs::file_size(file_), 100'001U);
  EXPECT_EQ(text_of(victim), "precious");
  EXPECT_THROW(growing.append(std::string(100'000, 'x')), OutputError) << "it is closed";
}

}  // namespace
}  // namespace cairn
