// MURIEL cell by cell, as docs/method.md 2 has it: the oracle for the fast one (muriel.hpp), and what its speed
// is measured against. Obviously right before anything else.
#pragma once

#include "framework/contracts/mapper.hpp"
#include "plugins/muriel/independence_log.hpp"
#include "plugins/muriel/reading_model.hpp"

namespace cairn::muriel {

// What one reading changes. spans is for its memory only; changed gains the cells that changed.
void integrate_plainly(const Config& config, const PlacedReading& reading, OccupancyGrid& grid, IndependenceLog& log,
                       std::vector<CellSpan>& spans, std::vector<CellSpan>& changed);

class PlainMuriel final : public Mapper {
 public:
  explicit PlainMuriel(const Config& config) : config_(config), grid_(config.cell_m, config.clamp_nat) {}

  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override;
  [[nodiscard]] const OccupancyGrid& grid() const override { return grid_; }

  // For tests that begin in the middle.
  [[nodiscard]] OccupancyGrid& grid() { return grid_; }
  [[nodiscard]] IndependenceLog& log() { return log_; }

 private:
  Config config_;
  OccupancyGrid grid_;
  IndependenceLog log_;
  CellChanges changes_;  // of the latest call
  std::vector<CellSpan> spans_;
};

}  // namespace cairn::muriel
