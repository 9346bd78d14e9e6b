#include "framework/program/view/folder_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace cairn {
namespace {

namespace fs = std::filesystem;

class FolderMap : public testing::Test {
 protected:
  FolderMap() { fs::create_directories(folder_); }
  ~FolderMap() override { fs::remove_all(folder_); }
  void write(const std::string& name, const std::string& text = "") const { std::ofstream(folder_ / name) << text; }
  [[nodiscard]] std::string refusal() const {
    try {
      return map_in(folder_).string();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }
  const fs::path folder_ = fs::temp_directory_path() / ("cairn_folder_map_" + std::to_string(::getpid()));
};

TEST_F(FolderMap, IsTheOneThatTheReportNames) {
  write("office.cairn");
  write("earlier.cairn");
  write("report.json", R"({"map": "out/office.cairn"})");
  EXPECT_EQ(map_in(folder_), folder_ / "office.cairn");
}

TEST_F(FolderMap, IsTheOnlyOneWithoutAReportOrWhenItsMapHasGone) {
  write("kept.cairn");
  EXPECT_EQ(map_in(folder_), folder_ / "kept.cairn");
  write("report.json", R"({"map": "office.cairn"})");
  EXPECT_EQ(map_in(folder_), folder_ / "kept.cairn");
  write("report.json", "{");
  EXPECT_EQ(map_in(folder_), folder_ / "kept.cairn");
}

TEST_F(FolderMap, NoneAndSeveralAreRefused) {
  EXPECT_THAT(refusal(), testing::HasSubstr("holds no saved maps (*.cairn); name one"));
  write("a.cairn");
  write("b.cairn");
  EXPECT_THAT(refusal(), testing::HasSubstr("holds several saved maps (*.cairn); name one"));
}

}  // namespace
}  // namespace cairn
