// What the robot perceives, from modules of which a test knows what they answer.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "framework/contracts/optional/pose_graph_report.hpp"
#include "framework/mission/perception/perception.hpp"
#include "tests/framework/mission/still_modules.hpp"

namespace cairn {

class OffsetLocalizer : public Localizer {
 public:
  PoseEstimate update(const Observation& observation, const KnownMap& known) override {
    readings += observation.ranges.size();
    landmarks_known = known.landmarks.landmarks().size();
    PoseEstimate pose;
    pose.T_map_robot = {observation.T_odom_robot.x_m + offset_m, 0.0, 0.0};
    return pose;
  }
  double offset_m = 1.0;
  std::size_t readings = 0;
  std::size_t landmarks_known = 0;
};

// Finds out at some time that all poses so far were off by so much.
class CorrectingLocalizer : public OffsetLocalizer, public PoseHistory, public PoseGraphReport {
 public:
  PoseEstimate update(const Observation& observation, const KnownMap& known) override {
    PoseEstimate pose = OffsetLocalizer::update(observation, known);
    pose.T_map_robot.x_m += corrected_m_;
    poses_.push_back(pose.T_map_robot);
    return pose;
  }
  PoseHistory* history() override { return this; }
  void correct(double by_m) {
    for (Pose2& pose : poses_) pose.x_m += by_m;
    corrected_m_ += by_m;
    ++revision_;
  }
  [[nodiscard]] std::vector<Pose2> poses() const override { return poses_; }
  [[nodiscard]] std::uint64_t revision() const override { return revision_; }
  [[nodiscard]] KeptSubmaps submaps() const override {
    KeptSubmaps submaps;
    for (const Pose2& pose : poses_) submaps.nodes.push_back({std::ssize(submaps.nodes), 0.0, pose});
    return submaps;
  }
  bool finish_part() override {
    if (parts_left == 0) return false;
    if (--parts_left == 0) correct(0.02);
    return true;
  }
  int parts_left = 3;

 private:
  std::vector<Pose2> poses_;
  std::uint64_t revision_ = 0;
  double corrected_m_ = 0.0;
};

class CountingMapper : public Mapper {
 public:
  CountingMapper() { grid_.set_log_odds({3, 3}, 500); }
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override {
    readings += observation.ranges.size();
    at = pose.T_map_robot;
    return changes_;
  }
  [[nodiscard]] const OccupancyGrid& grid() const override { return grid_; }
  std::size_t readings = 0;
  Pose2 at;

 private:
  OccupancyGrid grid_{0.1};
  CellChanges changes_;
};

class ScriptedDetector : public Detector {
 public:
  DetectionReport detect(const OccupancyGrid&, const CellChanges&, const Budget& budget) override {
    if (budget.cancelled()) {
      ++shown;
      return {};
    }
    return std::exchange(next, {});
  }
  DetectionReport next;
  int shown = 0;
};

// Tag 7 hangs 4 m ahead of where the odometry begins. Each picture shows it from where the robot was then.
class TagSevenDetector : public MarkerDetector {
 public:
  std::vector<MarkerSighting> detect(std::span<const CameraImage> images, const Budget&) override {
    std::vector<MarkerSighting> sightings;
    for (const CameraImage& image : images) {
      MarkerSighting& sighting = sightings.emplace_back();
      sighting.marker.number = 7;
      sighting.stamp_s = image.stamp_s + stamps_late_s;
      sighting.pose.T_robot_marker = inverse(odometry_at(image.stamp_s)) * Pose2{4.0, 0.5, radians(180.0)};
      sighting.pose.covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-3).asDiagonal();
    }
    return sightings;
  }
  static Pose2 odometry_at(double stamp_s) { return {0.5 * stamp_s, 0.0, 0.0}; }
  double stamps_late_s = 0.0;
};

inline Matching square_at(double x_m) {
  Matching matching;
  matching.degrees = {{"square", 0.9, 0.0, {x_m, 1.0}}};
  matching.detection = Detection{"square", {x_m, 1.0, 0.0}, 0.9, {}};
  return matching;
}

class PerceptionTest : public testing::Test {
 protected:
  PerceptionTest() {
    mission_.steps.clear();
    built_.localizer = localizer_;
    built_.mapper = mapper_;
    built_.detector = detector_;
  }
  Perception& perception() {
    if (!perception_) {
      modules_ = std::make_unique<StagedModules>(built_, mission_, std::make_shared<SteadyClock>());
      perception_ = std::make_unique<Perception>(mission_, *modules_, Budget{.cancel = &is_cancelled_});
    }
    return *perception_;
  }
  static Observation observation(std::size_t readings, double x_m = 0.0) {
    Observation seen;
    seen.T_odom_robot = {x_m, 0.0, 0.0};
    seen.ranges.resize(readings, still::nothing_ahead());
    return seen;
  }
  static std::vector<std::size_t> kinds_of(const Recognition& recognised) {
    std::vector<std::size_t> kinds;
    for (const Event& event : recognised.events) kinds.push_back(event.index());
    return kinds;
  }

  Mission mission_ = still::mission(10);
  MissionModules built_;
  const std::shared_ptr<OffsetLocalizer> localizer_ = std::make_shared<OffsetLocalizer>();
  const std::shared_ptr<CountingMapper> mapper_ = std::make_shared<CountingMapper>();
  const std::shared_ptr<ScriptedDetector> detector_ = std::make_shared<ScriptedDetector>();
  std::atomic<bool> is_cancelled_ = false;
  std::unique_ptr<StagedModules> modules_;
  std::unique_ptr<Perception> perception_;
};

}  // namespace cairn
