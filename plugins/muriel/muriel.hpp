// Mapper: MURIEL (METHOD 2; paper section 2.2): Bayes in log-odds with specular weighting and an
// independence log.
//
// Each reading's lambda is (1 - s) lambda0 + s, s the probability that it is specular given the map before
// it; each cell takes only a few readings from each direction of sight (independence_log.hpp). A cell's
// change is round(w 256 ln lambda), w the weight its log leaves; a change of 0 leaves the log alone.
// A reading speaks of the cells up to 4.5 range errors behind its echo, or behind max_m without one, and
// nowhere beyond alpha_range_m.
//
// What a reading means stands in sonar_model/reading.hpp; an observation under a pose that is not finite
// is ignored. A cone that is nowhere wider than a cell is a ray, and a ray is all axis.
//
// Same cells and, to one quantum of 1/256 nat a reading, same values as plain_muriel.hpp, and the same
// bits on every machine of one architecture.
// 10 bytes a cell: 2 in OG1, 8 in the log.
#pragma once

#include <vector>

#include "framework/contracts/mapper.hpp"
#include "plugins/muriel/beam_kernels.hpp"
#include "plugins/muriel/independence_log.hpp"
#include "plugins/muriel/reading_model.hpp"

namespace cairn::muriel {

class Muriel final : public Mapper {
 public:
  explicit Muriel(const Config& config);

  // One span a row, from the first cell whose log-odds changed to the last. O(cells in the beams).
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override;
  [[nodiscard]] const OccupancyGrid& grid() const override { return grid_; }

  // Memory of OG1 and the log.
  [[nodiscard]] std::size_t bytes() const { return grid_.bytes() + log_.bytes(); }

  // For tests that begin in the middle.
  [[nodiscard]] IndependenceLog& log() { return log_; }
  [[nodiscard]] OccupancyGrid& grid() { return grid_; }

 private:
  void integrate_reading(const PlacedReading& reading);
  void find_runs(const PlacedReading& reading);
  void make_room(std::size_t cells);
  [[nodiscard]] double specular_p(const PlacedReading& reading, int known) const;
  void open_runs(const KernelScale& scale);
  void apply(const KernelScale& scale);
  void join_rows();

  Config config_;
  KernelWeights weights_{};
  LogOdds believed_;
  std::vector<double> probability_;  // by log-odds, from believed_ on
  OccupancyGrid grid_;
  IndependenceLog log_;
  CellChanges changes_;  // of the latest call

  // Of one reading; kept for their memory.
  std::vector<CellSpan> spans_;
  std::vector<Run> runs_;
  std::vector<float> floats_;
  std::vector<std::int32_t> integers_;
  std::vector<KnownTarget> known_;
  KernelCells cells_{};
  std::vector<CellSpan> hull_;
};

}  // namespace cairn::muriel
