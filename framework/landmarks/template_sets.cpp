#include "framework/landmarks/template_sets.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "maps/landmarks/landmark_template.hpp"

namespace cairn {
namespace {

// Shapes are compared with themselves, turned by this, on cells of this size.
constexpr double kTurn_deg = 15.0;
constexpr double kCell_m = 0.05;
// Of this many matchings a landmark's set is chance or not: of the first one it is one time in six.
constexpr double kPriorMatchings = 0.2;

double period_of(const Contour& contour) {
  const auto orientations = static_cast<double>(distinct_orientations(contour, radians(kTurn_deg), kCell_m).size());
  return orientations <= 1.0 ? 0.0 : radians(kTurn_deg) * orientations;
}

// Degrees become probabilities.
template <class Item, class DegreeOf>
std::vector<double> probabilities(const std::vector<Item>& items, double scale, DegreeOf degree_of) {
  std::vector<double> all;
  double best = 0.0;
  for (const Item& item : items) best = std::max(best, degree_of(item));
  double sum = 0.0;
  for (const Item& item : items) sum += all.emplace_back(std::exp((degree_of(item) - best) / scale));
  for (double& probability : all) probability /= sum;
  return all;
}

// Of a normal distribution that is wound round a circle of this period.
double wrapped_density(double turn_rad, double period_rad, double variance_rad2) {
  const double nearest_rad = std::remainder(turn_rad, period_rad);
  double density = 0.0;
  for (const double round : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
    const double off_rad = nearest_rad + round * period_rad;
    density += std::exp(-0.5 * off_rad * off_rad / variance_rad2);
  }
  return density / std::sqrt(2.0 * std::numbers::pi * variance_rad2);
}

std::vector<OrientationBelief> orientations_of(const std::string& category, const std::vector<TemplateDegree>& set,
                                               double scale) {
  std::vector<TemplateDegree> own;
  std::ranges::copy_if(set, std::back_inserter(own), [&](const auto& t) { return t.category == category; });
  const std::vector<double> share = probabilities(own, scale, [](const auto& t) { return t.degree; });
  std::vector<OrientationBelief> orientations;
  for (std::size_t i = 0; i < own.size(); ++i) orientations.push_back({own[i].orientation_rad, share[i]});
  return orientations;
}

}  // namespace

TemplateSets::TemplateSets(const LandmarksConfig& config, const std::vector<LandmarkShape>& shapes) : config_(config) {
  for (const LandmarkShape& shape : shapes) period_rad_[shape.category] = period_of(shape.contour);
}

TemplateBelief TemplateSets::belief_of(const Matching& matching) const {
  TemplateBelief belief{{}, config_.chance_ratio};
  const std::vector<double> share =
      probabilities(matching.degrees, config_.degree_scale, [](const auto& d) { return d.degree; });
  for (std::size_t i = 0; i < share.size(); ++i) {
    const CategoryDegree& degree = matching.degrees[i];
    CategoryBelief category{degree.category, share[i], {}};
    category.orientations = orientations_of(degree.category, matching.templates, config_.degree_scale);
    if (category.orientations.empty()) category.orientations = {{degree.orientation_rad, 1.0}};
    belief.categories.push_back(std::move(category));
  }
  return belief;
}

TemplateBelief TemplateSets::belief_of(const Landmark& landmark) const {
  int matchings = 0;
  std::vector<CategoryEvidence> fitted;
  for (const CategoryEvidence& evidence : landmark.evidence) {
    matchings = std::max(matchings, evidence.matchings);
    if (evidence.last_degree > 0.0) fitted.push_back(evidence);
  }
  // An imported one is what it is called.
  if (fitted.empty() && !landmark.category.empty()) fitted.push_back({landmark.category, 1, 1.0, 1.0, 1.0});
  if (landmark.evidence.empty()) matchings = landmark.sightings;
  TemplateBelief belief;
  belief.chance = std::max(config_.chance_ratio, kPriorMatchings / (kPriorMatchings + matchings));
  const std::vector<double> share =
      probabilities(fitted, config_.degree_scale, [](const auto& e) { return e.last_degree; });
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    CategoryBelief category{fitted[i].category, share[i], {}};
    category.orientations = orientations_of(category.category, landmark.templates, config_.degree_scale);
    if (category.orientations.empty() && category.category == landmark.category)
      category.orientations = {{landmark.T_map_landmark.theta_rad, 1.0}};
    belief.categories.push_back(std::move(category));
  }
  return belief;
}

double TemplateSets::orientation_ratio(const CategoryBelief& a, const CategoryBelief& b,
                                       double heading_variance_rad2) const {
  const auto period = period_rad_.find(a.category);
  if (period == period_rad_.end() || period->second == 0.0 || a.orientations.empty() || b.orientations.empty())
    return 1.0;
  // Wider than a turn it says nothing any more.
  const double variance = std::min(config_.orientation_rad * config_.orientation_rad + heading_variance_rad2,
                                   period->second * period->second);
  double ratio = 0.0;
  for (const OrientationBelief& at_a : a.orientations)
    for (const OrientationBelief& at_b : b.orientations) {
      const double turn_rad = at_a.orientation_rad - at_b.orientation_rad;
      ratio +=
          at_a.probability * at_b.probability * period->second * wrapped_density(turn_rad, period->second, variance);
    }
  return ratio;
}

double TemplateSets::log_agreement(const TemplateBelief& a, const TemplateBelief& b,
                                   double heading_variance_rad2) const {
  if (a.categories.empty() || b.categories.empty()) return 0.0;
  std::set<std::string> names;
  for (const auto& [name, period] : period_rad_) names.insert(name);
  for (const TemplateBelief* belief : {&a, &b})
    for (const CategoryBelief& category : belief->categories) names.insert(category.category);
  double ratio = 0.0;
  for (const CategoryBelief& of_a : a.categories)
    for (const CategoryBelief& of_b : b.categories)
      if (of_a.category == of_b.category)
        ratio += static_cast<double>(names.size()) * of_a.probability * of_b.probability *
                 orientation_ratio(of_a, of_b, heading_variance_rad2);
  const double both_speak = (1.0 - a.chance) * (1.0 - b.chance);
  return std::log(both_speak * ratio + 1.0 - both_speak);
}

}  // namespace cairn
