#include "maps/store/file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include "maps/store/map_store.hpp"
#include "maps/store/schema.hpp"

namespace cairn::store {
namespace {

constexpr std::string_view kSqliteMagic{"SQLite format 3\0", 16};

[[noreturn]] void fail(const char* what, int error) {
  throw StoreError(what + std::string(": ") + std::strerror(error));
}

std::uint32_t big_endian_at(const std::string& bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = (value << 8) | static_cast<unsigned char>(bytes[offset + i]);
  return value;
}

struct Beginning {
  std::string header;
  std::uintmax_t file_bytes = 0;  // of the same file, also when another takes its name meanwhile
};

Beginning beginning_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail("cannot be read", errno);
  Beginning found{std::string(kHeaderBytes, '\0')};
  stream.read(found.header.data(), static_cast<std::streamsize>(kHeaderBytes));
  found.header.resize(static_cast<std::size_t>(stream.gcount()));
  stream.clear();
  stream.seekg(0, std::ios::end);
  found.file_bytes = static_cast<std::uintmax_t>(std::max<std::streamoff>(stream.tellg(), 0));
  return found;
}

// Offsets as SQLite's file format lays them down.
std::uint64_t page_bytes_of(const std::string& header) {
  const std::uint32_t page = big_endian_at(header, 16) >> 16;
  return page == 1 ? 65536 : std::max(page, 1U);
}

void check_size(const std::string& header, std::uintmax_t found) {
  const std::uint64_t expected = page_bytes_of(header) * big_endian_at(header, 28);
  if (found < expected)
    throw StoreError("is truncated: " + std::to_string(found) + " of " + std::to_string(expected) + " bytes are there");
}

void check_version(std::int64_t version) {
  if (version > kMapSchemaVersion)
    throw StoreError("was written with schema version " + std::to_string(version) +
                     ", this Cairn reads up to version " + std::to_string(kMapSchemaVersion) + ": use a newer Cairn");
  if (version < 1) throw StoreError("has schema version " + std::to_string(version) + ", the first one is 1");
}

}  // namespace

bool names_its_program(const std::string& bytes) {
  return bytes.size() >= kHeaderBytes && std::string_view(bytes).starts_with(kSqliteMagic) &&
         big_endian_at(bytes, 68) == kMapApplicationId;
}

void replace_map(const std::filesystem::path& file, std::string_view bytes, Links links) {
  try {
    replace_file(file, bytes, {.links = links});
  } catch (const OutputError& error) {
    throw StoreError(error.what());
  }
}

namespace {

void check_is_file(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw StoreError("no such file");
  if (!std::filesystem::is_regular_file(status)) throw StoreError("is not a file");
}

int check_kind_of(const std::string& header) {
  if (header.empty()) throw StoreError("is empty");
  if (header.starts_with("\x1f\x8b")) throw StoreError("is packed by gzip: unpack it with gunzip");
  if (!std::string_view(header).starts_with(kSqliteMagic)) throw StoreError("is not a saved map (no SQLite 3 file)");
  if (header.size() < kHeaderBytes)
    throw StoreError("is truncated: only " + std::to_string(header.size()) + " bytes are there");
  if (!names_its_program(header))
    throw StoreError("is not a saved map (an SQLite file of another program: application_id " +
                     std::to_string(big_endian_at(header, 68)) + ", a map has " + std::to_string(kMapApplicationId) +
                     ")");
  const auto version = static_cast<std::int32_t>(big_endian_at(header, 60));
  check_version(version);
  return version;
}

}  // namespace

int check_kind(const std::filesystem::path& file) {
  check_is_file(file);
  return check_kind_of(beginning_of(file).header);
}

void check_header(const std::filesystem::path& file) {
  check_is_file(file);
  const Beginning found = beginning_of(file);
  static_cast<void>(check_kind_of(found.header));
  check_size(found.header, found.file_bytes);
}

std::string as_far_as_it_goes(std::string bytes, const EmptyMapFile* definitions) {
  const std::size_t page_bytes = page_bytes_of(definitions == nullptr ? bytes : definitions->bytes);
  const std::size_t found = (bytes.size() + page_bytes - 1) / page_bytes;
  bytes.resize(found * page_bytes, '\0');
  if (definitions != nullptr) {
    const std::size_t least = definitions->bytes.size() / page_bytes;
    bytes.resize(std::max(found, least) * page_bytes, '\0');
    for (std::uint32_t number = 1; number <= least; ++number)
      if (number > found || !definitions->content_pages.contains(number))
        bytes.replace((number - 1) * page_bytes, page_bytes, definitions->bytes, (number - 1) * page_bytes, page_bytes);
  }
  const std::size_t pages = bytes.size() / page_bytes;
  for (std::size_t i = 0; i < 4; ++i) bytes[28 + i] = static_cast<char>((pages >> (8 * (3 - i))) & 0xFF);
  for (std::size_t i = 0; i < 4; ++i) bytes[92 + i] = bytes[24 + i];  // so that the number of pages is believed
  return bytes;
}

bool may_be_replaced(const std::filesystem::path& file, Links links) {
  if (links == Links::replace && std::filesystem::is_symlink(file)) return true;
  if (!std::filesystem::exists(file)) return true;
  if (!std::filesystem::is_regular_file(file)) return false;
  const std::string header = beginning_of(file).header;
  return header.empty() || names_its_program(header);
}

void require_replaceable(const std::filesystem::path& file, Links links) {
  if (!may_be_replaced(file, links)) throw StoreError("is there already and is not a saved map: it is left as it is");
}

}  // namespace cairn::store
