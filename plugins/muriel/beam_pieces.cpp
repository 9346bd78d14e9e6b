#include "plugins/muriel/beam_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "plugins/muriel/independence_log.hpp"

namespace cairn::muriel {

BeamPieces::BeamPieces(int bearings) {
  for (int k = 0; k < bearings; ++k) {
    const double angle = (k + 0.5) * 2.0 * std::numbers::pi / bearings;
    all_edges_.push_back({std::cos(angle), std::sin(angle), k, (k + 1) % bearings});
  }
}

void BeamPieces::cover(const Beam& beam, double cell_m) {
  pieces_.clear();
  cells_ = 0;
  find_edges(beam);
  spans_over(beam, cell_m, spans_);
  const Point apex_cells = beam.T_map_sensor.position() / cell_m;
  for (const CellSpan& span : spans_) split_row(span, apex_cells);
}

void BeamPieces::find_edges(const Beam& beam) {
  edges_ = 0;
  first_bucket_ = 0;
  const int bearings = static_cast<int>(all_edges_.size());
  if (bearings == 0) return;
  const double axis = beam.T_map_sensor.theta_rad;
  first_bucket_ = bucket_of(axis - beam.half_beam_rad, bearings);
  first_edge_ = first_bucket_;
  edges_ = (bucket_of(axis + beam.half_beam_rad, bearings) - first_bucket_ + bearings) % bearings;
}

// Along a row the direction of sight turns one way only: clockwise above the apex, anticlockwise below.
void BeamPieces::split_row(const CellSpan& span, const Point& apex_cells) {
  if (edges_ == 0) return add(span.y, span.x_begin, span.x_end, first_bucket_);
  const double dy = span.y + 0.5 - apex_cells.y();
  const bool above = dy >= 0.0;
  int x = span.x_begin;
  for (int i = 0; i < edges_; ++i) {
    const int turn = above ? edges_ - 1 - i : i;
    const Edge& edge = all_edges_[static_cast<std::size_t>(first_edge_ + turn) % all_edges_.size()];
    // The edge crosses the row only on its own side of the apex; else the whole row is on one side of it.
    double cut = edge.x > 0.0 ? span.x_end : span.x_begin;
    if (edge.y * (above ? std::max(dy, 1e-9) : dy) > 0.0)
      cut = std::clamp(apex_cells.x() + dy * edge.x / edge.y - 0.5, static_cast<double>(span.x_begin),
                       static_cast<double>(span.x_end));
    const int end = static_cast<int>(std::ceil(cut));
    if (end <= x) continue;
    add(span.y, x, end, above ? edge.bucket_beyond : edge.bucket_before);
    x = end;
  }
  const Edge& last = all_edges_[static_cast<std::size_t>(first_edge_ + (above ? 0 : edges_ - 1)) % all_edges_.size()];
  add(span.y, x, span.x_end, above ? last.bucket_before : last.bucket_beyond);
}

void BeamPieces::add(int y, int x_begin, int x_end, int bucket) {
  while (x_begin < x_end) {
    const int end = std::min(x_end, (x_begin | (OccupancyGrid::kTileSide - 1)) + 1);
    pieces_.push_back({{x_begin, y}, end - x_begin, bucket});
    cells_ += end - x_begin;
    x_begin = end;
  }
}

}  // namespace cairn::muriel
