#include "framework/program/view/foxglove/offer.hpp"

#include <mutex>
#include <stdexcept>

#include "framework/program/view/folder_map.hpp"

namespace cairn {
namespace {

// Empty: none. Throws when there are several.
std::filesystem::path only_recording(const std::filesystem::path& folder) {
  std::filesystem::path found;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".mcap") continue;
    if (!found.empty()) throw std::runtime_error(folder.string() + " holds several recordings (*.mcap)");
    found = entry.path();
  }
  return found;
}

PlayedRecording loaded(const std::filesystem::path& named) {
  const bool is_folder = std::filesystem::is_directory(named);
  if (is_folder)
    if (const auto recording = only_recording(named); !recording.empty()) return played_recording(recording);
  const std::filesystem::path map = is_folder ? map_in(named) : named;
  return played_map(load_map(map), map.filename().string());
}

}  // namespace

std::function<std::shared_ptr<const PlayedRecording>()> played_lazily(const std::filesystem::path& named) {
  struct Kept {
    std::mutex mutex;
    std::shared_ptr<const PlayedRecording> recording;
  };
  return [named, kept = std::make_shared<Kept>()] {
    const std::lock_guard lock(kept->mutex);
    if (!kept->recording) kept->recording = std::make_shared<const PlayedRecording>(loaded(named));
    return kept->recording;
  };
}

}  // namespace cairn
