#include "plugins/rosbridge_robot/text_frame.hpp"

#include <stdexcept>

namespace cairn::rosbridge_robot {
namespace {

constexpr std::uint8_t kLastOfText = 0x81;
constexpr std::uint8_t kMasked = 0x80;
constexpr std::uint8_t kTwoBytesFollow = 126;

}  // namespace

std::vector<std::uint8_t> text_frame(std::string_view text, const std::array<std::uint8_t, 4>& key) {
  if (text.size() > 0xFFFF) throw std::invalid_argument("a frame of more than 65535 bytes");
  const auto byte = [](std::size_t value) { return static_cast<std::uint8_t>(value & 0xFFU); };
  std::vector<std::uint8_t> frame{kLastOfText};
  if (text.size() < kTwoBytesFollow) {
    frame.push_back(byte(kMasked | text.size()));
  } else {
    frame.push_back(byte(kMasked | kTwoBytesFollow));
    frame.push_back(byte(text.size() >> 8U));
    frame.push_back(byte(text.size()));
  }
  frame.insert(frame.end(), key.begin(), key.end());
  for (std::size_t i = 0; i < text.size(); ++i)
    frame.push_back(static_cast<std::uint8_t>(static_cast<std::uint8_t>(text[i]) ^ key[i % key.size()]));
  return frame;
}

}  // namespace cairn::rosbridge_robot
