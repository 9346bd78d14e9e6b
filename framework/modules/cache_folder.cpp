#include "framework/modules/cache_folder.hpp"

#include <cstdlib>

#include "maps/base/output_file.hpp"

namespace cairn {

std::filesystem::path cache_folder(const char* variable, const std::string& name) {
  const auto value_of = [](const char* known) {
    const char* value = std::getenv(known);
    return std::string(value == nullptr ? "" : value);
  };
  if (const std::string chosen = value_of(variable); !chosen.empty())
    return chosen == "off" ? std::filesystem::path() : std::filesystem::path(chosen);
  // The XDG rules say to ignore a relative path.
  const std::filesystem::path cache = value_of("XDG_CACHE_HOME");
  if (cache.is_absolute()) return cache / "cairn" / name;
  const std::filesystem::path home = value_of("HOME");
  return home.is_absolute() ? home / ".cache" / "cairn" / name : std::filesystem::path();
}

void keep_in_cache(const std::filesystem::path& file, const std::string& bytes) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  try {
    replace_file(file, bytes, {.sync = false});
  } catch (const OutputError&) {
    return;  // it is found out again the next time
  }
}

}  // namespace cairn
