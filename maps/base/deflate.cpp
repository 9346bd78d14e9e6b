#include "maps/base/deflate.hpp"

#include <zlib.h>

#include <limits>
#include <new>
#include <stdexcept>

namespace cairn {
namespace {

constexpr int kLevel = 6;
constexpr std::size_t kMaxBytesPerPacked = 1100;  // deflate's limit is 1032 : 1

const Bytef* zlib_bytes(std::string_view text) {
  return reinterpret_cast<const Bytef*>(text.data());
}

}  // namespace

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, zlib_bytes(bytes), bytes.size(), kLevel) != Z_OK)
    throw std::logic_error("zlib could not compress " + std::to_string(bytes.size()) + " bytes");
  packed.resize(size);
  return packed;
}

std::string inflated(std::string_view packed, std::size_t size) {
  // Checked before the memory is asked for: a small file must not claim gigabytes.
  if (size > (packed.size() + 1) * kMaxBytesPerPacked)
    throw std::invalid_argument(std::to_string(packed.size()) + " bytes cannot unpack to " + std::to_string(size));
  std::string bytes(size, '\0');
  uLongf unpacked = size;
  const int code = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &unpacked, zlib_bytes(packed), packed.size());
  if (code != Z_OK || unpacked != size)
    throw std::invalid_argument("its bytes do not unpack to " + std::to_string(size) + " bytes");
  return bytes;
}

std::string gzip_member(std::string_view bytes) {
  constexpr int kGzipWindow = 15 + 16;  // the largest window, with gzip's header and no time in it
  constexpr int kMemory = 8;
  z_stream stream{};
  if (bytes.size() > std::numeric_limits<uInt>::max()) throw std::length_error("gzip_member: more than 4 GB at once");
  if (deflateInit2(&stream, kLevel, Z_DEFLATED, kGzipWindow, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string packed(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = const_cast<Bytef*>(zlib_bytes(bytes));  // which zlib only reads
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int code = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (code != Z_STREAM_END) throw std::logic_error("zlib could not pack " + std::to_string(bytes.size()) + " bytes");
  return packed;
}

}  // namespace cairn
