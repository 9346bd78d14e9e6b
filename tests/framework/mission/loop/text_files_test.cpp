#include "framework/mission/loop/text_files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "maps/base/spelling.hpp"

namespace cairn {
namespace {

class TextFilesTest : public testing::Test {
 protected:
  TextFilesTest() { std::filesystem::create_directories(folder_); }
  ~TextFilesTest() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string text_of(const std::string& name) const {
    std::ifstream in(folder_ / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("cairn_texts_" + std::to_string(getpid()));
};

TEST_F(TextFilesTest, AddsToWhatTheSameMissionHasWrittenAndToNothingElse) {
  std::ofstream(folder_ / "answers.json") << "old\n";
  TextFiles texts(folder_, false);
  EXPECT_EQ(texts.write({"answers.json", "one\n", true}).reason, "wrote answers.json");
  EXPECT_EQ(texts.write({"answers.json", "two\n", true}).state, StepState::success);
  EXPECT_EQ(text_of("answers.json"), "one\ntwo\n");
  EXPECT_EQ(texts.write({"answers.json", "new\n", false}).state, StepState::success);
  EXPECT_EQ(text_of("answers.json"), "new\n");
}

TEST_F(TextFilesTest, AMissionThatGoesOnAddsToItsEarlierTexts) {
  std::ofstream(folder_ / "answers.json") << "old\n";
  TextFiles texts(folder_, true);
  EXPECT_EQ(texts.write({"answers.json", "new\n", true}).state, StepState::success);
  EXPECT_EQ(text_of("answers.json"), "old\nnew\n");
}

TEST_F(TextFilesTest, OnlyPlainNamesAreWritten) {
  TextFiles texts(folder_, false);
  for (const char* name : {"", ".", "..", "a/b", "a\\b", "a\nb"}) {
    const Status status = texts.write({name, "text", false});
    EXPECT_EQ(status.state, StepState::failure) << name;
    EXPECT_EQ(status.reason, in_quotes(name) + " is not a plain file name");
  }
}

TEST_F(TextFilesTest, AFileThatCannotBeWrittenIsAFailure) {
  std::filesystem::create_directories(folder_ / "taken");
  TextFiles texts(folder_, false);
  EXPECT_EQ(texts.write({"taken", "text", false}).reason,
            "taken could not be written: cannot be written: Is a directory");
}

}  // namespace
}  // namespace cairn
