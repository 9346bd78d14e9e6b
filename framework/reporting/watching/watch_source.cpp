#include "framework/reporting/watching/watch_source.hpp"

#include <algorithm>
#include <limits>

#include "framework/reporting/event_sentences.hpp"
#include "framework/reporting/plan_end.hpp"

namespace cairn {
namespace {

constexpr double kTimesEvery_s = 1.0;
constexpr double kClustersEvery_s = 1.0;

template <class Item>
std::vector<Item> evenly_chosen(const std::vector<Item>& items, std::size_t max) {
  if (items.size() <= max) return items;
  const std::size_t every = (items.size() + max - 1) / max;
  std::vector<Item> chosen;
  for (std::size_t i = 0; i < items.size(); i += every) chosen.push_back(items[i]);
  return chosen;
}

}  // namespace

void WatchSource::on(const Event& event, const MissionView& view) {
  if (std::holds_alternative<TickDone>(event)) ++tick_;
  if (std::holds_alternative<Paused>(event)) is_paused_ = true;
  if (std::holds_alternative<Resumed>(event)) is_paused_ = false;
  if (attached_.load(std::memory_order_relaxed) == 0) return stop_watching();
  const Map map{view.world.grid, view.world.graph};
  if (!is_watched_ || &map.grid != grid_) note_all(map);
  note(event, view);
  if (waiting_.load(std::memory_order_relaxed) > 0) serve(view);
}

void WatchSource::stop_watching() {
  if (!is_watched_) return;
  is_watched_ = false;
  tiles_.clear();
  landmarks_.clear();
  routes_.reset();
  clusters_.reset();
  plan_.reset();
  ranges_.clear();
  lines_begin_ += lines_.size();
  lines_.clear();
}

void WatchSource::note(const Event& event, const MissionView& view) {
  if (plan_ && (plan_->result.path.empty() || is_end_of_plan(event, view.world, plan_->result.path.back().position())))
    plan_.reset();
  if (const auto* const tick = std::get_if<TickDone>(&event)) {
    if (tick->changes != nullptr) note_tiles(*tick->changes);
    return ranges_.note(view.world);
  }
  if (const auto* const change = std::get_if<LandmarkChanged>(&event)) landmarks_.mark(change->landmark.id);
  if (const auto* const retired = std::get_if<LandmarkRetired>(&event)) landmarks_.mark(retired->landmark.id);
  note_plan(event, view.world.time_s);
  std::string sentence = sentence_of(event);
  if (sentence.empty()) return;
  lines_.push_back({view.world.time_s, std::move(sentence)});
  if (lines_.size() <= kMaxWatchedLines) return;
  lines_.pop_front();
  ++lines_begin_;
}

// The path that a behaviour follows is shown where no planner's is under way.
void WatchSource::note_plan(const Event& event, double time_s) {
  if (const auto* const plan = std::get_if<PlanDone>(&event)) {
    plan_ = std::make_shared<WatchPlan>(WatchPlan{time_s, plan->result});
    is_from_planner_ = true;
  }
  const auto* const started = std::get_if<PathStarted>(&event);
  if (started == nullptr || (plan_ && is_from_planner_)) return;
  PlanResult result;
  result.outcome = PlanOutcome::solved;
  for (std::size_t i = 0; i < started->path.size(); ++i) {
    const Point& at = started->path[i];
    if (i > 0) result.length_m += (at - started->path[i - 1]).norm();
    result.path.push_back({at.x(), at.y(), 0.0});
  }
  plan_ = std::make_shared<WatchPlan>(WatchPlan{time_s, std::move(result)});
  is_from_planner_ = false;
}

void WatchSource::note_tiles(const CellChanges& changes) {
  for (const Cell& tile : tiles_touched(changes)) tiles_.mark(tile);
}

// Another map than before, or one that was not watched.
void WatchSource::note_all(const Map& map) {
  is_watched_ = true;
  ++epoch_;
  grid_ = &map.grid;
  tiles_.clear();
  landmarks_.clear();
  routes_.reset();
  clusters_.reset();
  next_clusters_s_ = 0.0;
  for (const Cell& tile : tiles_written(*grid_)) tiles_.mark(tile);
  for (const auto& [id, landmark] : map.graph.landmarks()) landmarks_.mark(id);
}

// A graph has no stamp: routes come and go with their number, and close in it.
void WatchSource::note_routes(const LandmarkGraph& graph) {
  const auto is_same = [&] {
    if (!routes_ || routes_->size() != graph.routes().size()) return false;
    return std::ranges::equal(*routes_, graph.routes(), [](const Route& old, const auto& entry) {
      return old.id == entry.first && old.closed == entry.second.closed && old.driven == entry.second.driven;
    });
  };
  if (is_same()) return;
  std::vector<Route> routes;
  for (const auto& [id, route] : graph.routes()) {
    routes.push_back(route);
    routes.back().annotations.clear();
    if (route.trajectory.empty())
      routes.back().trajectory = {graph.find(route.from)->approach_pose(), graph.find(route.to)->approach_pose()};
  }
  routes_ = std::make_shared<const std::vector<Route>>(std::move(routes));
  ++routes_version_;
}

// Nor has a tree.
void WatchSource::note_clusters(const LandmarkGraph& graph) {
  if (!look_.clusters) return;
  std::vector<ListedCluster> now = listed(look_.clusters(), graph);
  if (clusters_ ? now == *clusters_ : now.empty()) return;
  clusters_ = std::make_shared<const std::vector<ListedCluster>>(std::move(now));
  ++clusters_version_;
}

void WatchSource::serve(const MissionView& view) {
  note_routes(view.world.graph);
  if (view.world.time_s >= next_clusters_s_) {
    next_clusters_s_ = view.world.time_s + kClustersEvery_s;
    note_clusters(view.world.graph);
  }
  const std::scoped_lock lock(mutex_);
  for (Reader& reader : readers_) {
    if (!reader.wants_frame) continue;
    reader.frame = std::make_shared<const WatchFrame>(frame_for(reader, view));
    reader.wants_frame = false;
    --waiting_;
  }
  changed_.notify_all();
}

WatchFrame WatchSource::frame_for(Reader& reader, const MissionView& view) const {
  WatchFrame frame;
  frame.tick = tick_;
  frame.time_s = view.world.time_s;
  frame.is_paused = is_paused_;
  frame.pose = view.world.pose;
  frame.commanded = view.commanded;
  if (view.truth) frame.truth = view.truth->T_map_robot;
  frame.ranges = ranges_.ranges();
  add_map(frame, reader, {view.world.grid, view.world.graph}, kMaxFrameTiles);
  frame.plan = plan_;
  if (look_.nodes) frame.nodes = look_.nodes();
  if (reader.is_new) add_past(frame, reader);
  if (reader.wants_status && look_.status) frame.status = look_.status();
  add_lines(frame, reader);
  add_times(frame, reader);
  reader.is_new = false;
  return frame;
}

void WatchSource::add_map(WatchFrame& frame, Reader& reader, const Map& map, std::size_t max_tiles) const {
  const OccupancyGrid& grid = map.grid;
  if (reader.epoch != epoch_) {
    frame.is_afresh = true;
    reader.epoch = epoch_;
    reader.tiles = reader.landmarks = reader.routes = reader.clusters = 0;
  }
  frame.cell_m = grid.cell_m();
  frame.origin_m = grid.origin_m();
  frame.bounds = grid.bounds();
  for (const Cell& tile : tiles_.take(reader.tiles, max_tiles)) frame.tiles.push_back(copied_tile(grid, tile));
  for (const LandmarkId id : landmarks_.take(reader.landmarks, kMaxFrameLandmarks)) {
    const Landmark* const landmark = map.graph.find(id);
    if (landmark != nullptr)
      frame.landmarks.push_back(*landmark);
    else
      frame.retired.push_back(id);
  }
  frame.has_more = tiles_.has_more(reader.tiles) || landmarks_.has_more(reader.landmarks);
  if (reader.routes != routes_version_) frame.routes = routes_;
  reader.routes = routes_version_;
  if (reader.clusters != clusters_version_) frame.clusters = clusters_;
  reader.clusters = clusters_version_;
}

void WatchSource::add_past(WatchFrame& frame, Reader& reader) const {
  if (look_.driven)
    for (const Pose2& pose : evenly_chosen(look_.driven(), kMaxFramePath)) frame.driven.push_back(pose.position());
  if (!look_.sentences) return;
  frame.past = look_.sentences();
  if (frame.past.size() > kMaxWatchedLines)
    frame.past.erase(frame.past.begin(), frame.past.end() - static_cast<std::ptrdiff_t>(kMaxWatchedLines));
  reader.lines = lines_begin_ + lines_.size();
}

void WatchSource::add_lines(WatchFrame& frame, Reader& reader) const {
  if (reader.is_new) reader.lines = std::max(reader.lines, lines_begin_);
  frame.lines_left_out = lines_begin_ - std::min(lines_begin_, reader.lines);
  const std::uint64_t from = std::max(reader.lines, lines_begin_) - lines_begin_;
  frame.lines.assign(lines_.begin() + static_cast<std::ptrdiff_t>(from), lines_.end());
  reader.lines = lines_begin_ + lines_.size();
}

void WatchSource::add_times(WatchFrame& frame, Reader& reader) const {
  if (!look_.times || frame.time_s < reader.next_times_s) return;
  reader.next_times_s = frame.time_s + kTimesEvery_s;
  frame.times = look_.times();
}

std::unique_ptr<WatchSource::Watch> WatchSource::attach(std::size_t max_watches) {
  const std::scoped_lock lock(mutex_);
  if (readers_.size() >= max_watches) return nullptr;
  readers_.emplace_back();
  ++attached_;
  return std::make_unique<Watch>(*this, std::prev(readers_.end()));
}

void WatchSource::end(const OccupancyGrid* grid, const LandmarkGraph& graph) {
  const std::scoped_lock lock(mutex_);
  has_ended_ = true;
  if (is_watched_ && grid != nullptr) {
    if (grid != grid_) note_all({*grid, graph});
    note_routes(graph);
    note_clusters(graph);
  }
  for (Reader& reader : readers_) {
    WatchFrame frame;
    frame.is_last = true;
    frame.tick = tick_;
    if (is_watched_ && grid != nullptr) add_map(frame, reader, {*grid, graph}, std::numeric_limits<std::size_t>::max());
    if (look_.nodes) frame.nodes = look_.nodes();
    add_lines(frame, reader);
    reader.last_frame = std::make_shared<const WatchFrame>(std::move(frame));
    if (reader.wants_frame) --waiting_;
    reader.wants_frame = false;
  }
  changed_.notify_all();
}

WatchSource::Watch::~Watch() {
  const std::scoped_lock lock(source_.mutex_);
  if (reader_->wants_frame) --source_.waiting_;
  source_.readers_.erase(reader_);
  --source_.attached_;
}

std::shared_ptr<const WatchFrame> WatchSource::Watch::next(std::chrono::milliseconds at_most, bool with_status) {
  std::unique_lock lock(source_.mutex_);
  if (!source_.has_ended_ && !reader_->wants_frame && !reader_->frame) {
    reader_->wants_frame = true;
    ++source_.waiting_;
  }
  reader_->wants_status = with_status;
  source_.changed_.wait_for(lock, at_most, [&] { return reader_->frame || source_.has_ended_; });
  return std::exchange(reader_->frame ? reader_->frame : reader_->last_frame, nullptr);
}

bool WatchSource::Watch::has_ended() const {
  const std::scoped_lock lock(source_.mutex_);
  return source_.has_ended_ && !reader_->frame && !reader_->last_frame;
}

}  // namespace cairn
