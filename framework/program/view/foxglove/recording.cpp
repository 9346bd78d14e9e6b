#include "framework/program/view/foxglove/recording.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <stdexcept>

#include "framework/reporting/recordings/topics.hpp"
#include "maps/exchange/recordings/foxglove_json.hpp"
#include "maps/exchange/recordings/foxglove_schemas.hpp"
#include "maps/exchange/recordings/mcap_reader.hpp"

namespace cairn {
namespace {

namespace foxglove = exchange::foxglove;
using exchange::FoxgloveMessage;

constexpr int kMaxPlayedSide = 1024;
constexpr const char* kPlayedFrame = "map";

PlayedChannel& add_channel(PlayedRecording& recording, const std::string& topic, FoxgloveMessage message) {
  const auto id = static_cast<std::uint32_t>(recording.channels.size() + 1);
  recording.channels.push_back({{id, topic, "json", name_of(message), schema_of(message), "jsonschema"},
                                {},
                                message == FoxgloveMessage::scene_update});
  return recording.channels.back();
}

class RecordingReader {
 public:
  explicit RecordingReader(const std::filesystem::path& file) : file_(file) {
    recording_.name = file.filename().string();
  }

  PlayedRecording read() {
    std::ifstream in(file_, std::ios::binary);
    if (!in) throw std::runtime_error(file_.string() + ": cannot be read");
    exchange::McapHandlers handlers;
    handlers.channel = [this](const exchange::McapChannel& channel) { introduce(channel); };
    handlers.message = [this](const exchange::McapMessage& message) { keep(message); };
    const auto source = [&](char* to, std::size_t count) {
      in.read(to, static_cast<std::streamsize>(count));
      return static_cast<std::size_t>(in.gcount());
    };
    try {
      (void)exchange::read_mcap(source, handlers);
    } catch (const exchange::McapError& error) {
      throw std::runtime_error(file_.string() + ": " + error.what());
    }
    finish();
    return std::move(recording_);
  }

 private:
  void introduce(const exchange::McapChannel& channel) {
    at_.erase(channel.id);
    if (channel.encoding != "json" && channel.encoding != "cdr") return;
    at_[channel.id] = recording_.channels.size();
    PlayedChannel played;
    played.channel = {static_cast<std::uint32_t>(recording_.channels.size() + 1),
                      std::string(channel.topic),
                      std::string(channel.encoding),
                      std::string(channel.schema),
                      std::string(channel.schema_data),
                      std::string(channel.schema_encoding)};
    played.is_incremental = channel.schema == name_of(FoxgloveMessage::scene_update);
    recording_.channels.push_back(std::move(played));
  }

  void keep(const exchange::McapMessage& message) {
    const auto found = at_.find(message.channel);
    if (found == at_.end()) return;
    bytes_ += message.data.size();
    if (bytes_ > kMaxPlayedBytes) throw std::runtime_error(file_.string() + ": holds more than 1 GiB of messages");
    recording_.channels[found->second].messages.push_back({message.log_time_ns, std::string(message.data)});
  }

  void finish() {
    bool is_first = true;
    for (PlayedChannel& channel : recording_.channels) {
      std::ranges::stable_sort(channel.messages, {}, &PlayedMessage::time_ns);
      const std::uint64_t begin_ns = channel.messages.front().time_ns;  // introduced with its first message
      const std::uint64_t end_ns = channel.messages.back().time_ns;
      recording_.times.begin_ns = is_first ? begin_ns : std::min(recording_.times.begin_ns, begin_ns);
      recording_.times.end_ns = std::max(recording_.times.end_ns, end_ns);
      is_first = false;
    }
  }

  const std::filesystem::path& file_;
  PlayedRecording recording_;
  std::map<std::uint16_t, std::size_t> at_;  // by the file's channel
  std::size_t bytes_ = 0;
};

}  // namespace

PlayedRecording played_recording(const std::filesystem::path& file) {
  return RecordingReader(file).read();
}

PlayedRecording played_map(const SavedMap& map, const std::string& name) {
  constexpr std::uint64_t kNow = 0;
  PlayedRecording recording;
  recording.name = name;
  add_channel(recording, topics::kMap, FoxgloveMessage::grid)
      .messages.push_back({kNow, foxglove::grid(kNow, kPlayedFrame, foxglove::grid_bytes(map.grid, kMaxPlayedSide))});
  auto& landmarks = add_channel(recording, topics::kLandmarks, FoxgloveMessage::scene_update).messages;
  for (const auto& [id, landmark] : map.graph.landmarks())
    landmarks.push_back({kNow, foxglove::landmark(kNow, kPlayedFrame, landmark)});
  add_channel(recording, topics::kDrivenPath, FoxgloveMessage::poses_in_frame)
      .messages.push_back({kNow, foxglove::poses_in_frame(kNow, kPlayedFrame, map.driven_path)});
  return recording;
}

}  // namespace cairn
