#include "framework/modules/cache_folder.hpp"

#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <fstream>

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
  // Several threads of one process may write the same file at once.
  static std::atomic<int> writes = 0;
  const std::filesystem::path fresh = file.string() + "." + std::to_string(::getpid()) + "." + std::to_string(++writes);
  std::ofstream out(fresh, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (out) std::filesystem::rename(fresh, file, error);
  if (!out || error) std::filesystem::remove(fresh, error);
}

}  // namespace cairn
