#include "framework/mission/loop/display_feed.hpp"

#include "framework/config/config_errors.hpp"

namespace cairn {

void DisplayFeed::on(const Event& event, const MissionView& /*view*/) {
  if (const auto* plan = std::get_if<PlanDone>(&event)) {
    if (!plan->result.path.empty()) path_ = plan->result.path;
  } else if (std::holds_alternative<StepEnded>(event)) {
    path_.clear();
  }
}

std::string DisplayFeed::given_up(const std::exception& fault) {
  display_ = {};
  return std::string(fault.what()) + "; nothing is shown there any more";
}

std::vector<std::string> DisplayFeed::show(const MissionSnapshot& snapshot) {
  try {
    display_.call([&](MissionDisplay& display) { display.show(snapshot); });
  } catch (const ModuleFault& fault) {
    return {given_up(fault)};
  }
  return {};
}

std::vector<std::string> DisplayFeed::hand_orders_to(Orders& orders) {
  std::vector<std::string> sentences;
  while (display_) {
    std::optional<DisplayOrder> given;
    try {
      given = display_.call([](MissionDisplay& display) { return display.next_order(); });
      if (!given) break;
      if (given->problem.empty())
        orders.give(parse_order(given->text, "order"));
      else
        sentences.push_back(given->problem);
    } catch (const ConfigError& error) {
      sentences.push_back("order " + given->text + " refused: " + error.what());
    } catch (const ModuleFault& fault) {
      sentences.push_back(given_up(fault));
    }
  }
  return sentences;
}

}  // namespace cairn
