#include "framework/landmarks/association/joint_association.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cairn {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr double kMinRoom = 1e-12;  // its logarithm stays finite

// What a place is expected to be off by, as one of the known landmarks. One that was placed lately moves with the pose.
struct Residual {
  Point off_m;
  double variance_m2;
};
Residual residual_of(const PlaceHypothesis& hypothesis, const Offset& shift) {
  const double by_shift_m2 = shift.variance_m2 + hypothesis.shift.variance_m2;
  if (hypothesis.tells_shift && by_shift_m2 <= hypothesis.since_placed.variance_m2)
    return {hypothesis.shift.mean_m - shift.mean_m, by_shift_m2};
  return {hypothesis.since_placed.mean_m, hypothesis.since_placed.variance_m2};
}

Offset updated(const Offset& shift, const Offset& seen) {
  const double variance_m2 = shift.variance_m2 + seen.variance_m2;
  if (variance_m2 <= 0.0) return shift;
  const double gain = shift.variance_m2 / variance_m2;
  return {shift.mean_m + gain * (seen.mean_m - shift.mean_m), (1.0 - gain) * shift.variance_m2};
}

class Search {
 public:
  Search(std::span<const SeenPlace> places, double unknown_per_m2)
      : places_(places), log_unknown_(std::log(unknown_per_m2)), chosen_(places.size(), JointAssociation::kNone) {
    best_.log_likelihood = kImpossible;
    for (const SeenPlace& place : places) best_.best_with.emplace_back(place.hypotheses.size() + 1, kImpossible);
  }

  void go_on(std::size_t place, const Offset& shift, double log_likelihood) {
    if (place == places_.size()) {
      keep(shift, log_likelihood);
      return;
    }
    const SeenPlace& seen = places_[place];
    double log_new = log_unknown_;
    double log_room_beside = 0.0;
    for (std::size_t i = 0; i < seen.hypotheses.size(); ++i) {
      const PlaceHypothesis& hypothesis = seen.hypotheses[i];
      const Residual residual = residual_of(hypothesis, shift);
      log_room_beside =
          std::min(log_room_beside, log_room(residual.off_m.norm(), residual.variance_m2, hypothesis.apart_m));
      if (is_taken(place, hypothesis.landmark)) continue;
      chosen_[place] = static_cast<int>(i);
      go_on(
          place + 1, hypothesis.tells_shift ? updated(shift, hypothesis.shift) : shift,
          log_likelihood + log_density(residual.off_m, {{0.0, 0.0}, residual.variance_m2}) + hypothesis.log_agreement);
    }
    log_new += log_room_beside;
    chosen_[place] = JointAssociation::kNone;
    go_on(place + 1, shift, log_likelihood + log_new);
  }

  JointAssociation take() { return std::move(best_); }

 private:
  bool is_taken(std::size_t place, const LandmarkRef& landmark) const {
    for (std::size_t other = 0; other < place; ++other)
      if (places_[other].matching == places_[place].matching && chosen_[other] != JointAssociation::kNone &&
          places_[other].hypotheses[static_cast<std::size_t>(chosen_[other])].landmark == landmark)
        return true;
    return false;
  }

  void keep(const Offset& shift, double log_likelihood) {
    for (std::size_t place = 0; place < places_.size(); ++place) {
      std::vector<double>& with = best_.best_with[place];
      const std::size_t choice =
          chosen_[place] == JointAssociation::kNone ? with.size() - 1 : static_cast<std::size_t>(chosen_[place]);
      with[choice] = std::max(with[choice], log_likelihood);
    }
    if (!best_.chosen.empty() && log_likelihood <= best_.log_likelihood) return;
    best_.chosen = chosen_;
    best_.log_likelihood = log_likelihood;
    best_.shift = shift;
  }

  std::span<const SeenPlace> places_;
  double log_unknown_;
  std::vector<int> chosen_;
  JointAssociation best_;
};

}  // namespace

JointAssociation associate_jointly(std::span<const SeenPlace> places, const Offset& prior, double unknown_per_m2) {
  Search search(places, unknown_per_m2);
  search.go_on(0, prior, 0.0);
  return search.take();
}

double log_density(const Point& offset_m, const Offset& of) {
  return -0.5 * (offset_m - of.mean_m).squaredNorm() / of.variance_m2 -
         std::log(2.0 * std::numbers::pi * of.variance_m2);
}

double log_room(double distance_m, double variance_m2, double apart_m) {
  if (apart_m <= 0.0) return 0.0;
  return std::log(std::max(kMinRoom, 0.5 * std::erfc((apart_m - distance_m) / std::sqrt(2.0 * variance_m2))));
}

}  // namespace cairn
