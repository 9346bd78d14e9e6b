// Links lead somewhere: from page to page, and from comments to the pages that they name.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kProject = CAIRN_SOURCE_DIR;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<fs::path> files_below(const fs::path& folder, const std::set<std::string>& extensions) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(kProject / folder)) {
    const bool is_corpus = entry.path().generic_string().find("/fuzz/corpus/") != std::string::npos;
    if (!is_corpus && extensions.contains(entry.path().extension())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> pages() {
  std::vector<fs::path> files = files_below("docs", {".md"});
  files.push_back(kProject / "README.md");
  files.push_back(kProject / "CHANGELOG.md");
  return files;
}

std::vector<std::vector<std::string>> matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::vector<std::string>> found;
  for (std::sregex_iterator at(text.begin(), text.end(), pattern); at != std::sregex_iterator(); ++at) {
    std::vector<std::string> groups;
    for (const auto& group : *at) groups.push_back(group);
    found.push_back(std::move(groups));
  }
  return found;
}

// What a heading is called in a link: lower case, without punctuation, a hyphen for each blank.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ') anchor += '-';
    if (std::isalnum(byte) != 0 || c == '-' || c == '_' || byte > 127) anchor += static_cast<char>(std::tolower(byte));
  }
  return anchor;
}

std::set<std::string> anchors_in(const fs::path& page) {
  static const std::regex heading("(?:^|\n)#+ ([^\n]+)");
  std::set<std::string> anchors;
  for (const auto& groups : matches(text_of(page), heading)) anchors.insert(anchor_of(groups[1]));
  return anchors;
}

TEST(Documents, EveryLinkBetweenPagesLeadsToAFileAndAHeading) {
  static const std::regex link(R"(\]\(([^)#: ]*)(?:#([^) ]+))?\))");
  for (const fs::path& page : pages())
    for (const auto& groups : matches(text_of(page), link)) {
      const fs::path target = groups[1].empty() ? page : page.parent_path() / groups[1];
      EXPECT_TRUE(fs::exists(target)) << page << " links to " << groups[1];
      if (!groups[2].empty()) {
        EXPECT_THAT(anchors_in(target), testing::Contains(groups[2])) << page << " links to " << groups[0];
      }
    }
}

TEST(Documents, EveryPageThatACommentNamesExists) {
  static const std::regex name(R"(docs/[A-Za-z0-9_/-]+\.md)");
  for (const char* room : {"maps", "framework", "plugins", "planners", "tests", "config", "cmake"})
    for (const fs::path& file : files_below(room, {".hpp", ".cpp", ".yaml", ".txt", ".cmake", ".py", ".sh"}))
      for (const auto& groups : matches(text_of(file), name))
        EXPECT_TRUE(fs::exists(kProject / groups[0])) << file << " names " << groups[0];
}

// "docs/method.md 2.1", "docs/method.md 10.2, 10.4", "docs/method.md 3 to 7".
TEST(Documents, EverySectionOfTheMethodThatACommentNamesExists) {
  static const std::regex reference(R"(docs/method\.md (\d+(?:\.\d+)?(?:(?:, | to )\d+(?:\.\d+)?)*))");
  static const std::regex number(R"(\d+(?:\.\d+)?)");
  static const std::regex heading(R"((?:^|\n)#+ (\d+(?:\.\d+)?)\.? )");
  std::set<std::string> sections;
  for (const auto& groups : matches(text_of(kProject / "docs/method.md"), heading)) sections.insert(groups[1]);
  int references = 0;
  for (const char* room : {"maps", "framework", "plugins", "planners", "tests"})
    for (const fs::path& file : files_below(room, {".hpp", ".cpp"}))
      for (const auto& groups : matches(text_of(file), reference))
        for (const auto& section : matches(groups[1], number)) {
          EXPECT_THAT(sections, testing::Contains(section[0])) << file << " names section " << section[0];
          ++references;
        }
  EXPECT_GT(references, 30);
}

// "`framework/safety/velocity_limiter.cpp` (`cut`, `is_stale`)" in a page.
TEST(Documents, SourcesThatPagesNameAreThereAndHoldTheNamedFunctions) {
  static const std::regex source(
      R"(`((?:maps|framework|plugins|planners)/[a-z0-9_/]+\.[ch]pp)`(?: \(((?:`\w+`(?:, )?)+)\))?)");
  static const std::regex name(R"(`(\w+)`)");
  for (const fs::path& page : pages())
    for (const auto& groups : matches(text_of(page), source)) {
      const fs::path file = kProject / groups[1];
      ASSERT_TRUE(fs::exists(file)) << page << " names " << groups[1];
      for (const auto& function : matches(groups[2], name))
        EXPECT_THAT(text_of(file), testing::HasSubstr(function[1] + "(")) << page << " names it in " << groups[1];
    }
}

}  // namespace
