#include "maps/base/fingerprint.hpp"

#include <fmt/format.h>

namespace cairn {

std::uint64_t hash_of(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

std::string fingerprint_of(std::string_view text) {
  return fmt::format("{:016x}", hash_of(text));
}

}  // namespace cairn
