#include "plugins/common/pictures/picture_player.hpp"

#include <stdexcept>

#include "maps/base/text.hpp"

namespace cairn::pictures {

SensorStep PicturePlayer::next(const Budget& budget) {
  SensorStep step = log_->next(budget);
  if (step.state != SensorState::observation) {
    const std::size_t unused = left_out_ + pictures_.size();
    if (unused > 0) step.reason += "; " + counted(unused, "picture") + " without an observation within 1 s after it";
    return step;
  }
  Observation& seen = step.observation;
  const double now_s = seen.recorded_s.value_or(seen.stamp_s);
  for (; !pictures_.empty(); pictures_.pop_front()) {
    const RecordedPicture& picture = pictures_.front();
    if (picture.observation > observation_ || picture.stamp_s > now_s) break;
    if (picture.stamp_s < now_s - kMaxBehind_s) {
      ++left_out_;
      continue;
    }
    try {
      seen.images.push_back(picture.read());
    } catch (const std::runtime_error& error) {
      return {SensorState::fault, {}, error.what()};
    }
    seen.images.back().stamp_s = seen.stamp_s + (picture.stamp_s - now_s);
  }
  ++observation_;
  return step;
}

}  // namespace cairn::pictures
