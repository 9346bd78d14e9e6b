#include "maps/base/fingerprint.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <array>
#include <fstream>
#include <memory>

namespace cairn {

std::uint64_t hash_of(std::string_view bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

std::string fingerprint_of(std::string_view text) {
  return fmt::format("{:016x}", hash_of(text));
}

std::optional<FileHash> hash_of_file(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  if (state == nullptr || XXH3_64bits_reset(state.get()) != XXH_OK) return std::nullopt;
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::array<char, 1U << 16U> piece{};
  FileHash result;
  while (in.read(piece.data(), piece.size()) || in.gcount() > 0) {
    const auto count = static_cast<std::size_t>(in.gcount());
    if (XXH3_64bits_update(state.get(), piece.data(), count) != XXH_OK) return std::nullopt;
    result.size += count;
  }
  if (in.bad()) return std::nullopt;
  result.hash = XXH3_64bits_digest(state.get());
  return result;
}

}  // namespace cairn
