#include "plugins/p2os_robot/packet.hpp"

#include <algorithm>
#include <cstdlib>

namespace cairn::p2os_robot {
namespace {

constexpr std::uint8_t kFirst = 0xFA;
constexpr std::uint8_t kSecond = 0xFB;
constexpr std::size_t kHead = 3;
constexpr std::uint8_t kPositive = 0x3B;
constexpr std::uint8_t kNegative = 0x1B;
constexpr int kMaxValue = 0xFFFF;

}  // namespace

std::uint16_t checksum_of(std::span<const std::uint8_t> data) {
  unsigned sum = 0;
  std::size_t i = 0;
  for (; i + 1 < data.size(); i += 2) sum += static_cast<unsigned>(data[i]) << 8U | data[i + 1];
  if (i < data.size()) sum ^= data[i];
  return static_cast<std::uint16_t>(sum);
}

CommandPacket::CommandPacket(std::uint8_t number) : bytes_{kFirst, kSecond, 3, number}, size_(4) {
  close_with_checksum();
}

CommandPacket::CommandPacket(Command command, int value)
    : bytes_{kFirst, kSecond, 6, static_cast<std::uint8_t>(command)}, size_(7) {
  const int size = std::min(std::abs(value), kMaxValue);
  bytes_[4] = value < 0 ? kNegative : kPositive;
  bytes_[5] = static_cast<std::uint8_t>(size & 0xFF);
  bytes_[6] = static_cast<std::uint8_t>(size >> 8);
  close_with_checksum();
}

void CommandPacket::close_with_checksum() {
  const std::uint16_t sum = checksum_of({bytes_.data() + kHead, size_ - kHead});
  bytes_[size_++] = static_cast<std::uint8_t>(sum >> 8U);
  bytes_[size_++] = static_cast<std::uint8_t>(sum & 0xFFU);
}

void PacketReader::take(std::span<const std::uint8_t> bytes) {
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

std::optional<std::vector<std::uint8_t>> PacketReader::next() {
  for (;;) {
    while (!bytes_.empty() && bytes_[0] != kFirst) bytes_.pop_front();
    if (bytes_.size() < kHead) return std::nullopt;
    const std::size_t follow = bytes_[2];
    if (bytes_[1] != kSecond || follow < 3) {  // no packet begins here
      bytes_.pop_front();
      continue;
    }
    if (bytes_.size() < kHead + follow) return std::nullopt;
    const auto begin = bytes_.begin() + kHead;
    std::vector<std::uint8_t> data(begin, begin + static_cast<std::ptrdiff_t>(follow - 2));
    const unsigned sum = static_cast<unsigned>(bytes_[kHead + follow - 2]) << 8U | bytes_[kHead + follow - 1];
    if (sum != checksum_of(data)) {
      ++damaged_;
      bytes_.pop_front();  // another may begin within it
      continue;
    }
    bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(kHead + follow));
    return data;
  }
}

}  // namespace cairn::p2os_robot
