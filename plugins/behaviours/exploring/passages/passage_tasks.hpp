// Which passage exploring looks at or drives through next, and what has come of those that it has tried.
//
// Each passage is looked at from straight before it, and its width is what was heard in that look. Where the robot may
// fit it drives through at once. One that it does not get through, or that is heard to be too narrow, is tried once
// more when nothing else is left, looked at from nearer, then given up with its reason: a look that has heard nothing
// from behind an opening is no proof that it is closed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "maps/geometry/map_move.hpp"
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
  PassageTasks(const PassageSettings& settings, const PassageDriveSettings& drive)
      : settings_(settings), drive_(drive) {}

  // space: as the robot moves in it. map: what passages are searched in, of the same cells, without the walls that
  // echoes have passed. passed: log-odds below 0 where echoes have passed.
  struct Explored {
    const FreeSpace& space;
    const FreeSpace& map;
    const OccupancyGrid& passed;
    const std::vector<Pose2>& trace;
    double radius_m = 0.2;  // of the robot
  };
  // The next passage to look at, or one that was looked at and not driven through yet; then walls that may hide a door.
  // None when nothing is left. Its path is empty where none leads to its lookout with the space's clearance.
  [[nodiscard]] std::optional<ExploreTask> next(const Explored& explored, const Point& robot);
  // That the robot cannot get to where it would look, or line up; until it has passed another passage, or tries all
  // once more.
  void record_unreachable(const ExploreTask& task);
  // How much echoes have shown behind walls that were not looked at.
  [[nodiscard]] double suspected_m2(const Explored& explored) const;
  // What was looked at and is too narrow.
  [[nodiscard]] std::vector<Point> closed() const {
    return places_where([](const Tried& t) { return t.is_too_narrow && t.is_given_up; });
  }
  // What a look has shown. The drive through it, where the robot may fit.
  [[nodiscard]] std::optional<ExploreTask> record_look(const ExploreTask& task, const HeardOpening& heard,
                                                       double radius_m);
  // What has come of the drive.
  void record(const ExploreTask& task, bool has_passed, const std::string& why);
  // The drive back, or there again, through the first passage on a path that the robot has passed before.
  [[nodiscard]] std::optional<ExploreTask> passed_on(const std::vector<Point>& path, double radius_m) const;
  // False when there is none to try once more; what is tried once more is looked at again, too.
  [[nodiscard]] bool retry();
  // The map has been exchanged.
  void move(const MapMove& move);
  // Given up or never tried.
  [[nodiscard]] std::vector<NotEntered> not_entered(const Explored& explored) const;

 private:
  struct Tried {
    Point at_m{0.0, 0.0};
    std::optional<HeardOpening> heard;  // when it was looked at last, or before where that was wider
    std::optional<HeardOpening> heard_before;
    int tries = 0;
    int passes = 0;
    int failures = 0;         // in a row
    bool is_suspect = false;  // a wall that may hide a door
    bool is_too_narrow = false;
    bool is_unreachable = false;
    bool is_given_up = false;  // for now
    bool was_passed = false;
    std::string why;
  };
  [[nodiscard]] const Tried* find(const Point& at_m) const;
  // The nearest that was given up, a little farther off: what closes a gap closes the ones beside it.
  [[nodiscard]] const Tried* given_up_beside(const Point& at_m) const;
  void forget_unreachable();
  static void look_again(Tried& tried);
  [[nodiscard]] bool is_worth_daring(const HeardOpening& heard, double radius_m) const;
  [[nodiscard]] std::optional<ExploreTask> next_dare(const Explored& explored);
  static void dare_beside(Tried& tried);
  [[nodiscard]] Tried& at(const Point& at_m);
  [[nodiscard]] std::vector<Point> looked_at() const {
    return places_where([](const Tried& t) { return t.is_given_up || t.heard; });
  }
  [[nodiscard]] std::vector<Point> places_where(bool (*is_so)(const Tried&)) const;
  [[nodiscard]] ExploreTask drive_through(const HeardOpening& heard, double radius_m) const;

  PassageSettings settings_;
  PassageDriveSettings drive_;
  std::vector<Tried> tried_;
  int suspects_ = 0;  // looked at
  bool has_retried_ = false;
};

}  // namespace cairn::behaviours
