// What the view offers to viewers of Foxglove's protocol.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/program/view/foxglove/connection.hpp"
#include "framework/program/view/foxglove/recording.hpp"

namespace cairn {

struct FoxgloveOffer {
  // Called with the first viewer. Throws std::exception when there is nothing to play.
  std::function<std::shared_ptr<const PlayedRecording>()> recording;
  FoxgloveServices services;
  std::vector<std::string> origins;  // of pages elsewhere that may connect, as "https://app.example.org"
};

// Of a run's folder its recording, the only *.mcap; without one its map, the only *.cairn; of a map the map. Loaded
// with the first call and kept.
[[nodiscard]] std::function<std::shared_ptr<const PlayedRecording>()> played_lazily(const std::filesystem::path& named);

}  // namespace cairn
