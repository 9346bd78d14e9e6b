// What goes wrong with the simulated robot, and when: faults on a schedule and by chance.
//
// The chances of each kind come from a stream of their own, so that another rate of one kind leaves the times of
// the others as they were.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/observation.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/world.hpp"
#include "plugins/simulated_robot/fault_config.hpp"
#include "plugins/simulated_robot/noise_stream.hpp"
#include "plugins/simulated_robot/surroundings/body.hpp"

namespace cairn {

class Faults {
 public:
  // Throws ConfigError when a fault names a transducer that the robot lacks, or puts it where it cannot stand.
  Faults(std::vector<FaultConfig> scheduled, const std::optional<RandomFaultsConfig>& random, const RobotModel& robot,
         const World& world, std::uint64_t seed);

  // To that time; what follows is as of then.
  void advance(double time_s);

  // Where the robot is to be put, until kidnapped() says that it has been.
  [[nodiscard]] std::optional<KidnapConfig> kidnap() const;
  void kidnapped();
  // How the robot really moves when its wheels turn for that; nothing when they do not slip.
  [[nodiscard]] std::optional<Twist> slipping(const Twist& turned) const;
  [[nodiscard]] double compass_jump_rad() const;
  // What is reported of a reading; nothing when none is reported. To be asked of every one, in their order.
  [[nodiscard]] std::optional<RangeReading> reported(RangeReading reading);
  // Whether nothing is reported at all, of no sensor.
  [[nodiscard]] bool is_silent() const {
    return std::ranges::any_of(at_work_, [](const FaultConfig& fault) { return fault.silent; });
  }

 private:
  struct PortableRandom {
    std::size_t kind;
    double per_hour;
    NoiseStream noise;
    double next_s;  // when it strikes next
    void wait();    // from next_s on
  };

  void begin(const FaultConfig& fault);
  // Nothing where the robot or the world has no place for it.
  [[nodiscard]] std::optional<FaultConfig> random_fault(std::size_t kind, NoiseStream& noise) const;
  [[nodiscard]] std::vector<double> transducers_of(RingPart part) const;
  [[nodiscard]] std::vector<double> deaf_part(NoiseStream& noise) const;
  [[nodiscard]] std::optional<KidnapConfig> free_place(NoiseStream& noise) const;

  RobotModel robot_;
  World world_;  // what stands in it
  double random_for_s_ = 0.0;
  std::vector<FaultConfig> to_come_;  // in order of time
  std::vector<FaultConfig> at_work_;
  std::vector<KidnapConfig> kidnaps_;  // that are due
  std::vector<PortableRandom> chances_;
  std::vector<std::optional<double>> last_m_;  // last reported by each transducer
};

// Why the robot cannot stand there ("(1.00, 2.00) m: it would overlap wall 2"), or nothing. Doors and movers are not
// looked at.
[[nodiscard]] std::optional<std::string> not_free(const Pose2& T_map_robot, const RobotModel& robot,
                                                  const World& world);

}  // namespace cairn
