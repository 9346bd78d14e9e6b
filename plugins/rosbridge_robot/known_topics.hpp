// What rosapi says is there: topics with their types, and who listens to velocities.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace cairn::rosbridge_robot {

class KnownTopics {
 public:
  static constexpr const char* kTopicsCall = "cairn:topics";
  static constexpr const char* kListenersCall = "cairn:listeners";

  // An answer to one of these calls; one that says that there is no rosapi, or that is none, is ignored.
  void take_answer(const nlohmann::json& answer);

  // By their names; none: rosapi has not answered.
  [[nodiscard]] const std::optional<std::map<std::string, std::string>>& types() const { return types_; }
  // How many listen to velocities; none: the same.
  [[nodiscard]] std::optional<std::size_t> listeners() const { return listeners_; }

 private:
  std::optional<std::map<std::string, std::string>> types_;
  std::optional<std::size_t> listeners_;
};

}  // namespace cairn::rosbridge_robot
