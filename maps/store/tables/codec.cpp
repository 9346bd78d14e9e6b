#include "maps/store/tables/codec.hpp"

#include <zlib.h>

#include <stdexcept>

#include "maps/store/map_store.hpp"

namespace cairn::store {
namespace {

constexpr int kCompressionLevel = 6;
constexpr std::size_t kMaxRawBytesPerPacked = 1100;  // deflate's limit is 1032 : 1

const Bytef* bytes_of(std::string_view text) {
  return reinterpret_cast<const Bytef*>(text.data());
}

}  // namespace

std::string compressed(const std::string& raw) {
  uLongf size = compressBound(raw.size());
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, bytes_of(raw), raw.size(), kCompressionLevel) != Z_OK)
    throw std::logic_error("zlib could not compress " + std::to_string(raw.size()) + " bytes");
  packed.resize(size);
  return packed;
}

std::string decompressed(const std::string& packed, std::size_t raw_size) {
  // Checked before the memory is asked for: a small file must not claim gigabytes.
  if (raw_size > (packed.size() + 1) * kMaxRawBytesPerPacked)
    throw StoreError(std::to_string(packed.size()) + " bytes cannot unpack to " + std::to_string(raw_size));
  std::string raw(raw_size, '\0');
  uLongf size = raw_size;
  const int code = uncompress(reinterpret_cast<Bytef*>(raw.data()), &size, bytes_of(packed), packed.size());
  if (code != Z_OK || size != raw_size)
    throw StoreError("its bytes do not unpack to " + std::to_string(raw_size) + " bytes");
  return raw;
}

std::uint32_t crc32_of(std::string_view bytes, std::uint32_t crc_before) {
  return static_cast<std::uint32_t>(crc32_z(crc_before, bytes_of(bytes), bytes.size()));
}

}  // namespace cairn::store
