#include "maps/store/map_updater.hpp"

#include <optional>

#include "maps/store/file.hpp"
#include "maps/store/map_database.hpp"
#include "maps/store/update.hpp"

namespace cairn {
namespace {

using store::Database;

bool is_plain_file(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::is_regular_file(std::filesystem::symlink_status(file, error)) &&
         std::filesystem::hard_link_count(file, error) == 1;
}

// The bytes that were written; none when it could not be done, and the file must be written as a whole.
std::optional<std::uint64_t> updated(const std::filesystem::path& file, Database& wanted) {
  if (!is_plain_file(file)) return std::nullopt;
  try {
    const std::uint64_t bytes = store::update_map_file(file, wanted);
    Database found = store::opened(file);
    store::check_pages(found);
    static_cast<void>(store::checked(std::move(found)));
    return bytes;
  } catch (const StoreError&) {
    return std::nullopt;
  }
}

}  // namespace

MapUpdater::MapUpdater(std::filesystem::path file)
    : file_(std::move(file)), earlier_(file_.parent_path() / ("." + file_.filename().string() + ".earlier")) {}

MapUpdater::~MapUpdater() {
  if (file_is_ours_) drop_earlier();
}

void MapUpdater::save(const SavedMap& map) {
  Database wanted = store::database_of(map);
  const auto save = [&] {
    store::require_replaceable(file_, Links::replace);
    const auto bytes = has_earlier_ ? updated(earlier_, wanted) : std::nullopt;
    if (!bytes) drop_earlier();
    const std::string whole = bytes ? std::string() : wanted.serialized();
    bytes_written_ += bytes.value_or(whole.size());
    if (!file_is_ours_) {
      store::replace_map(file_, whole, Links::replace);
      file_is_ours_ = true;
      return;
    }
    if (!bytes) store::replace_map(earlier_, whole, Links::replace);
    has_earlier_ = exchange_files(file_, earlier_);
    if (!has_earlier_) std::filesystem::rename(earlier_, file_);
  };
  store::in_file(file_, save, "cannot be written");
}

void MapUpdater::drop_earlier() noexcept {
  has_earlier_ = false;
  std::error_code error;
  std::filesystem::remove(earlier_, error);
}

}  // namespace cairn
