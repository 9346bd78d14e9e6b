// The JSON schemas of Foxglove's well-known messages, in full: viewers take from them how each field is encoded
// (https://docs.foxglove.dev/docs/visualization/message-schemas).
#pragma once

#include <string>

namespace cairn::exchange {

enum class FoxgloveMessage { frame_transform, grid, laser_scan, log, pose_in_frame, poses_in_frame, scene_update };

// "foxglove.Grid".
[[nodiscard]] std::string name_of(FoxgloveMessage message);
[[nodiscard]] std::string schema_of(FoxgloveMessage message);

}  // namespace cairn::exchange
