// What the page asks of a run: while it runs, and of what it has left behind.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "framework/program/common/commands.hpp"
#include "framework/program/view/map_api.hpp"
#include "framework/program/view/view_request.hpp"

namespace cairn {

// A folder's map is loaded with the first question about it.
class FolderApi {
 public:
  // The command's map may be a folder. Throws when it is a map that cannot be loaded, or a folder that holds neither a
  // run nor one map.
  FolderApi(const ViewCommand& command, const CommonOptions& common);

  // From any thread.
  [[nodiscard]] ViewResponse answer(const ViewRequest& request);
  // Empty: this is no folder.
  [[nodiscard]] std::filesystem::path folder() const { return is_folder_ ? command_.map : std::filesystem::path(); }

 private:
  [[nodiscard]] std::string kind() const;  // live, run or map
  [[nodiscard]] ViewResponse steer(const ViewRequest& request) const;
  [[nodiscard]] ViewResponse edit(const ViewRequest& request);
  [[nodiscard]] ViewResponse file(const std::string& name) const;
  [[nodiscard]] std::shared_ptr<MapApi> map();

  const ViewCommand command_;
  const CommonOptions common_;
  const bool is_folder_;
  std::mutex mutex_;  // of map_, and of the file's changes
  std::shared_ptr<MapApi> map_;
};

}  // namespace cairn
