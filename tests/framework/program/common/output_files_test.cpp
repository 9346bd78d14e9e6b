#include "framework/program/common/output_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

namespace cairn {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

class OutputFiles : public testing::Test {
 protected:
  OutputFiles() { fs::remove_all(folder_); }
  ~OutputFiles() override { fs::remove_all(folder_); }

  const fs::path folder_ = fs::path(testing::TempDir()) / ("cairn_output_" + std::to_string(::getpid()));
};

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(OutputFiles, AFolderIsMadeWithThoseAboveIt) {
  make_folder(folder_ / "a" / "b");
  EXPECT_TRUE(fs::is_directory(folder_ / "a" / "b"));
  EXPECT_NO_THROW(make_folder(folder_ / "a" / "b")) << "it is there already";
}

TEST_F(OutputFiles, AFolderWhereAFileIsCannotBeMade) {
  make_folder(folder_);
  write_file(folder_ / "a", "text");
  EXPECT_THAT([&] { make_folder(folder_ / "a" / "b"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("a/b: the output folder cannot be made: ")));
}

TEST_F(OutputFiles, AFileHoldsWhatWasWrittenLast) {
  make_folder(folder_);
  write_file(folder_ / "a", "a long text");
  write_file(folder_ / "a", std::string("b\0c", 3));
  EXPECT_EQ(text_of(folder_ / "a"), std::string("b\0c", 3));
}

TEST_F(OutputFiles, AFileThatCannotBeWrittenIsNamedWithTheReason) {
  EXPECT_THAT([&] { write_file(folder_ / "a", "text"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("a: cannot be written: No such file or directory")));
}

TEST_F(OutputFiles, AFolderIsHeldByOneRunOnly) {
  make_folder(folder_);
  hold_folder(folder_);
  EXPECT_THAT([&] { hold_folder(folder_); },
              ThrowsMessage<std::runtime_error>(HasSubstr("another run is writing into this folder")));
}

}  // namespace
}  // namespace cairn
