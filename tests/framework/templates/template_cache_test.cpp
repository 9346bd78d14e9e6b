#include "framework/templates/template_cache.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

namespace cairn {
namespace {

namespace fs = std::filesystem;
using testing::StartsWith;

const std::string kKey = "square\nof this robot";

std::vector<LandmarkTemplate> two_templates() {
  return {{"square", 0.0, {{{-1, 2}, 300, -1020}, {{3, 4}, 0, 7}}}, {"square", 0.25, {{{0, 0}, -5, 5}}}};
}

class TemplateCacheTest : public testing::Test {
 protected:
  TemplateCacheTest() { fs::remove_all(folder_); }
  ~TemplateCacheTest() override { fs::remove_all(folder_); }
  [[nodiscard]] fs::path only_file() const { return fs::directory_iterator(folder_)->path(); }

  const fs::path folder_ = fs::path(testing::TempDir()) / ("cairn_template_cache_" + std::to_string(::getpid()));
  const TemplateCache cache_{folder_};
};

TEST_F(TemplateCacheTest, GivesBackWhatItHasKept) {
  cache_.keep(kKey, two_templates());
  const auto found = cache_.find(kKey);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->size(), 2U);
  for (std::size_t i = 0; i < found->size(); ++i) {
    EXPECT_EQ((*found)[i].category, "square");
    EXPECT_EQ((*found)[i].orientation_rad, two_templates()[i].orientation_rad);
    EXPECT_EQ((*found)[i].cells, two_templates()[i].cells);
  }
}

TEST_F(TemplateCacheTest, LeavesOneFileAKeyAndNoHalfWrittenOnes) {
  cache_.keep(kKey, two_templates());
  cache_.keep(kKey, two_templates());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
  EXPECT_EQ(only_file().extension(), ".templates");
}

TEST_F(TemplateCacheTest, FindsNothingUnderAKeyOfTheSameFileThatIsNotTheSame) {
  cache_.keep(kKey, two_templates());
  const std::string other = "square\nof another robot";
  EXPECT_FALSE(cache_.find(other));
  const fs::path kept = only_file();
  cache_.keep(other, two_templates());
  for (const auto& entry : fs::directory_iterator(folder_))
    if (entry.path() != kept) fs::copy_file(kept, entry.path(), fs::copy_options::overwrite_existing);
  EXPECT_TRUE(cache_.find(kKey));
  EXPECT_FALSE(cache_.find(other)) << "the file holds another key";
}

TEST_F(TemplateCacheTest, ABrokenFileCountsAsNotThere) {
  cache_.keep(kKey, two_templates());
  const fs::path file = only_file();
  const auto size = fs::file_size(file);
  std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(30).put('\x7f');
  EXPECT_FALSE(cache_.find(kKey)) << "a byte changed";
  for (const auto left : {size - 1, size / 2, std::uintmax_t{3}, std::uintmax_t{0}}) {
    cache_.keep(kKey, two_templates());
    ASSERT_TRUE(cache_.find(kKey));
    fs::resize_file(file, left);
    EXPECT_FALSE(cache_.find(kKey)) << "cut to " << left << " bytes";
  }
}

TEST_F(TemplateCacheTest, WithoutAFolderItKeepsNothing) {
  const TemplateCache none;
  none.keep(kKey, two_templates());
  EXPECT_FALSE(none.find(kKey));
}

TEST_F(TemplateCacheTest, AFolderThatCannotBeMadeCostsNothingButTheCache) {
  std::ofstream(folder_) << "a file where the folder should be";
  cache_.keep(kKey, two_templates());
  EXPECT_FALSE(cache_.find(kKey));
}

// Sets variables of the environment and takes them back.
class Variables {
 public:
  explicit Variables(const std::vector<std::pair<std::string, std::string>>& values) {
    for (const auto& [name, value] : values) {
      const char* before = std::getenv(name.c_str());
      before_.emplace_back(name, before == nullptr ? std::nullopt : std::optional<std::string>(before));
      ::setenv(name.c_str(), value.c_str(), 1);
    }
  }
  Variables(const Variables&) = delete;
  Variables& operator=(const Variables&) = delete;
  ~Variables() {
    for (const auto& [name, value] : before_) {
      if (value)
        ::setenv(name.c_str(), value->c_str(), 1);
      else
        ::unsetenv(name.c_str());
    }
  }

 private:
  std::vector<std::pair<std::string, std::optional<std::string>>> before_;
};

fs::path folder_with(const std::string& chosen, const std::string& cache, const std::string& home) {
  const Variables variables({{"CAIRN_TEMPLATE_CACHE", chosen}, {"XDG_CACHE_HOME", cache}, {"HOME", home}});
  return template_cache_folder();
}

TEST(TemplateCacheFolder, IsTheOneThatIsChosenElseTheUsersCache) {
  EXPECT_EQ(folder_with("/somewhere", "/cache", "/home/ann"), "/somewhere");
  EXPECT_EQ(folder_with("off", "/cache", "/home/ann"), "");
  EXPECT_EQ(folder_with("", "/cache", "/home/ann"), "/cache/cairn/templates");
  EXPECT_EQ(folder_with("", "", "/home/ann"), "/home/ann/.cache/cairn/templates");
}

TEST(TemplateCacheFolder, IsNeverARelativeOne) {
  EXPECT_EQ(folder_with("", "cache", "/home/ann"), "/home/ann/.cache/cairn/templates");
  EXPECT_EQ(folder_with("", "cache", "home"), "");
}

TEST(ShapeKey, BeginsWithTheCategoryAndDependsOnOutlineAndRendering) {
  const LandmarkShape circle{"pillar", Contour::circle(0.3)};
  const std::string key = shape_key("robot", circle);
  EXPECT_THAT(key, StartsWith("pillar\n"));
  EXPECT_EQ(shape_key("robot", circle), key);
  EXPECT_NE(shape_key("another robot", circle), key);
  EXPECT_NE(shape_key("robot", {"pillar", Contour::circle(0.4)}), key);
  EXPECT_NE(shape_key("robot", {"post", Contour::circle(0.3)}), key);
}

}  // namespace
}  // namespace cairn
