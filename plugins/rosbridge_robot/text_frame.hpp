// A text message of a WebSocket as the bytes that go on the line, for who cannot ask a library: a signal handler, and
// the process that guards the wheels.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace cairn::rosbridge_robot {

// One whole frame as clients send it, masked by that key (RFC 6455, 5.2). At most 65535 bytes of text.
[[nodiscard]] std::vector<std::uint8_t> text_frame(std::string_view text, const std::array<std::uint8_t, 4>& key);

}  // namespace cairn::rosbridge_robot
