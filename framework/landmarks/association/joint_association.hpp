// Which of the known landmarks the places seen lately are, all of them together.
//
// A pose that has shifted shifts all that is seen by the same amount. So the likelihood of an assignment is that of the
// common shift explaining each residual, one place after the other: with the shift so far N(m, v), a residual y of
// variance w has the likelihood N(y; m, v + w) and makes the shift better known. That is joint compatibility: two
// places that would need two shifts are not explained together (Neira and Tardos, 2001).
#pragma once

#include <span>
#include <vector>

#include "maps/geometry/pose.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

// Candidates and landmarks have ids of their own.
struct LandmarkRef {
  LandmarkId id = 0;
  bool is_candidate = false;
  auto operator<=>(const LandmarkRef&) const = default;  // NOLINT(modernize-use-nullptr)
};

// A normal distribution of an offset, the same in x and y.
struct Offset {
  Point mean_m{0.0, 0.0};
  double variance_m2 = 0.0;
};

// That what was seen at a place is one of the known landmarks.
struct PlaceHypothesis {
  LandmarkRef landmark;
  Offset shift;                // of the pose, that the place then says
  bool tells_shift = true;     // false: the landmark has been seen first when the pose had shifted already
  Offset since_placed;         // of the place from the landmark
  double log_agreement = 0.0;  // of the template sets
  double apart_m = 0.0;        // from centre to centre, at least, where there are two
};

struct SeenPlace {
  int matching = 0;  // no landmark is at two places of one matching
  std::vector<PlaceHypothesis> hypotheses;
};

struct JointAssociation {
  static constexpr int kNone = -1;  // not known yet
  std::vector<int> chosen;          // a hypothesis of each place, or kNone
  double log_likelihood = 0.0;
  Offset shift;  // of the pose, after all places
  // For each place: the log-likelihood of the best assignment with that choice; kNone comes last.
  std::vector<std::vector<double>> best_with;
};

// The most likely assignment. unknown_per_m2: density of landmarks not known yet. O((h + 1)^n) for n places with h
// hypotheses each.
[[nodiscard]] JointAssociation associate_jointly(std::span<const SeenPlace> places, const Offset& prior,
                                                 double unknown_per_m2);

// Log of the density of an offset.
[[nodiscard]] double log_density(const Point& offset_m, const Offset& of);
// Log of the probability that two things are at least apart_m apart which seem to be this far from each other.
[[nodiscard]] double log_room(double distance_m, double variance_m2, double apart_m);

}  // namespace cairn
