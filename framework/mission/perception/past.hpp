// What a run has observed and where, kept for localizers that correct their past: the map is drawn anew from it.
#pragma once

#include <cstddef>
#include <vector>

#include "framework/contracts/observation.hpp"
#include "maps/pose_graph/relation_errors.hpp"

namespace cairn {

class Past {
 public:
  // observations: whether they are kept beside their stamps and poses.
  explicit Past(bool observations = false) : has_observations_(observations) {}

  void add(const Observation& observation, const Pose2& T_map_robot);
  // By what is known now; one for each.
  void correct(const std::vector<Pose2>& T_map_robot);
  // The longest way by which one of them has moved from where it was put before. There is one for each.
  [[nodiscard]] double moved_m(const std::vector<Pose2>& T_map_robot) const;

  [[nodiscard]] std::size_t size() const { return poses_.size(); }
  // With the stamps of the log, where there is one.
  [[nodiscard]] const std::vector<StampedPose>& poses() const { return poses_; }
  // What the map needs of it. Only if observations are kept.
  [[nodiscard]] Observation observation(std::size_t i) const;

 private:
  struct Scan {
    double stamp_s = 0.0;
    std::size_t readings = 0;  // index of where they were taken
    std::size_t first_range = 0;
  };

  bool has_observations_;
  std::vector<StampedPose> poses_;
  std::vector<Scan> scans_;
  std::vector<std::vector<RangeReading>> readings_;  // without their ranges; scans that differ in these only share one
  std::vector<float> ranges_m_;
};

}  // namespace cairn
