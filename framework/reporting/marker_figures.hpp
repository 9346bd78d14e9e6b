// How well the sightings of printed markers fit the camera's description.
//
// Wrong distortion or a wrong centre shows in the reprojection error. A wrong focal length, or a wrong size of the
// markers, does not: all distances are then wrong by the same ratio, which shows when a marker is seen from near and
// far. With p the robot's places and d the offsets at which it saw a marker, p + s d is the same place for the right s;
// least squares over all markers give s. Each visit to a marker counts by itself: between two the pose may have
// drifted, or been corrected.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/world_view.hpp"

namespace cairn {

class MarkerFigures {
 public:
  // At every tick.
  void note(const WorldView& world);

  [[nodiscard]] std::size_t sightings() const { return sightings_; }
  [[nodiscard]] std::size_t markers() const { return visits_.size(); }
  // Root mean square over all sightings.
  [[nodiscard]] double reprojection_error_px() const;
  // True distances over those seen; none: no marker was seen from places that are far enough apart.
  [[nodiscard]] std::optional<double> range_ratio() const;
  [[nodiscard]] std::string json() const;  // all of them, as the report has them
  // What is wrong with the camera's description; mostly nothing.
  [[nodiscard]] std::string warning() const;

 private:
  struct Seen {
    Point robot_m;
    Point offset_m;
  };
  struct Visit {
    double last_s = 0.0;
    std::vector<Seen> seen;
  };
  static constexpr std::size_t kMaxSeen = 500;  // of a visit
  static constexpr std::size_t kMaxVisits = 100;

  Visit* visit(const MarkerId& marker, double time_s);  // null: there have been enough

  std::map<MarkerId, std::vector<Visit>> visits_;
  std::size_t sightings_ = 0;
  double squares_px2_ = 0.0;
};

}  // namespace cairn
