// How far the estimated pose is from the true one, where a simulation knows it.
#pragma once

#include <optional>
#include <vector>

#include "framework/contracts/world_view.hpp"
#include "framework/reporting/thinned_series.hpp"

namespace cairn {

struct PoseErrorSample {
  double time_s = 0.0;
  double error_m = 0.0;
  double error_rad = 0.0;
  double sigmas = 0.0;  // Mahalanobis distance of the true pose from the estimate, by the estimate's covariance
};

struct PoseErrorFigures {
  double median_m = 0.0;
  double p95_m = 0.0;
  double worst_m = 0.0;
  double last_m = 0.0;
  double median_deg = 0.0;
  double worst_deg = 0.0;
  double sigmas_median = 0.0;    // of an honest estimate of three numbers: 1.54
  std::int64_t corrections = 0;  // sightings that the localizer has used
  std::int64_t refused = 0;
};

class PoseErrors {
 public:
  // max_samples: then one in two seconds is kept, one in four, and so on; medians are of those that are kept.
  explicit PoseErrors(std::size_t max_samples = 10000) : samples_(max_samples) {}

  // Once a tick, with the true pose where it is known. Samples once a second.
  void note(const WorldView& world, const std::optional<Pose2>& true_T_map_robot);

  // None where the truth was never known.
  [[nodiscard]] std::optional<PoseErrorFigures> figures() const;
  [[nodiscard]] const std::vector<PoseErrorSample>& samples() const { return samples_.samples(); }

 private:
  ThinnedSeries<PoseErrorSample> samples_;
  std::optional<PoseErrorSample> last_;
  double worst_m_ = 0.0;
  double worst_rad_ = 0.0;
  std::int64_t corrections_ = 0;
  std::int64_t refused_ = 0;
};

}  // namespace cairn
