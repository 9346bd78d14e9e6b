// Keeps the guesses of a robot that does not know where it is, while it drives, and says when one can be believed.
//
// Each search looks at all that has been seen since the robot began, so guesses that have become wrong drop out, and
// one that stays ahead has explained more and more of it. One guess is believed when, at each search over so many
// metres driven, it was the same one, its score was high, next to nothing contradicted it, no other came near it, and
// corners hold it.
#pragma once

#include <optional>
#include <vector>

#include "maps/relocalisation/pose_search.hpp"

namespace cairn {

struct BeliefRules {
  double search_every_m = 1.0;  // driven
  double ahead_for_m = 3.0;     // driven
  double min_score = 0.7;
  double clear_ratio = 0.93;  // no other guess scores more than this, of the best
  double max_contradicted_ratio = 0.03;
  double same_m = 0.5;  // how far the same guess may move between two searches
  double same_rad = radians(10.0);
};

class PoseBelief {
 public:
  explicit PoseBelief(const BeliefRules& rules = {}) : rules_(rules) {}

  // Whether the robot has driven so far that a search is worth its time. At every tick.
  bool drive(const Pose2& T_local_robot);
  // What a search has found that began there.
  void update(const std::vector<PoseHypothesis>& found, const Pose2& T_local_robot);

  [[nodiscard]] double driven_m() const { return driven_m_; }
  // Of the last search, best first.
  [[nodiscard]] const std::vector<PoseHypothesis>& guesses() const { return guesses_; }
  // Where the robot's own frame lies in the map, once a guess is believed, as of the last search.
  [[nodiscard]] const std::optional<Pose2>& T_map_local() const { return T_map_local_; }

 private:
  [[nodiscard]] bool is_clear() const;

  BeliefRules rules_;
  double driven_m_ = 0.0;
  double searched_at_m_ = 0.0;
  std::optional<Pose2> T_local_robot_;
  std::vector<PoseHypothesis> guesses_;
  std::optional<Pose2> T_map_local_ahead_;  // of the guess that is clearly ahead
  double ahead_since_m_ = 0.0;
  std::optional<Pose2> T_map_local_;
};

}  // namespace cairn
