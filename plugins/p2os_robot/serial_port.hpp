// A serial line, eight bits, no parity, one stop bit, without waiting.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "framework/live/descriptor.hpp"

namespace cairn::p2os_robot {

// Raw, and for this process alone. Throws std::runtime_error with the reason and what helps.
[[nodiscard]] Descriptor open_serial_port(const std::filesystem::path& device, int baud);
// Speeds that a serial line can have here, as 9600.
[[nodiscard]] bool is_baud(int baud);
// All of it at once. Async-signal-safe. False: it found no room, or the line is gone.
[[nodiscard]] bool write_now(int port, std::span<const std::uint8_t> bytes) noexcept;

}  // namespace cairn::p2os_robot
