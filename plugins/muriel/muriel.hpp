// Mapper: MURIEL (docs/method.md 2; paper section 2.2): Bayes in log-odds with specular weighting and an
// independence log.
//
// Each reading's lambda is (1 - s) lambda0 + s, s the probability that it is specular given the map before
// it; each cell takes only a few readings from each direction of sight (independence_log.hpp). A cell's
// change is round(w 256 ln lambda), w the weight its log leaves; a change of 0 leaves the log alone.
// A reading speaks of the cells up to 4.5 range errors behind its echo, or behind max_m without one, and
// nowhere beyond alpha_range_m.
//
// A beam of no width is a laser's: it is never specular (light_rays.hpp).
//
// What a reading means stands in sonar_model/reading.hpp; an observation under a pose that is not finite
// is ignored. A cone that is nowhere wider than a cell is a ray, and a ray is all axis.
//
// Same cells and, to one quantum of 1/256 nat a reading, same values as plain_muriel.hpp, and the same
// bits on every machine of one architecture.
// 10 bytes a cell: 2 in OG1, 8 in the log.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "framework/contracts/mapper.hpp"
#include "plugins/common/sonar_model/cleared_footprint.hpp"
#include "plugins/muriel/beam_kernels.hpp"
#include "plugins/muriel/independence_log.hpp"
#include "plugins/muriel/light_rays.hpp"
#include "plugins/muriel/reading_model.hpp"

namespace cairn::muriel {

class Muriel final : public Mapper {
 public:
  explicit Muriel(const Config& config);

  // One span a row, from the first cell whose log-odds changed to the last. O(cells in the beams).
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override;
  [[nodiscard]] const OccupancyGrid& grid() const override { return grid_; }
  // Whose room is free where it stands.
  void clear_under(const RobotModel& robot) { cleared_footprint_ = sonar_model::ClearedFootprint(robot); }
  // What it was read from is not known: the log begins empty.
  void begin_with(const OccupancyGrid& grid) { grid_ = grid; }

  // Memory of OG1 and the log.
  [[nodiscard]] std::size_t bytes() const { return grid_.bytes() + log_.bytes(); }

  // Of rays of light, so far.
  [[nodiscard]] std::int64_t cells_on_rays() const { return light_rays_.cells(); }

  // For tests that begin in the middle.
  [[nodiscard]] IndependenceLog& log() { return log_; }
  [[nodiscard]] OccupancyGrid& grid() { return grid_; }

 private:
  // Cells of one row in one tile, as blocks; none of these lies beyond that.
  struct Run {
    Cell first;
    int begin = 0;  // the beam's part of it, counted from `first`
    int end = 0;
    int first_block = 0;
    int blocks = 0;
    bool is_seen = true;  // the map has that tile
  };

  void integrate_reading(const PlacedReading& reading);
  void find_runs(const Beam& beam);
  void find_blocks(const Beam& beam, int first_plane);
  void make_room();
  [[nodiscard]] KernelReading kernel_reading(const PlacedReading& reading) const;
  [[nodiscard]] std::optional<KernelLog> kernel_log(const Beam& beam) const;
  [[nodiscard]] double specular_p(const KernelReading& reading, int known) const;
  void open_unseen(const KernelScale& scale, int first_plane);
  void note_changes();
  void join_rows();

  Config config_;
  Weights weights_;
  LogOdds believed_;
  OccupancyGrid grid_;
  IndependenceLog log_;
  LightRays light_rays_;
  RowHull light_rows_;   // of the latest call's rays of light
  CellChanges changes_;  // of the latest call
  sonar_model::ClearedFootprint cleared_footprint_;

  // Of one reading; kept for their memory.
  std::vector<CellSpan> spans_;
  std::vector<Run> runs_;
  std::vector<Block> blocks_;  // the first block_count_
  int block_count_ = 0;
  std::vector<float> floats_;
  std::vector<std::int32_t> integers_;
  std::vector<std::uint8_t> moved_;
  KernelCells cells_{};
  std::vector<CellSpan> hull_;
  // What stands for cells of tiles that are not there; it stays 0, for only blocks that say nothing keep to it.
  std::array<LogOdds, kBlock_cells> unseen_cells_{};
  std::array<std::uint16_t, kPlanes * sonar_model::kCellsInTile> unseen_log_{};
};

}  // namespace cairn::muriel
