// A beam's cells as runs of a row that lie in one tile and are seen in one direction bucket.
#pragma once

#include <vector>

#include "maps/beam_cells.hpp"

namespace cairn::muriel {

struct Piece {
  Cell first;
  int cells = 0;
  int bucket = 0;
};

// The half-beam up to which BeamPieces knows its way.
inline constexpr double kWidestFastHalfBeam_rad = 0.25 * 3.14159265358979;

class BeamPieces {
 public:
  // bearings: direction buckets of a full turn, as bucket_of() numbers them; 0: one bucket for all.
  explicit BeamPieces(int bearings);

  // Replaces the pieces. half_beam_rad at most kWidestFastHalfBeam_rad.
  void cover(const Beam& beam, double cell_m);

  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  [[nodiscard]] int cells() const { return cells_; }

 private:
  struct Edge {  // between two buckets
    double x = 0.0;
    double y = 0.0;
    int bucket_before = 0;
    int bucket_beyond = 0;  // anticlockwise of it
  };

  void find_edges(const Beam& beam);
  void split_row(const CellSpan& span, const Point& apex_cells);
  void add(int y, int x_begin, int x_end, int bucket);

  std::vector<Edge> all_edges_;  // edge k lies between the buckets k and k + 1
  int first_edge_ = 0;           // of the beam
  int edges_ = 0;
  int first_bucket_ = 0;
  std::vector<CellSpan> spans_;
  std::vector<Piece> pieces_;
  int cells_ = 0;
};

}  // namespace cairn::muriel
