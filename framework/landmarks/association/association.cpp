#include "framework/landmarks/association/association.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "framework/landmarks/matching_parts.hpp"

namespace cairn {
namespace {

constexpr std::size_t kMaxRecent = 6;      // places that are explained together
constexpr std::size_t kMaxHypotheses = 3;  // for each
constexpr double kGate = 12.0;             // further off than this, in log-likelihood, is another
constexpr double kFreshRatio = 0.5;        // one first seen after so much of the shift says nothing of it
constexpr double kSure = 1.4;              // the next best landmark is four times less likely
constexpr double kSplit = 4.0;             // standard deviations of a place
constexpr double kSizeRatio = 0.9;         // landmarks are up to 10 % smaller than their templates

}  // namespace

LandmarkAssociation::LandmarkAssociation(const LandmarksConfig& config, const std::vector<LandmarkShape>& shapes)
    : config_(config), sets_(config, shapes) {
  for (const LandmarkShape& shape : shapes)
    inner_radius_m_[shape.category] = 0.5 * kSizeRatio * shape.contour.inner_diameter_m();
}

void LandmarkAssociation::record_pose(const PoseEstimate& pose) {
  const double variance_m2 = std::max(0.0, 0.5 * (pose.covariance(0, 0) + pose.covariance(1, 1)));
  now_.grown_m2 += std::max(0.0, variance_m2 - now_.variance_m2);
  now_.variance_m2 = variance_m2;
  heading_variance_rad2_ = std::max(0.0, pose.covariance(2, 2));
}

std::vector<LandmarkAssociation::Answer> LandmarkAssociation::associate(const std::vector<Matching>& parts,
                                                                        std::span<const Known> known) {
  ++matchings_;
  for (const Matching& part : parts) remember(sight_of(part, known));
  common_m2_ = common_shift_m2();
  std::vector<SeenPlace> places;
  for (const Sight& sight : recent_) places.push_back(seen_place(sight));
  const JointAssociation joint = associate_jointly(places, {{0.0, 0.0}, common_m2_}, config_.unknown_per_m2);
  shift_ = joint.shift;
  std::vector<Answer> answers;
  const std::size_t first = recent_.size() - std::min(recent_.size(), parts.size());
  for (std::size_t place = first; place < recent_.size(); ++place) {
    Answer answer;
    const int chosen = joint.chosen[place];
    if (chosen != JointAssociation::kNone)
      answer.landmark = places[place].hypotheses[static_cast<std::size_t>(chosen)].landmark;
    for (std::size_t other = 0; other < places[place].hypotheses.size(); ++other)
      if (static_cast<int>(other) != chosen && chosen != JointAssociation::kNone)
        answer.is_sure &= joint.best_with[place][other] < joint.log_likelihood - kSure;
    answers.push_back(answer);
  }
  return answers;
}

LandmarkAssociation::Anchor LandmarkAssociation::anchor_of(LandmarkRef landmark) const {
  const auto at = anchors_.find(landmark);
  return at == anchors_.end() ? Anchor{} : at->second;
}

double LandmarkAssociation::apart_m(const std::string& category, const std::string& other) const {
  const auto a = inner_radius_m_.find(category);
  const auto b = inner_radius_m_.find(other);
  return a == inner_radius_m_.end() || b == inner_radius_m_.end() ? 0.0 : a->second + b->second;
}

// The shift since then is what the pose error has grown by, unless corrections in between have made both poses better
// than that.
double LandmarkAssociation::shifted_since(const Moment& moment) const {
  return std::min(now_.grown_m2 - moment.grown_m2, now_.variance_m2 + moment.variance_m2);
}

LandmarkAssociation::Sight LandmarkAssociation::sight_of(const Matching& part, std::span<const Known> known) const {
  Sight sight{place_of(part), now_, matchings_, {}};
  const TemplateBelief belief = sets_.belief_of(part);
  const double places_m2 = 2.0 * config_.place_m * config_.place_m;
  std::vector<std::pair<double, Relation>> near;
  for (const auto& [ref, landmark] : known) {
    const Anchor anchor = anchor_of(ref);
    const Point off_m = sight.at_m - landmark->T_map_landmark.position();
    const double apart = apart_m(part.degrees.front().category, landmark->category);
    const double variance_m2 = shifted_since(anchor.first) + anchor.shift.variance_m2 + places_m2;
    const double log_place =
        -0.5 * std::min(off_m.squaredNorm(), (off_m + anchor.shift.mean_m).squaredNorm()) / variance_m2;
    if (log_place < -kGate && off_m.norm() > apart) continue;
    const double log_agreement = sets_.log_agreement(belief, sets_.belief_of(*landmark), heading_variance_rad2_);
    near.emplace_back(log_place + log_agreement, Relation{ref, anchor, off_m, log_agreement, apart});
  }
  std::ranges::stable_sort(near, std::greater{}, &std::pair<double, Relation>::first);
  for (std::size_t i = 0; i < std::min(kMaxHypotheses, near.size()); ++i)
    sight.relations.push_back(std::move(near[i].second));
  return sight;
}

// The newer one of two of a place has all that the older one said: maps grow.
void LandmarkAssociation::remember(Sight sight) {
  std::erase_if(recent_, [&](const Sight& other) {
    return other.matching != sight.matching && (other.at_m - sight.at_m).norm() <= split_m();
  });
  recent_.push_back(std::move(sight));
  if (recent_.size() > kMaxRecent) recent_.erase(recent_.begin());
}

// The landmarks that were seen before the pose shifted shift together. Those that were first seen since do not count.
double LandmarkAssociation::common_shift_m2() const {
  std::vector<double> shifts;
  for (const Sight& sight : recent_)
    for (const Relation& relation : sight.relations) shifts.push_back(shifted_since(relation.anchor.first));
  if (shifts.empty()) return 0.0;
  const double fresh = kFreshRatio * *std::ranges::max_element(shifts);
  std::erase_if(shifts, [&](double shift) { return shift < fresh; });
  return *std::ranges::min_element(shifts);
}

SeenPlace LandmarkAssociation::seen_place(const Sight& sight) const {
  SeenPlace place{sight.matching, {}};
  const double since_m2 = shifted_since(sight.when);
  const double places_m2 = 2.0 * config_.place_m * config_.place_m;
  const auto placed_before = [&](const Moment& moment) {
    return std::min(sight.when.grown_m2 - moment.grown_m2, sight.when.variance_m2 + moment.variance_m2);
  };
  for (const Relation& relation : sight.relations) {
    const double shift_m2 = shifted_since(relation.anchor.first);
    PlaceHypothesis hypothesis;
    hypothesis.landmark = relation.landmark;
    hypothesis.tells_shift = shift_m2 >= common_m2_;
    hypothesis.shift = {
        relation.off_m + relation.anchor.shift.mean_m,
        std::max(0.0, shift_m2 - common_m2_) + relation.anchor.shift.variance_m2 + since_m2 + places_m2};
    hypothesis.since_placed = {relation.off_m, placed_before(relation.anchor.last) + places_m2};
    hypothesis.log_agreement = relation.log_agreement;
    hypothesis.apart_m = relation.apart_m;
    place.hypotheses.push_back(hypothesis);
  }
  return place;
}

double LandmarkAssociation::log_ratio(const Known& a, const Known& b) const {
  const Anchor of_a = anchor_of(a.ref);
  const Anchor of_b = anchor_of(b.ref);
  const auto between = [](const Moment& one, const Moment& other) {
    return std::min(std::abs(one.grown_m2 - other.grown_m2), one.variance_m2 + other.variance_m2);
  };
  Point off_m = a.landmark->T_map_landmark.position() - b.landmark->T_map_landmark.position();
  const double places_m2 = 2.0 * config_.place_m * config_.place_m;
  double variance_m2 = between(of_a.last, of_b.last) + places_m2;
  const double by_shift_m2 =
      between(of_a.first, of_b.first) + of_a.shift.variance_m2 + of_b.shift.variance_m2 + places_m2;
  if (by_shift_m2 < variance_m2) {
    variance_m2 = by_shift_m2;
    off_m -= of_a.shift.mean_m - of_b.shift.mean_m;
  }
  const double log_place = log_density(off_m, {{0.0, 0.0}, variance_m2}) - std::log(config_.unknown_per_m2) -
                           log_room(off_m.norm(), variance_m2, apart_m(a.landmark->category, b.landmark->category));
  // Far apart, whatever the templates say.
  if (log_place < -kGate) return log_place;
  return log_place +
         sets_.log_agreement(sets_.belief_of(*a.landmark), sets_.belief_of(*b.landmark), heading_variance_rad2_);
}

void LandmarkAssociation::placed(LandmarkRef landmark) {
  Anchor& anchor = anchors_[landmark];
  if (shifted_since(anchor.first) >= common_m2_) anchor.shift = shift_;
  anchor.last = now_;
}

void LandmarkAssociation::renamed(LandmarkRef from, LandmarkRef to) {
  if (const auto at = anchors_.find(from); at != anchors_.end()) anchors_[to] = at->second;
  anchors_.erase(from);
  for (Sight& sight : recent_)
    for (Relation& relation : sight.relations)
      if (relation.landmark == from) relation.landmark = to;
}

void LandmarkAssociation::forget_places() {
  recent_.clear();
  shift_ = {};
  common_m2_ = 0.0;
  for (auto& [landmark, anchor] : anchors_) anchor.shift = {};
}

void LandmarkAssociation::forget(LandmarkRef landmark) {
  anchors_.erase(landmark);
  for (Sight& sight : recent_)
    std::erase_if(sight.relations, [&](const Relation& relation) { return relation.landmark == landmark; });
}

double LandmarkAssociation::split_m() const {
  return kSplit * config_.place_m;
}

}  // namespace cairn
