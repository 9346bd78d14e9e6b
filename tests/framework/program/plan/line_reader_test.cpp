#include "framework/program/plan/line_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <thread>
#include <vector>

#include "framework/config/config_value.hpp"

namespace cairn {
namespace {

std::string file_with(const std::string& text) {
  const auto file = std::filesystem::path(testing::TempDir()) / ("cairn_lines_" + std::to_string(getpid()));
  std::ofstream(file, std::ios::binary) << text;
  return file.string();
}

std::vector<std::string> lines_of(const std::string& text) {
  LineReader reader(file_with(text));
  std::vector<std::string> lines;
  for (std::string line; reader.next(line);) {
    lines.push_back(line);
    EXPECT_EQ(reader.number(), static_cast<int>(lines.size()));
  }
  return lines;
}

TEST(LineReader, GivesEveryLineWithoutItsEnd) {
  using testing::ElementsAre;
  EXPECT_THAT(lines_of("a\n\nb c\n"), ElementsAre("a", "", "b c"));
  EXPECT_THAT(lines_of("a\nb"), ElementsAre("a", "b"));
  EXPECT_THAT(lines_of("\n"), ElementsAre(""));
  EXPECT_THAT(lines_of(""), ElementsAre());
}

TEST(LineReader, LinesMayCrossTheBlocksThatAreRead) {
  std::string text;
  std::vector<std::string> written;
  for (std::size_t i = 0; i < 400; ++i) {
    written.emplace_back(i * 37 % 1500, static_cast<char>('a' + i % 26));
    text += written.back() + "\n";
  }
  written.emplace_back(300'000, 'x');
  EXPECT_EQ(lines_of(text + written.back()), written);
}

TEST(LineReader, ALineWithoutEndIsRefusedWithItsNumber) {
  const std::string file = file_with("a\n" + std::string(3 * LineReader::kMaxBytes, 'x'));
  LineReader reader(file);
  std::string line;
  EXPECT_TRUE(reader.next(line));
  try {
    reader.next(line);
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.what(), file + ":2:1: a line of more than 1 MiB");
  }
}

TEST(LineReader, StoppingWakesWhoWaitsForALine) {
  const std::string pipe = file_with("") + ".pipe";
  std::filesystem::remove(pipe);
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::fstream writer(pipe, std::ios::in | std::ios::out);  // opens without waiting for a reader
  LineReader reader(pipe);
  writer << "first\nhalf" << std::flush;
  std::string line;
  EXPECT_TRUE(reader.next(line));
  EXPECT_EQ(line, "first");
  bool came = true;
  std::jthread waiting([&] { came = reader.next(line); });
  reader.stop();
  waiting.join();
  EXPECT_FALSE(came);
  EXPECT_FALSE(reader.next(line));
  std::filesystem::remove(pipe);
}

TEST(LineReader, FilesThatAreNoneAreRefused) {
  EXPECT_THROW(LineReader("no/such/file"), ConfigError);
  EXPECT_THROW(LineReader{testing::TempDir()}, ConfigError);
}

}  // namespace
}  // namespace cairn
