// What observations show: where the robot is, what its surroundings look like, which landmarks are there.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "framework/landmarks/tracker.hpp"
#include "framework/mission/events.hpp"
#include "framework/mission/held_out.hpp"
#include "framework/mission/localisation/map_snapshots.hpp"
#include "framework/mission/loop/staged_modules.hpp"
#include "framework/mission/perception/past.hpp"
#include "framework/mission/perception/redraw.hpp"
#include "framework/mission/perception/sighting_motion.hpp"

namespace cairn {

// What a tick has recognised.
struct Recognition {
  std::int64_t matchings = 0;
  std::vector<Event> events;           // each matching, and what it has changed in the landmark graph
  const CoarseGrid* coarse = nullptr;  // the detector's
};

class Perception {
 public:
  // Mission and modules must outlive it.
  Perception(const Mission& mission, StagedModules& modules, const Budget& budget);

  // Goes on from what an earlier run has known. Before begin().
  void restore(const SavedMap& map);
  // The map is left alone: nothing is drawn into it, nothing recognised. Before begin(). map must outlive it. is_lost:
  // a map of its own is drawn, in the frame of a localizer that does not know the map, until settle().
  void leave_alone(const OccupancyGrid& map, LandmarkGraph graph, bool is_lost);
  // The robot has found where in that map it is: from here on by this localizer. The map's grid.
  const OccupancyGrid& settle(std::shared_ptr<Localizer> localizer);
  // Beside all else a small map is drawn by another localizer, which knows no map. Before localize(). before: what
  // lose() goes back to; it must outlive lose() or drop_own_map().
  void draw_own_map(std::shared_ptr<Localizer> localizer, std::shared_ptr<Mapper> mapper, const MapSnapshot& before);
  [[nodiscard]] bool draws_own_map() const { return own_.has_value(); }
  // By that localizer, and that map; while it is drawn.
  [[nodiscard]] const PoseEstimate& own_pose() const { return own_->pose; }
  [[nodiscard]] const OccupancyGrid& own_grid() const { return *own_->grid; }
  void drop_own_map() { own_.reset(); }
  // Once, before all below: asks the mapper for its grid. Throws ModuleFault, as all below do.
  // records_poses: whether past() holds them also when the localizer never corrects any.
  const OccupancyGrid& begin(bool records_poses = false);
  // The robot is not where it was believed to be: what was recognised since the snapshot is forgotten, and the own map
  // takes the place of the other. Its grid.
  const OccupancyGrid& lose();
  // The robot has found where it is: from here on by this localizer, and in this map. Its grid.
  const OccupancyGrid& go_on(std::shared_ptr<Localizer> localizer, std::shared_ptr<Mapper> mapper);
  // Once, then, and after go_on(): shows the detector what was mapped before; its coarse grid.
  const CoarseGrid* show_earlier_map();

  // The stages of a tick, in their order.
  // Adds the markers that are in the observation's pictures, and brings all to where the robot is now.
  void see_markers(Observation& observation);
  [[nodiscard]] PoseEstimate localize(const Observation& observation);
  // Which cells may have changed; valid until the next call. Of deaf transducers "no echo" is no news for the map.
  const CellChanges& map(const Observation& observation, const PoseEstimate& pose, std::span<const int> deaf = {});
  [[nodiscard]] Recognition recognise(const CellChanges& changes, double time_s,
                                      std::span<const MarkerSighting> markers = {});

  // Whether the localizer has corrected the past so far that the map should be drawn anew (after localize()). Until
  // that is done the map, the landmarks and poses stay in the frame that they are in.
  [[nodiscard]] bool is_map_moved() const;
  // Begins to draw the past at its corrected poses into a map that holds none of it.
  void begin_redraw(std::shared_ptr<Mapper> map);
  // After localize(), at every tick: draws a slice. With the last one the new map takes the place of the map so far,
  // the pose moves with it, and its grid is returned; the detector gets all of it the next time. Else null.
  const OccupancyGrid* redraw_slice(PoseEstimate& pose);
  // How the map moved when it was last exchanged; none: it never was.
  [[nodiscard]] const std::optional<MapMove>& last_move() const { return last_move_; }
  // After the last observation: the last corrections. Whether the map should be drawn anew.
  [[nodiscard]] bool finish();
  // All of it at once; its grid. A run that is cancelled meanwhile keeps the map that it has.
  const OccupancyGrid& redraw(std::shared_ptr<Mapper> map);
  // What that has done to the landmarks, if recognise() has not reported it; once.
  [[nodiscard]] std::vector<Event> take_moved_landmarks();
  // What the localizer knows of submaps; none from one that has none, nor while the map waits to be drawn where they
  // are.
  [[nodiscard]] KeptSubmaps submaps();
  [[nodiscard]] const Past& past() const { return past_; }
  // A localizer that corrects its past.
  [[nodiscard]] bool has_history() const { return history_ != nullptr; }

  // As they are now, for lose().
  [[nodiscard]] KnownLandmarks known_landmarks() const {
    return {tracker_.graph(), tracker_.candidates(), tracker_.driven_path()};
  }

  [[nodiscard]] LandmarkTracker& tracker() { return tracker_; }
  [[nodiscard]] const LandmarkTracker& tracker() const { return tracker_; }

 private:
  enum class MapUse { grows, left_alone, lost };
  struct Detected {
    DetectionReport report;
    const CoarseGrid* coarse = nullptr;
  };
  // A map beside the mission's, in a frame of its own.
  struct OwnMap {
    std::shared_ptr<Localizer> localizer;
    std::shared_ptr<Mapper> mapper;
    const OccupancyGrid* grid = nullptr;
    PoseEstimate pose{};
    const MapSnapshot* before = nullptr;
  };
  void check_place(const PoseEstimate& pose) const;
  void localize_in_own_map(const Observation& observation);
  [[nodiscard]] Detected detect(const CellChanges& changes, const Budget& budget);
  [[nodiscard]] double correct_past(std::size_t newer);
  void follow_corrections();
  void draw_slice();
  void exchange_maps();
  void add_events(const std::vector<LandmarkTracker::Change>& changes, std::vector<Event>& events) const;

  const MissionConfig& config_;
  StagedModules& modules_;
  const Budget budget_;
  LandmarkTracker tracker_;
  HoldOut hold_out_;
  Observation for_map_;  // without what is held out; a member for its memory only
  const OccupancyGrid* grid_ = nullptr;
  CellChanges changes_;  // when the map was drawn anew
  double last_freed_check_s_ = 0.0;
  bool begins_with_map_ = false;
  MapUse use_ = MapUse::grows;
  const OccupancyGrid* map_left_alone_ = nullptr;
  const LandmarkGraph no_landmarks_;
  std::optional<OwnMap> own_;
  CellBox forgotten_;  // where something was drawn in the map before, if there was one
  bool records_poses_ = false;
  PoseHistory* history_ = nullptr;  // the localizer's
  Past past_;
  std::vector<Pose2> corrected_;  // of the past, by the revision below
  std::uint64_t revision_ = 0;
  DrawnFrame frame_;              // of the map
  std::optional<Redraw> redraw_;  // under way
  std::optional<MapMove> last_move_;
  std::vector<LandmarkTracker::Change> moved_;  // by it, not reported yet
  std::size_t drawn_ = 0;                       // size of the past when the map was last drawn anew
  bool is_redrawn_ = false;
  SightingMotion sighting_motion_;
};

}  // namespace cairn
