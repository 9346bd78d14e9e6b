#include "plugins/template_matcher/trigger.hpp"

#include <cmath>

#include "maps/grid/occupancy_grid.hpp"

namespace cairn::template_matcher {

bool Trigger::fires(Cell coarse, double ol) {
  if (rule_ == TriggerRule::every_update) return ol > min_ol_ && !covered_.contains(coarse);
  if (rule_ == TriggerRule::since_update) {
    const auto [before, is_first] = reference_.try_emplace(coarse, Reference{kUnknownOl});
    const double rise = ol - before->second.ol;
    before->second.ol = ol;
    return ol > min_ol_ && rise > tau_var_;
  }
  if (ol <= min_ol_) return false;
  const auto last = reference_.find(coarse);
  if (last == reference_.end()) return true;
  const double rise = ol - last->second.ol;
  return rise > tau_var_ || (last->second.fitted && std::abs(rise) > tau_again_);
}

void Trigger::matched(Cell coarse, double ol, bool fitted) {
  if (rule_ == TriggerRule::since_matching) reference_[coarse] = {ol, fitted};
  if (rule_ == TriggerRule::every_update) covered_.insert(coarse);
}

}  // namespace cairn::template_matcher
