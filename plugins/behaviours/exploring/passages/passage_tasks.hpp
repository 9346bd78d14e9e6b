// Which passage exploring looks at or drives through next, and what has come of those that it has tried.
//
// Each passage is looked at from straight before it, then driven through as `goto` drives. One that the robot does not
// get through is tried once more when nothing else is left, then given up with its reason.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plugins/behaviours/exploring/explore_tasks.hpp"
#include "plugins/behaviours/lookouts/passages.hpp"

namespace cairn::behaviours {

struct NotEntered {
  Point at_m{0.0, 0.0};
  double width_m = 0.0;
  bool is_too_narrow = false;  // for the robot
  std::string why;
};
// "opening at (2.40, 4.00), 0.44 m wide: too narrow for 0.44 m"
[[nodiscard]] std::string sentence_of(const NotEntered& opening);

class PassageTasks {
 public:
  explicit PassageTasks(const PassageSettings& settings) : settings_(settings) {}

  struct Explored {
    const OccupancyGrid& grid;
    const std::vector<Pose2>& trace;
    const std::vector<Point>& looked_at;  // openings
  };
  // The next look or drive; then walls that may hide a door. None when nothing is left.
  [[nodiscard]] std::optional<ExploreTask> next(const FreeSpace& space, const Explored& explored, const Point& robot);
  void record_look(const ExploreTask& task) { suspects_ += task.is_suspect ? 1 : 0; }
  void record(const ExploreTask& task, bool has_passed, const std::string& why);
  // looked_at: what is tried once more is looked at again, too.
  [[nodiscard]] bool retry(std::vector<Point>& looked_at);
  // Given up or never tried.
  [[nodiscard]] std::vector<NotEntered> not_entered(const FreeSpace& space, const Explored& explored,
                                                    double radius_m) const;

 private:
  struct Tried {
    Point at_m{0.0, 0.0};
    int tries = 0;
    bool is_given_up = false;  // for now
    std::string why;
  };
  [[nodiscard]] const Tried* find(const Point& at_m) const;
  [[nodiscard]] std::vector<Point> given_up() const;

  PassageSettings settings_;
  std::vector<Tried> tried_;
  int suspects_ = 0;  // looked at
  bool has_retried_ = false;
};

}  // namespace cairn::behaviours
