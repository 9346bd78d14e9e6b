#include "maps/store/tables/codec.hpp"

#include <zlib.h>

#include <stdexcept>

#include "maps/base/deflate.hpp"
#include "maps/store/map_store.hpp"

namespace cairn::store {
namespace {

const Bytef* bytes_of(std::string_view text) {
  return reinterpret_cast<const Bytef*>(text.data());
}

}  // namespace

std::string unpacked_bytes(const std::string& packed, std::size_t raw_size) {
  try {
    return inflated(packed, raw_size);
  } catch (const std::invalid_argument& error) {
    throw StoreError(error.what());
  }
}

std::uint32_t crc32_of(std::string_view bytes, std::uint32_t crc_before) {
  return static_cast<std::uint32_t>(crc32_z(crc_before, bytes_of(bytes), bytes.size()));
}

}  // namespace cairn::store
