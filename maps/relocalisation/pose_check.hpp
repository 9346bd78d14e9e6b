// Whether a robot is where it is believed to be in a map, or was carried: of one that goes on with a saved map, and of
// one whose place is in doubt.
//
// Two measures of the pose that it is believed to have: how much of what it has seen contradicts the map there, and
// whether another place of the map fits clearly better. The score alone says little: where the map is not finished,
// much of what is seen right is unknown to it. docs/results/kidnapped.md has the distributions that the rules are
// chosen by.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "maps/relocalisation/pose_search.hpp"

namespace cairn {

// What a search has found beside the pose that the robot was believed to have.
struct PoseLook {
  double driven_m = 0.0;
  PoseHypothesis believed;
  std::optional<PoseHypothesis> elsewhere;  // the best pose that is not that one, if it is as good as a guess
};

struct PoseCheckRules {
  // A look is against the pose when at least so much contradicts it and it scores at most so much, ...
  double contradicted_ratio = 0.08;
  double max_score = 0.72;
  // ... or when a place elsewhere scores clearly more, and is contradicted by half of what contradicts the pose.
  double contradicted_ratio_beside = 0.05;
  double clear_ratio = 0.85;
  int looks_against = 2;    // in a row: the robot was carried
  double open_for_m = 6.0;  // driven: then it has stayed, ...
  // ... if the pose scores so much by then, or after so much more: where little is known of what it sees, little can
  // contradict.
  double min_score = 0.0;
  double open_at_most_m = 15.0;
};

enum class PoseVerdict : std::uint8_t {
  open,      // nothing is known yet, or nothing speaks against the pose so far
  doubtful,  // the last look was against it
  stayed,
  carried
};
[[nodiscard]] std::string_view name_of(PoseVerdict verdict);

class PoseCheck {
 public:
  explicit PoseCheck(const PoseCheckRules& rules = {}) : rules_(rules) {}

  // In their order. Once it has stayed or was carried, that does not change any more.
  void update(const PoseLook& look);
  [[nodiscard]] PoseVerdict verdict() const { return verdict_; }
  [[nodiscard]] bool is_open() const { return verdict_ == PoseVerdict::open || verdict_ == PoseVerdict::doubtful; }
  [[nodiscard]] const std::vector<PoseLook>& looks() const { return looks_; }

 private:
  [[nodiscard]] bool is_against(const PoseLook& look) const;
  [[nodiscard]] bool has_stayed(const PoseLook& look) const;

  PoseCheckRules rules_;
  PoseVerdict verdict_ = PoseVerdict::open;
  int against_ = 0;  // in a row
  std::vector<PoseLook> looks_;
};

}  // namespace cairn
