#include "framework/reporting/near_misses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace cairn {
namespace {

bool is_near(const Point& a, const Point& b) {
  return (a - b).norm() <= NearMisses::kSamePlace_m;
}

// None where nothing nearly fits.
std::optional<NearMiss> near_miss_of(const Matching& matching) {
  std::vector<CategoryDegree> degrees = matching.degrees;
  std::ranges::stable_sort(degrees, std::greater(), &CategoryDegree::degree);
  if (degrees.empty() || degrees.front().degree < NearMisses::kMinDegree) return std::nullopt;
  NearMiss miss{degrees.front().category, degrees.front().at_m, degrees.front().degree};
  miss.needed = matching.fits_above;
  if (degrees.size() > 1) {
    miss.next_category = degrees[1].category;
    miss.next_degree = degrees[1].degree;
  }
  return miss;
}

}  // namespace

bool NearMiss::is_close() const {
  return !needed || degree >= 0.5 * (NearMisses::kMinDegree + *needed);
}

void NearMisses::update(const Matching& matching, double time_s) {
  if (matching.detection) {
    const Point at_m = matching.detection->T_map_landmark.position();
    std::erase_if(places_, [&](const NearMiss& place) { return is_near(place.at_m, at_m); });
    return;
  }
  std::optional<NearMiss> miss = near_miss_of(matching);
  if (!miss) return;
  miss->time_s = time_s;
  std::erase_if(places_, [&](const NearMiss& place) { return is_near(place.at_m, miss->at_m); });
  places_.push_back(*miss);
  if (places_.size() > kMaxPlaces) places_.erase(std::ranges::min_element(places_, {}, &NearMiss::degree));
}

std::vector<NearMiss> NearMisses::away_from(const LandmarkGraph& graph) const {
  std::vector<NearMiss> away = places_;
  std::erase_if(away, [&](const NearMiss& place) {
    return std::ranges::any_of(graph.landmarks(), [&](const auto& entry) {
      return is_near(entry.second.T_map_landmark.position(), place.at_m);
    });
  });
  std::ranges::stable_sort(away, std::greater(), &NearMiss::degree);
  return away;
}

std::string words_about(const NearMiss& miss) {
  std::string words = fmt::format("{} {:.2f}", miss.category, miss.degree);
  if (!miss.next_category.empty()) words += fmt::format(" ({} {:.2f})", miss.next_category, miss.next_degree);
  if (miss.needed) words += fmt::format(", needs {:.2f}", *miss.needed);
  return words;
}

}  // namespace cairn
