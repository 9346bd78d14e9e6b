// The reference and the schemas in the tree say what the program says today.

#include "framework/program/reference/reference.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

namespace cairn {
namespace {

const std::filesystem::path kSource = CAIRN_SOURCE_DIR;
constexpr const char* kUpdate = " is out of date; `make reference` writes it anew";

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

const ModuleLibrary& shipped_modules() {
  static const ModuleLibrary library({std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn"});
  return library;
}

// Modules in Python are left out where sanitizers are asked for, or Python's headers are not there.
bool has_all_modules() {
  return std::ranges::any_of(shipped_modules().entries(),
                             [](const ModuleEntry& entry) { return std::string(entry.module->name) == "python"; });
}
constexpr const char* kLacks = "python_module, which the reference names, was not built";

TEST(Reference, TheMarkdownIsCurrent) {
  EXPECT_THAT(shipped_modules().faults(), testing::IsEmpty());
  if (!has_all_modules()) GTEST_SKIP() << kLacks;
  EXPECT_TRUE(text_of(kSource / "docs/configuration.md") == reference_markdown(shipped_modules()))
      << "docs/configuration.md" << kUpdate;
}

TEST(Reference, TheSchemasAreCurrent) {
  if (!has_all_modules()) GTEST_SKIP() << kLacks;
  for (const SchemaFile& schema : reference_schemas(shipped_modules()))
    EXPECT_TRUE(text_of(kSource / "config/schema" / schema.file_name) == schema.text)
        << "config/schema/" << schema.file_name << kUpdate;
}

TEST(Reference, EveryModuleAndEveryOneOfItsSettingsStandsInTheMarkdown) {
  const std::string text = reference_markdown(shipped_modules());
  ASSERT_FALSE(shipped_modules().entries().empty());
  for (const ModuleEntry& entry : shipped_modules().entries()) {
    const std::size_t kind = text.find("\n### " + std::string(name_of(entry.module->kind)) + "\n");
    const std::size_t at = text.find("\n#### " + entry.module->name + "\n", kind);
    ASSERT_NE(at, std::string::npos) << entry.module->name;
    const std::string section = text.substr(at, text.find("\n#", at + 2) - at);
    EXPECT_THAT(section, testing::HasSubstr(entry.module->summary));
    for (const FieldSpec& field : entry.module->schema.fields)
      EXPECT_THAT(section, testing::HasSubstr("| `" + field.key + "` |")) << entry.module->name;
  }
}

// A mission that names one of the two takes the other by `--set map.plugin=...`.
TEST(Reference, EverySettingOfThePlainBayesMapIsOneOfMurielToo) {
  const std::vector<FieldSpec>& wanted = shipped_modules().find_any("bayes")->module->schema.fields;
  const std::vector<FieldSpec>& known = shipped_modules().find_any("muriel")->module->schema.fields;
  for (const FieldSpec& field : wanted) {
    const auto found = std::ranges::find(known, field.key, &FieldSpec::key);
    ASSERT_NE(found, known.end()) << field.key;
    EXPECT_EQ(found->type, field.type) << field.key;
    EXPECT_EQ(found->unit, field.unit) << field.key;
    EXPECT_EQ(found->range.min, field.range.min) << field.key;
    EXPECT_EQ(found->range.max, field.range.max) << field.key;
  }
}

// An editor offers what the schema names: a detector's own settings, with meaning, bounds and default.
TEST(Reference, TheMissionSchemaOffersAModulesOwnSettings) {
  const auto files = reference_schemas(shipped_modules());
  ASSERT_EQ(files.front().file_name, "mission.schema.json");
  const auto schema = nlohmann::json::parse(files.front().text);
  const auto& setting = schema["definitions"]["detector.template_matcher"]["properties"]["tau_match"];
  EXPECT_EQ(setting["type"], "number");
  EXPECT_EQ(setting["minimum"], 0);
  EXPECT_EQ(setting["maximum"], 1);
  EXPECT_EQ(setting["default"], 0.6);
  EXPECT_EQ(setting["description"], "a template fits when its degree is above this");
}

}  // namespace
}  // namespace cairn
