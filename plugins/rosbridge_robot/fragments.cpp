#include "plugins/rosbridge_robot/fragments.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace cairn::rosbridge_robot {
namespace {

std::size_t count_in(const nlohmann::json& piece, const char* key) {
  const auto found = piece.find(key);
  return found != piece.end() && found->is_number_unsigned() ? found->get<std::size_t>() : Fragments::kMaxPieces + 1;
}

}  // namespace

std::optional<std::string> Fragments::add(const nlohmann::json& piece) {
  const std::size_t number = count_in(piece, "num");
  const std::size_t total = count_in(piece, "total");
  const auto id = piece.find("id");
  const auto data = piece.find("data");
  if (id == piece.end() || data == piece.end() || !data->is_string()) return std::nullopt;
  if (total == 0 || total > kMaxPieces || number >= total) return std::nullopt;
  const std::string key = id->dump();
  Message& message = messages_[key];
  if (message.pieces.size() != total) message = {std::vector<std::optional<std::string>>(total), 0, total, ++begun_};
  std::optional<std::string>& place = message.pieces[number];
  if (place) return std::nullopt;
  place = data->get<std::string>();
  message.bytes += place->size();
  if (--message.missing == 0 && message.bytes <= max_bytes_) {
    std::string whole;
    for (const auto& part : message.pieces) whole += *part;
    messages_.erase(key);
    return whole;
  }
  if (message.missing == 0 || message.bytes > max_bytes_) {
    messages_.erase(key);
  } else if (messages_.size() > kMaxMessages) {
    messages_.erase(std::ranges::min_element(messages_, {}, [](const auto& one) { return one.second.number; }));
  }
  return std::nullopt;
}

}  // namespace cairn::rosbridge_robot
