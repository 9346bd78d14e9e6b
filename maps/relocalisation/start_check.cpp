#include "maps/relocalisation/start_check.hpp"

#include <array>

namespace cairn {

std::string_view name_of(StartTrust trust) {
  constexpr std::array<std::string_view, 4> kNames = {"open", "doubtful", "stayed", "carried"};
  return kNames.at(static_cast<std::size_t>(trust));
}

bool StartCheck::is_against(const StartLook& look) const {
  const PoseHypothesis& believed = look.believed;
  if (believed.contradicted_ratio >= rules_.contradicted_ratio && believed.score <= rules_.max_score) return true;
  if (!look.elsewhere || believed.contradicted_ratio < rules_.contradicted_ratio_beside) return false;
  return believed.score < rules_.clear_ratio * look.elsewhere->score &&
         look.elsewhere->contradicted_ratio <= 0.5 * believed.contradicted_ratio;
}

void StartCheck::update(const StartLook& look) {
  if (!is_open()) return;
  looks_.push_back(look);
  against_ = is_against(look) ? against_ + 1 : 0;
  if (against_ >= rules_.looks_against)
    trust_ = StartTrust::carried;
  else if (against_ > 0)
    trust_ = StartTrust::doubtful;
  else
    trust_ = look.driven_m >= rules_.open_for_m ? StartTrust::stayed : StartTrust::open;
}

}  // namespace cairn
