#include "framework/behaviour_tree/sub_mission_file.hpp"

#include <algorithm>
#include <cctype>
#include <string>
#include <system_error>

namespace cairn {
namespace {

constexpr const char* kNotShown = " (what stands in a file outside the folder of the one that names it is not shown)";

std::filesystem::path resolved(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::weakly_canonical(file, error);
  return error ? std::filesystem::absolute(file, error) : path;
}

bool is_below(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const std::filesystem::path relative = resolved(file).lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

// A sentence quotes what was found, or gives it after a colon.
ConfigError without_content(const ConfigError& error) {
  if (error.place().line == 0) return error;
  const std::string& sentence = error.sentence();
  return {error.place(), sentence.substr(0, std::min(sentence.find(" \""), sentence.find(": "))) + kNotShown};
}

ConfigValue content_of(const std::filesystem::path& file, const SourcePlace& place) {
  std::error_code error;
  if (std::filesystem::exists(file, error)) return read_config_file(file);
  try {
    return read_config_file(file);
  } catch (const ConfigError& missing) {
    throw ConfigError(place, missing.what());
  }
}

bool holds_a_key_of_sub_missions(const ConfigValue& root) {
  return std::ranges::any_of(schema_of<SubMissionFile>().fields,
                             [&](const FieldSpec& field) { return root.find(field.key) != nullptr; });
}

}  // namespace

SubMissionFile read_sub_mission(const std::filesystem::path& file, const std::filesystem::path& including,
                                const SourcePlace& place) {
  const bool is_outside = !is_below(file, resolved(including).parent_path());
  ConfigValue root;
  try {
    root = content_of(file, place);
  } catch (const ConfigError& error) {
    if (is_outside && error.place().file == file.string()) throw without_content(error);
    throw;
  }
  if (root.kind != ConfigValue::Kind::map)
    throw ConfigError(root.place, "a sub-mission must be a map with the key \"steps\", found " + root.kind_name());
  if (is_outside && !holds_a_key_of_sub_missions(root))
    throw ConfigError(root.place, std::string("no sub-mission: it lacks the key \"steps\"") + kNotShown);
  return load_config<SubMissionFile>(root, "sub-mission");
}

}  // namespace cairn
