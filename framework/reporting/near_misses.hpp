// Places where a landmark was nearly recognised: something stands there that is like one, but not like enough, or like
// two categories. For whoever wonders why a landmark is missing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/detector.hpp"

namespace cairn {

struct NearMiss {
  std::string category;  // that fitted best
  Point at_m{0.0, 0.0};
  double degree = 0.0;
  std::string next_category{};  // that fitted next best; empty: no other was reported
  double next_degree = 0.0;
  std::optional<double> needed{};  // degree above which a category fits, where the detector has such a threshold
  double time_s = 0.0;             // of the matching
  // At least half of the way from NearMisses::kMinDegree to what is needed: walls come as far as less than that.
  [[nodiscard]] bool is_close() const;
};

class NearMisses {
 public:
  static constexpr double kMinDegree = 0.45;
  static constexpr double kSamePlace_m = 0.4;
  static constexpr std::size_t kMaxPlaces = 200;  // the worst goes first

  // The newest matching of a place counts, as its map holds all that earlier ones saw.
  void update(const Matching& matching, double time_s);
  // Those at which no landmark has become known, best first.
  [[nodiscard]] std::vector<NearMiss> away_from(const LandmarkGraph& graph) const;

 private:
  std::vector<NearMiss> places_;
};

// "square 0.57 (circle 0.52), needs 0.60"
[[nodiscard]] std::string words_about(const NearMiss& miss);

}  // namespace cairn
