// Chooses what exploring does next, on the map as the robot itself has seen it.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "plugins/behaviours/exploring/explore.hpp"
#include "plugins/behaviours/exploring/explore_tasks.hpp"
#include "plugins/behaviours/exploring/passages/passage_tasks.hpp"
#include "plugins/behaviours/local_map/near_echoes.hpp"

namespace cairn::behaviours {

class TaskChooser {
 public:
  TaskChooser(const ExploreConfig& config, const WorldView& world);

  // Something else has driven the robot to where it is now.
  void begin_here(const WorldView& world);
  // Before begin_here(): the map has been exchanged. What is remembered moves along, echoes aside; null: all of it is
  // forgotten.
  void begin_in_new_map(const WorldView& world, const MapMove* move);
  // Every tick.
  void see(const WorldView& world);
  void forget_echoes(const WorldView& world);
  // A look into an opening: at its beginning, every tick of it, and at its end. At the end: the drive through it, where
  // the robot may fit and there is no path with the usual room.
  void begin_look(const WorldView& world, const Point& opening);
  void look_through(const WorldView& world, const Point& opening);
  [[nodiscard]] std::optional<ExploreTask> end_look(const ExploreTask& task, const WorldView& world);
  // What that look, or the last one, has heard.
  [[nodiscard]] HeardOpening heard() const { return opening_echoes_.heard(); }
  [[nodiscard]] const NearEchoes& near_echoes() const { return near_echoes_; }

  // The cheapest task; none when nothing in reach is left. before: what the robot is at, preferred when nearly as good.
  [[nodiscard]] std::optional<ExploreTask> choose(const WorldView& world, const std::optional<ExploreTask>& before);
  // Not to be chosen again: what the task has from its lookout.
  void give_up(const ExploreTask& task, const WorldView& world);
  // Paths avoid the place until then, where they can.
  void avoid(const Point& at, double until_s) { memory_.troubles.push_back({at, until_s}); }

  // A drive through a passage begins, and what has come of it.
  void begin_passage() { is_in_passage_ = true; }
  void record_passage(const ExploreTask& task, bool has_passed, const std::string& why) {
    is_in_passage_ = false;
    if (task.kind == TaskKind::passage) passages_.record(task, has_passed, why);
  }
  // Passages that were given up are tried once more, from where the robot is now. False when there are none.
  [[nodiscard]] bool retry_passages() { return passages_.retry(); }
  // Those that still lead to what is unknown, or to where the robot has not been.
  [[nodiscard]] std::vector<NotEntered> not_entered(const WorldView& world) const;

  // Once more, at the end.
  void settle_known(const WorldView& world) {
    count_known(world);
    known_.settle();
  }
  // Of what can be reached; counted anew when the next task is chosen, every few seconds.
  [[nodiscard]] double known_ratio() const { return known_.ratio(); }
  // Never when all is asked for: the share counts only doors that the map shows.
  [[nodiscard]] bool is_enough_known() const {
    return config_.until_known_ratio < 1.0 && known_ratio() >= config_.until_known_ratio;
  }

  // Whether something has turned up on a path that keeps as much room as the last task's.
  [[nodiscard]] bool is_blocked(const WorldView& world, const std::vector<Point>& path, double along_m) const;
  // Noise can wall the robot in where it just came through: it cannot go back to where it has been.
  [[nodiscard]] bool is_shut_in(const WorldView& world) const;
  // Where the robot can go, as for the last choice. Valid until the next tick.
  [[nodiscard]] const FreeSpace& space(const WorldView& world) const { return space_within(search_, world); }
  // Back along the trace, for some metre. None: the robot has not come so far.
  [[nodiscard]] std::optional<ExploreTask> way_back(const WorldView& world) const;
  // As openings.hpp.
  [[nodiscard]] std::optional<Point> room_out_of_reach(const WorldView& world, const std::vector<Point>& done) const;

 private:
  // Which part of the map is searched, and how much room is kept.
  struct Search {
    double within_m = 8.0;
    double clearance_m = 0.1;
  };
  // The part of the map that is searched; may reach beyond the map.
  [[nodiscard]] static CellBox window_of(const Search& search, const WorldView& world);
  // Made once a tick: one choice asks for the same part several times.
  [[nodiscard]] const FreeSpace& space_within(const Search& search, const WorldView& world) const;
  [[nodiscard]] FreeSpace new_space(const Search& search, const WorldView& world) const;
  [[nodiscard]] std::optional<ExploreTask> choose_within(const Search& search, const WorldView& world,
                                                         const std::optional<ExploreTask>& before);
  [[nodiscard]] std::optional<ExploreTask> choose_again(const WorldView& world,
                                                        const std::optional<ExploreTask>& before);
  [[nodiscard]] std::optional<ExploreTask> choose_opening(const WorldView& world);
  // Walls that were seen from afar only: they may hide doors.
  [[nodiscard]] std::optional<ExploreTask> choose_far_edge(const WorldView& world,
                                                           const std::optional<ExploreTask>& before);
  // What the robot can reach, and how much of it is known by now.
  void count_known(const WorldView& world);
  [[nodiscard]] std::optional<ExploreTask> choose_passage(const WorldView& world);
  [[nodiscard]] FreeSpace space_behind_walls(const WorldView& world, double clearance_m) const;
  // The drive to a passage that the robot has come through before, on the way to a place behind it.
  [[nodiscard]] std::optional<ExploreTask> back_through_passage(const Point& to, const WorldView& world);
  // With the least room there is a path with; empty: there is none.
  [[nodiscard]] std::vector<Point> path_as_before(const Point& to, const WorldView& world);
  [[nodiscard]] double slim_clearance_m(const RobotModel& robot) const;
  // The same to what is left behind it.
  [[nodiscard]] std::optional<ExploreTask> choose_behind_passages(const WorldView& world,
                                                                  const std::optional<ExploreTask>& before);
  // Whether keeping less room gets the robot to more of the map.
  [[nodiscard]] bool leads_on(const WorldView& world, const Search& tight) const;

  ExploreConfig config_;
  mutable std::map<std::pair<double, double>, FreeSpace> spaces_;  // of this tick, by part and clearance
  TaskSettings settings_;
  Search search_;  // of the last choice
  NearEchoes near_echoes_;
  NearEchoes passed_;  // what echoes from near and far have passed
  OpeningEchoes opening_echoes_;
  bool is_in_passage_ = false;
  ExploreMemory memory_;
  PassageTasks passages_;
  KnownShare known_;
};

}  // namespace cairn::behaviours
