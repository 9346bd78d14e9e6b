// The simple steps of a mission: drive to given points, wait, save.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/behaviour.hpp"
#include "plugins/behaviours/following/direct_follower.hpp"

namespace cairn::behaviours {

struct DriveConfig {
  std::vector<Point> points_m;
  double speed_mps = 0.2;
  double tolerance_m = 0.05;
  double patience_s = 10.0;
  double scatter_m = 0.0;
  double stop_at_corner_rad = radians(35.0);

  static void describe(Fields<DriveConfig>& fields);
};

// Drives straight from point to point, whatever the map says; only the collision monitor stops it.
class DriveTo : public Behaviour {
 public:
  // The seed decides where scattered points go.
  DriveTo(const DriveConfig& config, std::uint64_t seed);
  Status tick(const WorldView& world, BehaviourContext& context) override;
  void halt() override;

 private:
  void begin_stretch(const Point& from);
  [[nodiscard]] double left_s(const ControlResult& step, const RobotModel& robot) const;

  DriveConfig config_;
  std::uint64_t seed_;
  std::vector<Point> points_m_;  // the configured ones, scattered
  std::size_t next_ = 0;         // the first point of the next stretch
  bool begun_ = false;
  DirectFollower stretch_;  // points that are driven through without stopping to turn
};

struct WaitConfig {
  double for_s = 1.0;
  static void describe(Fields<WaitConfig>& fields);
};

class Wait : public Behaviour {
 public:
  explicit Wait(const WaitConfig& config) : config_(config) {}
  Status tick(const WorldView& world, BehaviourContext& context) override;
  void halt() override { begun_s_.reset(); }
  [[nodiscard]] bool needs_pose() const override { return false; }

 private:
  WaitConfig config_;
  std::optional<double> begun_s_;
};

struct SaveConfig {
  ConfigValue file;  // text: a name without folders
  static void describe(Fields<SaveConfig>& fields);
};

class Save : public Behaviour {
 public:
  // Throws ConfigError on anything but a plain file name.
  explicit Save(const SaveConfig& config);
  Status tick(const WorldView& world, BehaviourContext& context) override;
  void halt() override {}

 private:
  std::string file_name_;
};

}  // namespace cairn::behaviours
