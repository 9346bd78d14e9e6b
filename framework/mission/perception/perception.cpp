#include "framework/mission/perception/perception.hpp"

#include <algorithm>
#include <utility>

#include "framework/contracts/optional/pose_graph_report.hpp"
#include "framework/modules/plausibility.hpp"
#include "framework/safety/deaf_transducers.hpp"

namespace cairn {
namespace {

constexpr double kFreedCheck_s = 1.0;         // between looks at the places of all landmarks
constexpr std::size_t kRedrawAfterPart = 10;  // of the past must be new, so that drawing costs no more than its share

}  // namespace

Perception::Perception(const Mission& mission, StagedModules& modules, const Budget& budget)
    : config_(mission.config),
      modules_(modules),
      budget_(budget),
      tracker_(mission.config.landmarks, mission.robot, mission.shapes, mission.config.history.max_path_poses),
      hold_out_(mission.config.hold_out_every, mission.config.seed) {
  if (config_.markers) tracker_.expect_markers(mission.marker_categories, config_.markers->confirm_sightings);
}

void Perception::restore(const SavedMap& map) {
  tracker_.restore(map.graph, map.progress->candidates, map.driven_path);
  last_freed_check_s_ = map.progress->time_s;
  begins_with_map_ = true;
}

void Perception::leave_alone(const OccupancyGrid& map, LandmarkGraph graph, bool is_lost) {
  use_ = is_lost ? MapUse::lost : MapUse::left_alone;
  map_left_alone_ = &map;
  tracker_.restore(std::move(graph), {}, {});
}

const OccupancyGrid& Perception::settle(std::shared_ptr<Localizer> localizer) {
  modules_.localizer.replace(std::move(localizer));
  use_ = MapUse::left_alone;
  grid_ = map_left_alone_;
  return *grid_;
}

void Perception::draw_own_map(std::shared_ptr<Localizer> localizer, std::shared_ptr<Mapper> mapper,
                              const MapSnapshot& before) {
  const OccupancyGrid& grid = modules_.mapper.call([&](Mapper&) -> const OccupancyGrid& { return mapper->grid(); });
  own_ = OwnMap{std::move(localizer), std::move(mapper), &grid, {}, &before};
}

const OccupancyGrid& Perception::lose() {
  const KnownLandmarks& before = own_->before->landmarks;
  tracker_.restore(before.graph, before.candidates, before.driven_path);
  forgotten_ = grid_->bounds();
  grid_ = own_->grid;
  modules_.localizer.replace(std::move(own_->localizer));
  modules_.mapper.replace(std::move(own_->mapper));
  drop_own_map();
  use_ = MapUse::lost;
  begins_with_map_ = true;
  history_ = nullptr;
  frame_ = {};
  redraw_.reset();
  return *grid_;
}

const OccupancyGrid& Perception::go_on(std::shared_ptr<Localizer> localizer, std::shared_ptr<Mapper> mapper) {
  modules_.localizer.replace(std::move(localizer));
  modules_.mapper.replace(std::move(mapper));
  use_ = MapUse::grows;
  drawn_ = 0;
  revision_ = 0;
  return begin(records_poses_);
}

// Where no grid can hold what is seen there, it is the localizer that is wrong, and not the mapper.
void Perception::check_place(const PoseEstimate& pose) const {
  constexpr double kOfGrid = 0.98;  // the rest is for what is seen from there
  const double max_m = std::min(kMaxPlace_m, kOfGrid * OccupancyGrid::kLargestCellIndex * grid_->cell_m());
  if (const std::string fault = fault_of(pose, max_m); !fault.empty()) throw modules_.localizer.fault(fault);
}

void Perception::localize_in_own_map(const Observation& observation) {
  const KnownMap known{*own_->grid, no_landmarks_};
  own_->pose = modules_.localizer.call([&](Localizer&) { return own_->localizer->update(observation, known); });
  check_place(own_->pose);
}

const OccupancyGrid& Perception::begin(bool records_poses) {
  if (use_ == MapUse::grows)
    history_ = modules_.localizer.call([](Localizer& localizer) { return localizer.history(); });
  records_poses_ = records_poses || history_ != nullptr;
  past_ = Past(history_ != nullptr);
  grid_ = &modules_.mapper.call([](Mapper& mapper) -> const OccupancyGrid& { return mapper.grid(); });
  if (use_ == MapUse::left_alone) grid_ = map_left_alone_;
  return *grid_;
}

// It is no change: a budget that allows no matching keeps old evidence from counting twice.
const CoarseGrid* Perception::show_earlier_map() {
  if (!begins_with_map_ || !modules_.detector || grid_->bounds().empty()) return nullptr;
  const std::atomic<bool> cancelled = true;
  Budget nothing;
  nothing.cancel = &cancelled;
  return detect(everything_in(united(grid_->bounds(), forgotten_)), nothing).coarse;
}

void Perception::see_markers(Observation& observation) {
  for (const MarkerSighting& sighting : observation.markers)
    if (const std::string fault = fault_of(sighting); !fault.empty()) throw modules_.sensor.fault(fault);
  sighting_motion_.add(observation.stamp_s, observation.T_odom_robot);
  if (modules_.marker_detector && !observation.images.empty()) {
    const std::vector<MarkerSighting> seen = modules_.marker_detector.call(
        [&](MarkerDetector& detector) { return detector.detect(observation.images, budget_); });
    for (const MarkerSighting& sighting : seen)
      if (const std::string fault = fault_of(sighting); !fault.empty()) throw modules_.marker_detector.fault(fault);
    observation.markers.insert(observation.markers.end(), seen.begin(), seen.end());
  }
  for (MarkerSighting& sighting : observation.markers) sighting_motion_.bring_to_now(sighting);
}

PoseEstimate Perception::localize(const Observation& observation) {
  const KnownMap known{*grid_, use_ == MapUse::lost ? no_landmarks_ : tracker_.graph()};
  PoseEstimate pose =
      modules_.localizer.call([&](Localizer& localizer) { return localizer.update(observation, known); });
  check_place(pose);
  follow_corrections();
  pose = moved(frame_.T_drawn_map(), pose);
  if (own_) localize_in_own_map(observation);
  pose.trust = use_ == MapUse::lost ? PoseTrust::lost : PoseTrust::tracking;
  return pose;
}

const CellChanges& Perception::map(const Observation& observation, const PoseEstimate& pose,
                                   std::span<const int> deaf) {
  if (use_ != MapUse::lost) tracker_.record_pose(pose);
  const auto is_unheard = [&](const RangeReading& reading) {
    return is_no_echo(reading) && std::ranges::binary_search(deaf, reading.sensor);
  };
  const bool all = config_.hold_out_every == 0 && deaf.empty();
  if (!all) {
    for_map_ = observation;
    if (config_.hold_out_every > 0)
      std::erase_if(for_map_.ranges, [&](const RangeReading&) { return hold_out_.next(); });
    std::erase_if(for_map_.ranges, is_unheard);
  }
  const Observation& seen = all ? observation : for_map_;
  if (own_) modules_.mapper.call([&](Mapper&) { own_->mapper->integrate(seen, own_->pose); });
  if (records_poses_ && use_ != MapUse::lost) past_.add(seen, pose.T_map_robot);
  if (redraw_) redraw_->add(redraw_->frame().T_drawn_map() * inverse(frame_.T_drawn_map()) * pose.T_map_robot);
  if (use_ == MapUse::left_alone) {
    changes_ = {};
    return changes_;
  }
  const CellChanges& changes =
      modules_.mapper.call([&](Mapper& mapper) -> const CellChanges& { return mapper.integrate(seen, pose); });
  if (!is_redrawn_) return changes;
  is_redrawn_ = false;
  changes_ = everything_in(united(grid_->bounds(), forgotten_));
  return changes_;
}

// How far a pose of the past has moved from where it was drawn. newer: observations that are not in the past yet.
double Perception::correct_past(std::size_t newer) {
  revision_ = modules_.localizer.call([&](Localizer&) { return history_->revision(); });
  std::vector<Pose2> poses = modules_.localizer.call([&](Localizer&) { return history_->poses(); });
  // Before the past: an observation that the map of a run that goes on held already.
  const std::size_t end = poses.size() - std::min(newer, poses.size());
  if (end < past_.size() || !std::ranges::all_of(poses, [](const Pose2& pose) { return is_finite(pose); }))
    throw modules_.localizer.fault("its history has too few poses, or one that is not finite");
  const auto last = poses.begin() + static_cast<std::ptrdiff_t>(end);
  corrected_.assign(last - static_cast<std::ptrdiff_t>(past_.size()), last);
  return past_.moved_m(corrected_);
}

// The map keeps its frame until it is drawn anew, and what is drawn meanwhile keeps its own.
void Perception::follow_corrections() {
  if (history_ == nullptr || past_.size() == 0) return;
  if (modules_.localizer.call([&](Localizer&) { return history_->revision(); }) == revision_) return;
  const double moved_m = correct_past(1);
  frame_.correct(moved_m, past_.poses().back().T_map_robot, corrected_.back());
  if (redraw_) redraw_->correct(corrected_);
}

bool Perception::is_map_moved() const {
  return frame_.is_outdated() && !redraw_ && past_.size() >= drawn_ + drawn_ / kRedrawAfterPart;
}

void Perception::begin_redraw(std::shared_ptr<Mapper> map) {
  // Observations since the correction.
  for (std::size_t i = corrected_.size(); i < past_.size(); ++i)
    corrected_.push_back(inverse(frame_.T_drawn_map()) * past_.poses()[i].T_map_robot);
  redraw_.emplace(std::move(map), grid_->cell_m(), corrected_);
}

void Perception::draw_slice() {
  redraw_->draw_slice(past_, [&](Mapper& map, const Observation& seen, const PoseEstimate& pose) {
    modules_.mapper.call([&](Mapper&) { map.integrate(seen, pose); });
  });
}

void Perception::exchange_maps() {
  forgotten_ = grid_->bounds();  // before its mapper goes
  modules_.mapper.replace(redraw_->map());
  grid_ = &modules_.mapper.call([](Mapper& mapper) -> const OccupancyGrid& { return mapper.grid(); });
  std::vector<Pose2> before;
  before.reserve(past_.size());
  for (const StampedPose& pose : past_.poses()) before.push_back(pose.T_map_robot);
  last_move_.emplace(std::move(before), redraw_->T_map_robot());
  moved_ = tracker_.move(*last_move_);
  past_.correct(redraw_->T_map_robot());
  frame_ = redraw_->frame();
  redraw_.reset();
  drawn_ = past_.size();
  is_redrawn_ = true;
}

const OccupancyGrid* Perception::redraw_slice(PoseEstimate& pose) {
  if (!redraw_) return nullptr;
  draw_slice();
  if (!redraw_->is_done()) return nullptr;
  pose = moved(redraw_->frame().T_drawn_map() * inverse(frame_.T_drawn_map()), pose);
  exchange_maps();
  return grid_;
}

bool Perception::finish() {
  if (history_ == nullptr || past_.size() == 0) return false;
  while (!budget_.cancelled() && modules_.localizer.call([&](Localizer&) { return history_->finish_part(); })) {
  }
  const double moved_m = correct_past(0);
  frame_.correct(moved_m, past_.poses().back().T_map_robot, corrected_.back());
  return moved_m > 0.0;
}

KeptSubmaps Perception::submaps() {
  const auto* const report = dynamic_cast<const PoseGraphReport*>(history_);
  if (report == nullptr || frame_.is_outdated()) return {};
  KeptSubmaps submaps = modules_.localizer.call([&](Localizer&) { return report->submaps(); });
  keep_latest(submaps);
  return submaps;
}

const OccupancyGrid& Perception::redraw(std::shared_ptr<Mapper> map) {
  redraw_.emplace(std::move(map), grid_->cell_m(), corrected_);
  while (!redraw_->is_done() && !budget_.cancelled()) draw_slice();
  if (redraw_->is_done()) exchange_maps();
  redraw_.reset();
  return *grid_;
}

std::vector<Event> Perception::take_moved_landmarks() {
  std::vector<Event> events;
  add_events(std::exchange(moved_, {}), events);
  return events;
}

Perception::Detected Perception::detect(const CellChanges& changes, const Budget& budget) {
  Detected detected = modules_.detector.call([&](Detector& detector) -> Detected {
    DetectionReport report = detector.detect(*grid_, changes, budget);
    return {std::move(report), detector.coarse_grid()};
  });
  for (const Matching& matching : detected.report.matchings)
    if (const std::string fault = fault_of(matching, *grid_); !fault.empty()) throw modules_.detector.fault(fault);
  return detected;
}

Recognition Perception::recognise(const CellChanges& changes, double time_s, std::span<const MarkerSighting> markers) {
  Recognition recognised;
  if (use_ == MapUse::lost) return recognised;
  add_events(std::exchange(moved_, {}), recognised.events);
  if (config_.markers && use_ == MapUse::grows) add_events(tracker_.update(markers), recognised.events);
  if (!modules_.detector) return recognised;
  auto [report, coarse] = detect(changes, budget_);
  recognised.coarse = coarse;
  recognised.matchings = std::ssize(report.matchings);
  for (Matching& matching : report.matchings) {
    const std::vector<LandmarkTracker::Change> changed = tracker_.update(matching);
    recognised.events.emplace_back(MatchingDone{std::move(matching)});
    add_events(changed, recognised.events);
  }
  if (time_s < last_freed_check_s_ + kFreedCheck_s) return recognised;
  last_freed_check_s_ = time_s;
  add_events(tracker_.retire_freed(*grid_), recognised.events);
  return recognised;
}

void Perception::add_events(const std::vector<LandmarkTracker::Change>& changes, std::vector<Event>& events) const {
  for (const auto& [id, kind] : changes) {
    if (kind == LandmarkTracker::ChangeKind::retired) {
      const RetiredLandmark& retired = tracker_.graph().retired().at(id);
      events.emplace_back(LandmarkRetired{retired.landmark, retired.reason});
    } else {
      events.emplace_back(LandmarkChanged{*tracker_.graph().find(id), kind == LandmarkTracker::ChangeKind::found});
    }
  }
}

}  // namespace cairn
