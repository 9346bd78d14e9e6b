#include "maps/relocalisation/pose_check.hpp"

#include <array>

namespace cairn {

std::string_view name_of(PoseVerdict verdict) {
  constexpr std::array<std::string_view, 4> kNames = {"open", "doubtful", "stayed", "carried"};
  return kNames.at(static_cast<std::size_t>(verdict));
}

bool PoseCheck::is_against(const PoseLook& look) const {
  const PoseHypothesis& believed = look.believed;
  if (believed.contradicted_ratio >= rules_.contradicted_ratio && believed.score <= rules_.max_score) return true;
  if (!look.elsewhere || believed.contradicted_ratio < rules_.contradicted_ratio_beside) return false;
  return believed.score < rules_.clear_ratio * look.elsewhere->score &&
         look.elsewhere->contradicted_ratio <= 0.5 * believed.contradicted_ratio;
}

bool PoseCheck::has_stayed(const PoseLook& look) const {
  return look.driven_m >= (look.believed.score >= rules_.min_score ? rules_.open_for_m : rules_.open_at_most_m);
}

void PoseCheck::update(const PoseLook& look) {
  if (!is_open()) return;
  looks_.push_back(look);
  against_ = is_against(look) ? against_ + 1 : 0;
  if (against_ >= rules_.looks_against)
    verdict_ = PoseVerdict::carried;
  else if (against_ > 0)
    verdict_ = PoseVerdict::doubtful;
  else
    verdict_ = has_stayed(look) ? PoseVerdict::stayed : PoseVerdict::open;
}

}  // namespace cairn
