#include "framework/program/common/output_files.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <thread>

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

TEST_F(OutputFiles, AUsualNameTakesThePlaceOfNoOtherFile) {
  make_folder(folder_);
  const std::string usual = (folder_ / "map.png").string();
  EXPECT_EQ(file_to_write("", usual), usual);
  write_file(usual, "a picture");
  EXPECT_THAT([&] { (void)file_to_write("", usual); },
              ThrowsMessage<std::runtime_error>(HasSubstr("map.png exists already; name a file by -o FILE")));
  EXPECT_EQ(file_to_write(usual, "other.png"), usual) << "it was asked for";
}

TEST_F(OutputFiles, AFolderIsHeldByOneRunOnly) {
  make_folder(folder_);
  hold_folder(folder_);
  EXPECT_THAT([&] { hold_folder(folder_, std::chrono::milliseconds(100)); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("another run (process " + std::to_string(::getpid()) + ": "),
                        HasSubstr("framework_program_test"), HasSubstr(") is writing into this folder"))));
  EXPECT_TRUE(is_folder_held(folder_));
  EXPECT_EQ(fs::status(folder_ / kFolderLock).permissions(), fs::perms(0600));
}

TEST_F(OutputFiles, AHolderThatGoesInTimeIsWaitedFor) {
  make_folder(folder_);
  EXPECT_FALSE(is_folder_held(folder_)) << "no run was here";
  const int held = ::open((folder_ / kFolderLock).c_str(), O_RDWR | O_CREAT, 0600);
  EXPECT_FALSE(is_folder_held(folder_)) << "a run has left its lock";
  ASSERT_EQ(::flock(held, LOCK_EX), 0);
  EXPECT_THAT([&] { hold_folder(folder_, std::chrono::milliseconds(50)); },
              ThrowsMessage<std::runtime_error>(HasSubstr("another run is writing into this folder")))
      << "it has not said who it is";
  std::thread holder([held] { ::close(held); });
  EXPECT_NO_THROW(hold_folder(folder_, std::chrono::seconds(60)));
  holder.join();
}

TEST_F(OutputFiles, ALinkOrAPipeInPlaceOfTheLockIsAnError) {
  make_folder(folder_);
  write_file(folder_ / "victim", "precious");
  const fs::path lock = folder_ / kFolderLock;
  fs::create_symlink("victim", lock);
  EXPECT_THAT([&] { hold_folder(folder_); },
              ThrowsMessage<std::runtime_error>(HasSubstr("is a symbolic link, which is not followed; remove it")));
  fs::remove(lock);
  fs::create_hard_link(folder_ / "victim", lock);
  EXPECT_THROW(hold_folder(folder_), std::runtime_error);
  fs::remove(lock);
  ASSERT_EQ(::mkfifo(lock.c_str(), 0600), 0);
  EXPECT_THROW(hold_folder(folder_), std::runtime_error);
  EXPECT_EQ(text_of(folder_ / "victim"), "precious");
}

}  // namespace
}  // namespace cairn
