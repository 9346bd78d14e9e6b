// Packets of the Pioneers' serial protocol (PSOS, P2OS, ARCOS): FA FB, the number of bytes that follow, data, checksum.
// Numbers are little-endian, the checksum is big-endian.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cairn::p2os_robot {

enum class Command : std::uint8_t {
  pulse = 0,
  open = 1,
  close = 2,
  enable_motors = 4,
  velocity = 11,       // mm/s
  turn_velocity = 21,  // deg/s, anticlockwise
  sonar = 28,
};

// A command as it goes on the line. Without allocation.
class CommandPacket {
 public:
  explicit CommandPacket(Command command) : CommandPacket(static_cast<std::uint8_t>(command)) {}
  // The value must have at most 16 bits besides its sign; larger ones are cut to that.
  CommandPacket(Command command, int value);
  // The three packets that begin a connection: 0, 1, 2.
  [[nodiscard]] static CommandPacket synchronisation(int number) {
    return CommandPacket(static_cast<std::uint8_t>(number));
  }
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return {bytes_.data(), size_}; }

 private:
  explicit CommandPacket(std::uint8_t number);
  void close_with_checksum();

  std::array<std::uint8_t, 9> bytes_{};
  std::size_t size_ = 0;
};

// Sum of the pairs of bytes as 16-bit numbers; a last byte alone is XORed in.
[[nodiscard]] std::uint16_t checksum_of(std::span<const std::uint8_t> data);

// Packets out of bytes as they come, whatever lies between them.
class PacketReader {
 public:
  void take(std::span<const std::uint8_t> bytes);
  // The data of the next whole packet.
  [[nodiscard]] std::optional<std::vector<std::uint8_t>> next();
  void clear() { bytes_.clear(); }
  // Packets whose checksum was wrong.
  [[nodiscard]] int damaged() const { return damaged_; }

 private:
  std::deque<std::uint8_t> bytes_;
  int damaged_ = 0;
};

}  // namespace cairn::p2os_robot
