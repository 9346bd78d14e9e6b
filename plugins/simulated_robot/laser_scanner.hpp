// The robot's laser scanners: when each one scans, and what its beams read with their errors.
//
// Light is thin, straight and answered by every surface: no lobes, no mirrors, no crosstalk. A beam reads the first
// face on its way, up to the laser's own noise, or nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/contracts/observation.hpp"
#include "framework/contracts/robot_model.hpp"
#include "plugins/simulated_robot/noise_stream.hpp"
#include "plugins/simulated_robot/surroundings/scene.hpp"

namespace cairn {

// The time between observations of a robot that has lasers but no sonars: the fastest laser's period in equal parts,
// none longer than tick_s, so that every scan comes when it is due.
[[nodiscard]] double laser_tick_s(const RobotModel& robot, double tick_s);

class LaserScanners {
 public:
  // The scene must outlive the object.
  LaserScanners(const RobotModel& robot, const Scene& scene, std::uint64_t seed);

  // Adds the scans that are due after before_s and by now_s; they are numbered after the sonars.
  void scan(const Pose2& T_map_robot, double before_s, double now_s, std::vector<RangeReading>& readings);
  [[nodiscard]] bool is_empty() const { return scanners_.empty(); }

 private:
  struct Scanner {
    LaserModel model;
    int first_beam = 0;
    std::vector<Pose2> T_robot_beam;
    NoiseStream noise;
  };
  void scan(Scanner& scanner, const Pose2& T_map_robot, std::vector<RangeReading>& readings);

  const Scene& scene_;
  std::vector<Scanner> scanners_;
  std::vector<double> distances_m_;  // of one scan; kept for its memory
};

}  // namespace cairn
