// What is played to Foxglove's viewers: the recording of a run, or a saved map as if it had been recorded at one
// moment.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/program/view/foxglove/frames.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {

inline constexpr std::size_t kMaxPlayedBytes = std::size_t{1} << 30;  // of messages, which are kept in memory

struct PlayedMessage {
  std::uint64_t time_ns = 0;
  std::string data;
};

struct PlayedChannel {
  foxglove_protocol::Channel channel;
  std::vector<PlayedMessage> messages;  // by time
  bool is_incremental = false;          // what it shows is the sum of its messages, not the last of them
};

struct PlayedRecording {
  std::string name;
  std::vector<PlayedChannel> channels;
  foxglove_protocol::Range times;
};

// All topics of an MCAP file in JSON or CDR; of a damaged or cut file those that can be read. Throws std::runtime_error
// when it cannot be read, or holds more than kMaxPlayedBytes.
[[nodiscard]] PlayedRecording played_recording(const std::filesystem::path& file);
// Grid, landmarks and driven path.
[[nodiscard]] PlayedRecording played_map(const SavedMap& map, const std::string& name);

}  // namespace cairn
