// Messages that come in pieces ("op": "fragment").
#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace cairn::rosbridge_robot {

class Fragments {
 public:
  static constexpr std::size_t kMaxPieces = 4096;  // of a message
  static constexpr std::size_t kMaxMessages = 8;   // that are not whole yet; then the oldest goes

  explicit Fragments(std::size_t max_message_bytes) : max_bytes_(max_message_bytes) {}

  // The whole message with its last piece; none: there are pieces to come, or it is no piece, which is ignored.
  [[nodiscard]] std::optional<std::string> add(const nlohmann::json& piece);

 private:
  struct Message {
    std::vector<std::optional<std::string>> pieces;
    std::size_t bytes = 0;
    std::size_t missing = 0;
    std::size_t number = 0;  // of the order in which they have begun
  };
  std::size_t max_bytes_;
  std::size_t begun_ = 0;
  std::map<std::string, Message> messages_;
};

}  // namespace cairn::rosbridge_robot
