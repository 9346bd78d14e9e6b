// A path and how far the robot has come along it: what the mission's controller is asked about in each tick.
#pragma once

#include <utility>
#include <vector>

#include "framework/contracts/controller.hpp"

namespace cairn::behaviours {

class FollowedPath {
 public:
  // From its beginning. A turn in place that is under way goes on.
  void take(std::vector<Point> points) {
    points_ = std::move(points);
    progress_ = {0.0, progress_.turning};
    is_new_ = true;
  }
  // As take(), standing still.
  void begin(std::vector<Point> points) {
    progress_ = {};
    take(std::move(points));
  }

  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  [[nodiscard]] std::vector<Point>& points() { return points_; }
  [[nodiscard]] bool empty() const { return points_.empty(); }
  [[nodiscard]] double along_m() const { return progress_.along_m; }

  // What the controller is asked; the points must outlive it.
  [[nodiscard]] ControlRequest request() const {
    ControlRequest request;
    request.path = points_;
    request.is_new_path = is_new_;
    request.progress = progress_;
    return request;
  }
  void record(const ControlResult& result) {
    progress_ = result.progress;
    is_new_ = false;
  }

 private:
  std::vector<Point> points_;
  PathProgress progress_;
  bool is_new_ = true;
};

}  // namespace cairn::behaviours
