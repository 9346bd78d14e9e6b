#include "plugins/common/logs/log_text.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>

#include "plugins/common/logs/log_line.hpp"
#include "tests/plugins/log_files.hpp"

namespace cairn::log_common {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Lines with their numbers, and errors in their place.
std::vector<std::string> lines_of(const log_files::LogFolder& folder, const std::filesystem::path& file) {
  LogText text(file);
  std::vector<std::string> lines;
  std::string_view line;
  while (true) {
    try {
      if (!text.next(line)) return lines;
      lines.push_back(std::to_string(text.line_number()) + "|" + std::string(line));
    } catch (const ConfigError& error) {
      lines.push_back(folder.without_folder(error.what()));
    }
  }
}

TEST(LogText, GivesTheLinesOfPlainAndGzipFilesAlike) {
  const log_files::LogFolder folder;
  const std::string text =
      "\xEF\xBB\xBF"
      "first\r\n\nthird\nlast, without an end";
  const auto expected = ElementsAre("1|first", "2|", "3|third", "4|last, without an end");
  EXPECT_THAT(lines_of(folder, folder.write("a.log", text)), expected);
  EXPECT_THAT(lines_of(folder, folder.write("a.log.gz", folder.gzip(text))), expected);
  EXPECT_THAT(lines_of(folder, folder.write("wrong_name.log", folder.gzip(text))), expected);
}

TEST(LogText, GoesOnThroughSeveralGzipMembers) {
  const log_files::LogFolder folder;
  EXPECT_THAT(lines_of(folder, folder.write("a.gz", folder.gzip("one\nt") + folder.gzip("wo\n"))),
              ElementsAre("1|one", "2|two"));
}

// 64 MiB of zeros in some 65 KB: one line without end.
TEST(LogText, ReadingABombEndsWithItsBudget) {
  const log_files::LogFolder folder;
  const std::filesystem::path bomb = folder.write("bomb.gz", folder.gzip(std::string(std::size_t{64} << 20U, '\0')));
  std::atomic<bool> cancel = true;
  EXPECT_THROW(LogText(bomb, {.cancel = &cancel}), ReadingEnded);
  std::string damage;
  EXPECT_THROW((void)text_of_file(bomb, {.cancel = &cancel}, damage), ReadingEnded);
  cancel = false;
  LogText text(bomb, {.cancel = &cancel});
  cancel = true;
  std::string_view line;
  EXPECT_THAT([&] { text.next(line); },
              ::testing::ThrowsMessage<ReadingEnded>(HasSubstr("bomb.gz:1:1: reading this log was cancelled")));
  const Budget late{.deadline = Budget::Clock::now() - std::chrono::seconds(1)};
  EXPECT_THAT([&] { (void)text_of_file(bomb, late, damage); },
              ::testing::ThrowsMessage<ReadingEnded>(HasSubstr("reading this log took too long")));
}

TEST(LogText, AnEmptyFileHasNoLines) {
  const log_files::LogFolder folder;
  EXPECT_THAT(lines_of(folder, folder.write("a.log", "")), ElementsAre());
}

TEST(LogText, ACutOffGzipFileSaysSoAndDropsTheHalfLine) {
  const log_files::LogFolder folder;
  std::string text;
  for (int i = 0; i < 20000; ++i) text += "line " + std::to_string(i * 7919 % 20000) + "\n";
  const std::string packed = folder.gzip(text);
  const auto lines = lines_of(folder, folder.write("a.gz", packed.substr(0, packed.size() / 2)));
  ASSERT_GT(lines.size(), 100U);
  EXPECT_LT(lines.size(), 20000U);
  EXPECT_EQ(lines.back(), "a.gz:" + std::to_string(lines.size()) + ":1: the compressed log is cut off here");
  EXPECT_EQ(lines[41], "42|line " + std::to_string(41 * 7919 % 20000));
  // Only the check sum at the end is missing.
  EXPECT_THAT(lines_of(folder, folder.write("b.gz", folder.gzip("x\n").substr(0, folder.gzip("x\n").size() - 4))),
              ElementsAre("1|x", "b.gz:2:1: the compressed log is cut off here"));
}

TEST(LogText, DamagedGzipDataSaysSo) {
  const log_files::LogFolder folder;
  std::string packed = folder.gzip(std::string(100000, 'x') + "\nend\n");
  for (std::size_t i = packed.size() / 2; i < packed.size(); ++i) packed[i] = static_cast<char>(~packed[i]);
  EXPECT_THAT(lines_of(folder, folder.write("a.gz", packed)).back(), HasSubstr("the compressed log is damaged here"));
}

TEST(LogText, ALineOfTenMegabytesIsRefusedAndTheNextOneRead) {
  const log_files::LogFolder folder;
  const std::string text = "before\n" + std::string(10U << 20U, '7') + "\nafter\n";
  for (const std::string& bytes : {text, folder.gzip(text)})
    EXPECT_THAT(lines_of(folder, folder.write("a.log", bytes)),
                ElementsAre("1|before", "a.log:2:1: the line is longer than 1048576 characters", "3|after"));
}

TEST(LogText, AFolderOrAMissingFileCannotBeRead) {
  const log_files::LogFolder folder;
  EXPECT_THROW(LogText("/"), ConfigError);
  EXPECT_THROW(LogText("/no/such/file"), ConfigError);
}

TEST(LogLine, KnowsWhereItsWordsStand) {
  LogLine line("a.log");
  line.cut("  ODOM\t1.5 -x", 7);
  ASSERT_EQ(line.size(), 3U);
  EXPECT_EQ(line.word(1), "1.5");
  EXPECT_EQ(line.place(2).text(), "a.log:7:12");
  EXPECT_EQ(line.place(3).text(), "a.log:7:14");
  EXPECT_EQ(line.number(1, "x"), 1.5);
}

std::string fault_of(const std::string& text, double (LogLine::*read)(std::size_t, std::string_view) const) {
  LogLine line("a.log");
  line.cut(text, 1);
  try {
    return "read " + std::to_string((line.*read)(1, "x"));
  } catch (const ConfigError& error) {
    return error.what();
  }
}

TEST(LogLine, RefusesWhatIsNoNumberOrNoPlace) {
  EXPECT_EQ(fault_of("A +2", &LogLine::number), "read 2.000000");
  EXPECT_EQ(fault_of("A", &LogLine::number), "a.log:1:2: the line ends where the x must be");
  EXPECT_EQ(fault_of("A 1,5", &LogLine::number), "a.log:1:3: the x must be a number, not \"1,5\"");
  EXPECT_EQ(fault_of("A 1e999", &LogLine::number), "a.log:1:3: the x must be a number, not \"1e999\"");
  EXPECT_EQ(fault_of("A nan", &LogLine::finite), "a.log:1:3: the x must be finite, not \"nan\"");
  EXPECT_EQ(fault_of("A 1e300", &LogLine::metres), "a.log:1:3: the x is beyond 100 km: \"1e300\"");
}

TEST(LogLine, ACountIsAWholeNumber) {
  LogLine line("a.log");
  line.cut("3 -1 2.5 1e7 nan", 1);
  EXPECT_EQ(line.count(0, "count"), 3U);
  for (std::size_t i = 1; i < line.size(); ++i) EXPECT_THROW((void)line.count(i, "count"), ConfigError) << line.word(i);
}

}  // namespace
}  // namespace cairn::log_common
