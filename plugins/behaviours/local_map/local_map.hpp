// The map about the robot as a drive sees it: corrected by recent near echoes, with the places where it was blocked.
#pragma once

#include <vector>

#include "plugins/behaviours/local_map/doubts.hpp"
#include "plugins/behaviours/local_map/free_space.hpp"
#include "plugins/behaviours/local_map/optimism.hpp"
#include "plugins/behaviours/local_map/recent_echoes.hpp"
#include "plugins/behaviours/local_map/speckles.hpp"

namespace cairn::behaviours {

struct LocalMapSettings {
  double around_m = 12.0;
  double clearance_m = 0.08;
  double tight_clearance_m = 0.03;
  double escape_clearance_m = 0.1;
  double trace_apart_m = 0.1;
  int max_trace = 400;
  double around_goal_m = 1.0;
  double shut_radius_m = 0.3;
  RecentEchoSettings echoes;
  FreeSpaceSettings paths;
  SpeckleSettings speckles;
  static void describe(Fields<LocalMapSettings>& fields);
};

class LocalMap {
 public:
  explicit LocalMap(const LocalMapSettings& settings = {}) : settings_(settings), echoes_(settings.echoes) {}

  // Every tick.
  void see(const WorldView& world);
  [[nodiscard]] const NearEchoes& echoes() const { return echoes_.now(); }
  void forget_echoes(const WorldView& world) { echoes_.forget(world); }

  // Paths avoid the place until then, where they can.
  void avoid(const Point& at, double until_s) { avoided_.push_back({at, until_s}); }
  // No path that takes unknown ground to be free leads there until then.
  void shut(const Point& at, double until_s) { shut_.push_back({at, until_s}); }
  // What blocked the robot there has gone: echoes have come from behind these cells.
  void reopen(const OccupancyGrid& map, const std::vector<Cell>& seen_through);

  // Where the robot can go. goal: about it, too, unknown ground is taken to be free where that is asked for.
  [[nodiscard]] FreeSpace space(const WorldView& world, double clearance_m, Optimism optimism, const Point& goal,
                                const Doubts& doubts) const;
  // Whether something occupied that is not ignored lies within radius_m of the next ahead_m of a path.
  [[nodiscard]] bool is_blocked(const WorldView& world, const std::vector<Point>& path, double along_m, double ahead_m,
                                double radius_m) const;

  // What a plan of this optimism has taken to be free is not an obstacle on the path: only live echoes count there.
  void ignore_doubtful(Optimism optimism, const WorldView& world, const Doubts& doubts);
  // The same with all within the robot's radius, and the tight clearance, of a path.
  void ignore_along(const std::vector<Point>& path, const WorldView& world, const Doubts& doubts);
  void ignore_nothing();
  [[nodiscard]] const CellSet& ignored() const { return ignored_; }
  // Whether something that the map holds occupied is ignored within this of a place.
  [[nodiscard]] bool ignores_near(const Point& p, double within_m) const;

  [[nodiscard]] const LocalMapSettings& settings() const { return settings_; }

 private:
  [[nodiscard]] std::vector<Cell> doubtful_cells(const OccupancyGrid& map, const Doubts& doubts) const;
  void ignore(const std::vector<Cell>& cells, const WorldView& world, const Doubts& doubts);

  LocalMapSettings settings_;
  RecentEchoes echoes_;
  std::vector<Pose2> trace_;          // where the robot has been
  std::vector<TroubleSpot> avoided_;  // where it was blocked
  std::vector<TroubleSpot> shut_;     // what blocked it on a path through unknown ground: there is none
  CellSet ignored_;
  std::vector<Point> ignored_places_;  // the occupied ones
};

}  // namespace cairn::behaviours
