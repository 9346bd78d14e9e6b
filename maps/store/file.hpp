// The saved map as a file: its header, and how a new one takes the place of an old one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>

#include "maps/store/map_store.hpp"

namespace cairn::store {

inline constexpr std::size_t kHeaderBytes = 100;  // of SQLite's format

// The file of a map without content.
struct EmptyMapFile {
  std::string bytes;
  std::set<std::uint32_t> content_pages;  // those that hold rows when there are any, by number from 1
};

// Calls work() and puts the file in front of what is wrong.
template <typename Work>
auto in_file(const std::filesystem::path& file, Work work, const char* failure = "cannot be read") {
  try {
    return work();
  } catch (const StoreError& error) {
    throw StoreError(file.string() + ": " + error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    throw StoreError(file.string() + ": " + failure + ": " + error.code().message());
  }
}

// As cairn::replace_file(), with a StoreError.
void replace_map(const std::filesystem::path& file, std::string_view bytes, Links links);

// Refuses, with a StoreError, what no saved map of a known schema version begins like.
void check_header(const std::filesystem::path& file);

// The same for what may be damaged behind its first 100 bytes; its schema version.
[[nodiscard]] int check_kind(const std::filesystem::path& file);
// Whether it names the program that wrote it, as every map does.
[[nodiscard]] bool names_its_program(const std::string& bytes);
// A file's bytes as SQLite takes them when some are missing at the end. The pages that define the tables are the same
// in every map of a version: with definitions, not null, they take the place of those that are there.
[[nodiscard]] std::string as_far_as_it_goes(std::string bytes, const EmptyMapFile* definitions);

// Whether the file is absent, empty or begins as a saved map of any version, so that saving a map over it destroys
// nothing else that was named by mistake. A link that is replaced itself may.
[[nodiscard]] bool may_be_replaced(const std::filesystem::path& file, Links links);
// Throws StoreError unless it may.
void require_replaceable(const std::filesystem::path& file, Links links);

}  // namespace cairn::store
