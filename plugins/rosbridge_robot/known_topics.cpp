#include "plugins/rosbridge_robot/known_topics.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace cairn::rosbridge_robot {
namespace {

constexpr std::size_t kMaxTopics = 2000;

// None: there is no such list of texts.
std::optional<std::vector<std::string>> texts_in(const nlohmann::json& values, const char* key) {
  const auto found = values.find(key);
  if (found == values.end() || !found->is_array()) return std::nullopt;
  std::vector<std::string> texts;
  for (const nlohmann::json& text : *found)
    if (text.is_string() && texts.size() < kMaxTopics) texts.push_back(text.get<std::string>());
  return texts;
}

}  // namespace

void KnownTopics::take_answer(const nlohmann::json& answer) {
  const auto id = answer.find("id");
  const auto values = answer.find("values");
  if (id == answer.end() || values == answer.end() || !values->is_object()) return;
  if (*id == kListenersCall) {
    if (const auto listeners = texts_in(*values, "subscribers")) listeners_ = listeners->size();
  } else if (*id == kTopicsCall) {
    const auto topics = texts_in(*values, "topics");
    const auto types = texts_in(*values, "types");
    if (!topics || !types) return;
    types_.emplace();
    for (std::size_t i = 0; i < std::min(topics->size(), types->size()); ++i)
      types_->emplace((*topics)[i], (*types)[i]);
  }
}

}  // namespace cairn::rosbridge_robot
