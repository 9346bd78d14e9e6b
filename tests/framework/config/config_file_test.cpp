#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <clocale>
#include <random>

#include "framework/config/config_value.hpp"
#include "maps/base/deflate.hpp"
#include "tests/framework/config/config_test_support.hpp"

namespace cairn {
namespace {

using config_test::error_of;
using config_test::TestFolder;
using Kind = ConfigValue::Kind;

std::string parse_error(const std::string& text) {
  return error_of([&] { (void)parse_config_text(text, "m.yaml"); });
}

std::string repeated(const std::string& text, int times) {
  std::string out;
  for (int i = 0; i < times; ++i) out += text;
  return out;
}

TEST(ConfigFile, KeepsKindsValuesAndPlaces) {
  const ConfigValue root = parse_config_text("a: 1\nb: [x, 'y']\nc:\n  d: ~\ne:\n", "m.yaml");
  ASSERT_EQ(root.kind, Kind::map);
  EXPECT_EQ(root.place.text(), "m.yaml:1:1");
  ASSERT_EQ(root.entries.size(), 4U);
  EXPECT_EQ(root.find("a")->scalar, "1");
  EXPECT_EQ(root.find("a")->place.text(), "m.yaml:1:4");
  const ConfigValue& b = *root.find("b");
  ASSERT_EQ(b.kind, Kind::list);
  EXPECT_EQ(b.place.text(), "m.yaml:2:4");
  EXPECT_FALSE(b.items[0].quoted);
  EXPECT_TRUE(b.items[1].quoted);
  EXPECT_EQ(b.items[1].place.text(), "m.yaml:2:8");
  EXPECT_EQ(root.entries[2].key_place.text(), "m.yaml:3:1");
  EXPECT_EQ(root.find("c")->find("d")->kind, Kind::null);
  EXPECT_EQ(root.find("e")->kind, Kind::null);
  EXPECT_EQ(root.find("e")->place.text(), "m.yaml:5:1") << "an absent value stands at its key";
  EXPECT_EQ(root.find("f"), nullptr);
}

TEST(ConfigFile, AnEmptyFileIsAnEmptyMap) {
  for (const char* text : {"", "\n\n", "# a comment only\n", "---\n", "~\n"}) {
    const ConfigValue root = parse_config_text(text, "m.yaml");
    EXPECT_EQ(root.kind, Kind::map) << text;
    EXPECT_TRUE(root.entries.empty()) << text;
    EXPECT_EQ(root.place.text(), "m.yaml:1:1") << text;
  }
}

TEST(ConfigFile, AListOrAScalarAloneKeepsItsKind) {
  EXPECT_EQ(parse_config_text("[1, 2]", "m.yaml").kind, Kind::list);
  EXPECT_EQ(parse_config_text("word", "m.yaml").kind, Kind::scalar);
}

TEST(ConfigFile, BlockScalarsAndStringTagsAreText) {
  const ConfigValue root = parse_config_text("a: |\n  5\nb: !!str 5\nc: >-\n  6\n", "m.yaml");
  for (const ConfigValue::Entry& entry : root.entries) EXPECT_TRUE(entry.value.quoted) << entry.key;
}

TEST(ConfigFile, AliasesAreCopies) {
  const ConfigValue root = parse_config_text("a: &x {b: [1, 2]}\nc: *x\n", "m.yaml");
  EXPECT_EQ(root.find("c")->find("b")->items[1].scalar, "2");
  EXPECT_EQ(root.find("c")->place.text(), "m.yaml:1:4") << "a bad value is where it is written";
}

TEST(ConfigFile, ABrokenTextOfWhichTheParserFindsDocumentsWithoutEndIsRefused) {
  const std::string text = "!!str 2\n? key\n\"\"\"\"\"\"\"=\"\"\"\"\"\"{\"\"t: ~\nh: !!str 2\n? key\n: Value\n--- ";
  EXPECT_THROW(parse_config_text(text, "m.yaml"), ConfigError);
}

// yaml-cpp takes the end of the text for the end of a quote.
TEST(ConfigFile, AQuoteThatIsNeverClosedIsReportedWhereItIsOpened) {
  const std::string sentence = ": the quote that is opened here is never closed";
  EXPECT_EQ(parse_error("steps:\n  - log: \"abc\n  - goto: home\n  - save: a.cairn\n"), "m.yaml:2:10" + sentence);
  EXPECT_EQ(parse_error("mission: 'office\nsteps: []\n"), "m.yaml:1:10" + sentence);
  EXPECT_EQ(parse_error("a: 1\nb: \"x"), "m.yaml:2:4" + sentence);
  EXPECT_EQ(parse_error("a: \"two\n  lines\"\nb: it's\nc: [1, 'x]\nd: 3\n"), "m.yaml:4:8" + sentence);
  EXPECT_EQ(parse_config_text("a: \"two\n  lines\"\nb: it's 5\" wide # don't\nc: 'it''s'\n", "m.yaml").entries.size(),
            3U);
  EXPECT_EQ(parse_config_text("a: |\n  \"open\nb: 1\n", "m.yaml").entries.size(), 2U);
}

TEST(ConfigFile, APipeIsNotWaitedFor) {
  const std::filesystem::path pipe =
      std::filesystem::path(testing::TempDir()) / ("cairn_pipe_" + std::to_string(::getpid()) + ".yaml");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  try {
    (void)read_config_file(pipe);
    ADD_FAILURE() << "read";
  } catch (const ConfigError& error) {
    EXPECT_EQ(std::string(error.what()), pipe.string() + ": no file: a pipe, a socket or a device");
  }
  std::filesystem::remove(pipe);
}

TEST(ConfigFile, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(parse_error("a: 1\nb: 2\na: 3\n"), "m.yaml:3:1: the key \"a\" stands here twice; first at line 1");
  EXPECT_EQ(parse_error("a: {b: 1,\n  b: 2}\n"), "m.yaml:2:3: the key \"b\" stands here twice; first at line 1");
  EXPECT_EQ(parse_error("a: [1, 2\n"), "m.yaml:2:1: not valid YAML: end of sequence flow not found");
  EXPECT_EQ(parse_error("a:\n\t- 1\n"), "m.yaml:2:2: not valid YAML: illegal block entry");
  EXPECT_EQ(parse_error("a: b: c\n"), "m.yaml:1:5: not valid YAML: illegal map value");
  EXPECT_EQ(parse_error("a: *nothing\n"), "m.yaml:1:4: not valid YAML: the referenced anchor is not defined");
  EXPECT_EQ(parse_error("a: &x [1, *x]\n"),
            "m.yaml:1:11: an alias stands within its own anchor; a value cannot hold itself");
  EXPECT_EQ(parse_error("a: 1\n---\nb: 2\n"), "m.yaml:2:1: a second YAML document begins here; a file holds one");
  EXPECT_EQ(parse_error("b: &b {c: 1}\na:\n  <<: *b\n"),
            "m.yaml:3:3: YAML merge keys (\"<<\") are not supported; write the keys out");
  EXPECT_EQ(parse_error("? [1, 2]\n: 3\n"), "m.yaml:1:3: a key must be text, found a list; is a bracket left open?");
  EXPECT_EQ(parse_error("~: 3\n"), "m.yaml:1:1: a key must be text, found nothing");
  EXPECT_EQ(parse_error("a: !!float 1\n"), "m.yaml:1:4: the YAML tag \"tag:yaml.org,2002:float\" is not supported");
  EXPECT_EQ(parse_error("a: !mine {}\n"), "m.yaml:1:4: the YAML tag \"!mine\" is not supported");
}

TEST(ConfigFile, RefusesWhatIsNotText) {
  EXPECT_EQ(parse_error("a: 1\nb: \x04 c\n"), "m.yaml:2:4: a control character \"\\x04\"; a file holds text only");
  EXPECT_EQ(parse_error("a: \xC2\x9B"), "m.yaml:1:4: a control character \"\\u009b\"; a file holds text only");
  EXPECT_EQ(parse_error("a: \xE2\x80\xAE"), "m.yaml:1:4: a control character \"\\u202e\"; a file holds text only");
  EXPECT_EQ(parse_error("a:\n  b: \"x\\e[2J\"\n"),
            "m.yaml:2:6: the text \"x\\x1b[2J\" holds the control character \\x1b")
      << "written as an escape";
  EXPECT_EQ(parse_error("\"\\u202E\": 1\n"), "m.yaml:1:1: the text \"\\u202e\" holds the control character \\u202e");
  EXPECT_EQ(parse_error(std::string("a\0b", 3)), "m.yaml:1:2: a control character \"\\x00\"; a file holds text only");
  EXPECT_EQ(parse_error("\xff\xfe"
                        "a"),
            "m.yaml:1:1: not UTF-8 text");
  EXPECT_EQ(parse_error("a: caf\xc3"), "m.yaml:1:7: not UTF-8 text");
  EXPECT_EQ(parse_error("a: \xed\xa0\x80"), "m.yaml:1:4: not UTF-8 text") << "a surrogate";
  EXPECT_EQ(parse_error("a: \xc0\x80"), "m.yaml:1:4: not UTF-8 text") << "an overlong zero";
  EXPECT_EQ(parse_config_text("\xef\xbb\xbf"
                              "a: caf\xc3\xa9\r\nb: 2\r\n",
                              "m.yaml")
                .find("a")
                ->scalar,
            "caf\xc3\xa9");
}

TEST(ConfigFile, HoldsSixtyFourLevelsAndNoMore) {
  EXPECT_EQ(parse_error(repeated("[", 64) + repeated("]", 64)), "no ConfigError");
  EXPECT_EQ(parse_error(repeated("[", 65) + repeated("]", 65)), "m.yaml:1:65: nested deeper than 64 levels");
  EXPECT_EQ(parse_error(repeated("- ", 65) + "1"), "m.yaml:1:129: nested deeper than 64 levels");
  EXPECT_EQ(parse_error("a: &x " + repeated("[", 40) + repeated("]", 40) + "\nb: " + repeated("[", 30) + "*x" +
                        repeated("]", 30)),
            "m.yaml:2:34: nested deeper than 64 levels");
}

TEST(ConfigFile, AbsurdDepthCostsNothing) {
  for (const char* open : {"[", "{", "{a: [", "- ", "? ", "- [", "&a [", "a: ", "!!str ", "[[[[[]"}) {
    EXPECT_NE(parse_error(repeated(open, 100'000)), "no ConfigError") << open;
  }
  std::string stairs;
  for (int i = 0; i < 2000; ++i) stairs += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  EXPECT_EQ(parse_error(stairs), "m.yaml:65:65: nested deeper than 64 levels");
}

TEST(ConfigFile, AliasesCannotMultiplyWithoutEnd) {
  std::string text = "k0: &a0 [1, 1]\n";
  for (int i = 1; i < 40; ++i) {
    const std::string last = std::to_string(i - 1);
    text += "k" + std::to_string(i) + ": &a" + std::to_string(i) + " [*a" + last + ", *a" + last + "]\n";
  }
  EXPECT_NE(parse_error(text).find("more than 1000000 values in one file"), std::string::npos) << parse_error(text);
}

TEST(ConfigFile, ReadsFilesAndNamesThemInPlaces) {
  const TestFolder folder;
  const auto file = folder.write("robot.yaml", "a: 1\n");
  EXPECT_EQ(read_config_file(file).find("a")->place.text(), file.string() + ":1:4");
}

TEST(ConfigFile, SaysWhyAFileCannotBeRead) {
  const TestFolder folder;
  (void)folder.write("office.yaml", "a: 1\n");
  const auto reading = [&](const std::string& name) {
    return folder.without_folder(error_of([&] { (void)read_config_file(folder.path() / name); }));
  };
  EXPECT_EQ(reading("ofice.yaml"), "ofice.yaml: no such file (did you mean \"office.yaml\"?)");
  EXPECT_EQ(reading("somewhere/else.yaml"), "somewhere/else.yaml: no such file");
  std::filesystem::create_directories(folder.path() / "inner");
  EXPECT_EQ(reading("inner"), "inner: a folder, not a file");
  (void)folder.write("huge.yaml", std::string((16U << 20U) + 1, ' '));
  EXPECT_EQ(reading("huge.yaml"), "huge.yaml: larger than 16 MiB");
}

TEST(ConfigFile, ReadsWhatGzipHasPacked) {
  const TestFolder folder;
  const std::string packed = gzip_member("a: 1\nb: [2, x]\n");
  const auto file = folder.write("robot.yaml.gz", packed);
  EXPECT_EQ(read_config_file(file).find("b")->place.text(), file.string() + ":2:4");
  const auto reading = [&](const std::string& name, const std::string& text) {
    (void)folder.write(name, text);
    return folder.without_folder(error_of([&] { (void)read_config_file(folder.path() / name); }));
  };
  EXPECT_EQ(reading("cut.gz", packed.substr(0, packed.size() - 12)), "cut.gz: the compressed file is cut off");
  EXPECT_EQ(reading("bomb.gz", gzip_member(std::string(18U << 20U, ' '))), "bomb.gz: is larger than 16 MiB");
}

TEST(ConfigFile, DevicesAreNoFiles) {
  if (!std::filesystem::exists("/dev/zero")) GTEST_SKIP();
  EXPECT_EQ(error_of([] { (void)read_config_file("/dev/zero"); }), "/dev/zero: no file: a pipe, a socket or a device");
}

// Text put together from what YAML is made of, at random.
std::string garbage(std::mt19937_64& random) {
  static constexpr const char* kPieces[] = {
      "[",           "]",    "{",   "}",   ":",   ": ",    "- ",       "-",        "? ",
      "?",           "&a",   "*a",  " ",   "  ",  "\n",    "\n ",      "'",        "\"",
      "|",           "|2",   ">-",  "# x", "!",   "!!str", "!<",       "%",        "---",
      "...",         "<<",   ",",   "a",   "b: ", "1",     "~",        ".nan",     "\t",
      "\\",          "\\x",  "@",   "`",   "\r",  "key: ", "- a: 1\n", "\xc3\xa9", "\xef\xbb\xbf",
      "%YAML 1.2\n", "\x04", "\xff"};
  std::string text;
  const auto segments = 1 + random() % 16;
  for (std::uint64_t i = 0; i < segments; ++i) text += kPieces[random() % std::size(kPieces)];
  return text;
}

TEST(ConfigFile, GarbageIsReadOrRefusedButNeverMore) {
  std::mt19937_64 random(20260101);
  int read = 0;
  int refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::string text = garbage(random);
    try {
      (void)parse_config_text(text, "m.yaml");
      ++read;
    } catch (const ConfigError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line a message";
      ++refused;
    } catch (...) {
      FAIL() << "something else than a ConfigError escaped for:\n" << text;
    }
  }
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 100);
}

TEST(ConfigFile, DamagedFilesAreReadOrRefused) {
  std::mt19937_64 random(7);
  const std::string whole =
      "name: \"x\"\nlimits: {a: 1, b: [1, 2, {c: 3}]}\nlist:\n  - &k {p: [0, 1]}\n  - *k\ntext: |\n  line\n";
  for (int i = 0; i < 5'000; ++i) {
    std::string text = whole;
    for (std::uint64_t n = 1 + random() % 4; n > 0; --n) {
      const std::size_t at = random() % text.size();
      switch (random() % 3) {
        case 0:
          text[at] = static_cast<char>(random() % 256);
          break;
        case 1:
          text.erase(at, 1 + random() % 10);
          break;
        default:
          text.insert(at, text.substr(random() % text.size(), 1 + random() % 10));
      }
      if (text.empty()) text = " ";
    }
    try {
      (void)parse_config_text(text, "m.yaml");
    } catch (const ConfigError&) {
    } catch (...) {
      FAIL() << "something else than a ConfigError escaped for:\n" << text;
    }
  }
}

}  // namespace
}  // namespace cairn
