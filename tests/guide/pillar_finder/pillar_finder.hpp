// Finds round pillars of one diameter in the occupancy grid.
#pragma once

#include <string>

#include "framework/config/fields.hpp"
#include "framework/contracts/detector.hpp"

namespace pillar_finder {

struct Config {
  double diameter_m = 0.5;
  double tolerance_m = 0.3;
  double tau_match = 0.75;
  std::string category = "pillar";

  static void describe(cairn::Fields<Config>& fields);
};

class PillarFinder : public cairn::Detector {
 public:
  explicit PillarFinder(const Config& config) : config_(config) {}

  // One matching for each blob of the right size that the changes touch.
  cairn::DetectionReport detect(const cairn::OccupancyGrid& grid, const cairn::CellChanges& changes,
                                const cairn::Budget& budget) override;

 private:
  [[nodiscard]] bool has_right_size(const cairn::CellBox& blob, double cell_m) const;
  [[nodiscard]] double degree_at(const cairn::OccupancyGrid& grid, const cairn::Point& centre_m) const;
  [[nodiscard]] cairn::Matching matching_of(const cairn::OccupancyGrid& grid, const cairn::CellBox& blob) const;

  Config config_;
};

}  // namespace pillar_finder
