// Shows a running mission to those who watch it from other threads.
//
// It changes nothing of what happens, and whoever watches cannot hold the mission up: a frame is made only for one that
// waits for it, and one that does not come back gets no frames. Nobody attached: one atomic load an event. The
// mission's thread copies values into the frame, bounded (watch_frame.hpp); texts are made by those who watch.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "framework/reporting/watching/change_log.hpp"
#include "framework/reporting/watching/watch_frame.hpp"

namespace cairn {

class WatchSource final : public Listener {
 public:
  // Looks at the mission in its thread, while an event is published. Any may be missing.
  struct Look {
    std::function<RunStatus()> status{};
    std::function<std::vector<NodeReport>()> nodes{};
    std::function<const std::vector<Pose2>&()> driven{};
    std::function<std::vector<std::string>()> sentences{};  // of all events, that which is published too
    std::function<std::vector<StageTime>()> times{};
    std::function<ClusterTree()> clusters{};
  };
  class Watch;

  WatchSource() = default;
  WatchSource(const WatchSource&) = delete;
  WatchSource& operator=(const WatchSource&) = delete;

  // Before the mission begins.
  void look_by(Look look) { look_ = std::move(look); }
  void on(const Event& event, const MissionView& view) override;

  // From any thread; null when so many watch already. The source must outlive it.
  [[nodiscard]] std::unique_ptr<Watch> attach(std::size_t max_watches);
  // After the run's last event: each watch gets what it has not had yet, and then ends. Null: there is no grid.
  void end(const OccupancyGrid* grid, const LandmarkGraph& graph);

 private:
  struct Reader {  // what one watch has had so far
    bool wants_frame = false;
    bool wants_status = false;
    bool is_new = true;
    std::uint64_t epoch = 0;
    std::uint64_t tiles = 0;
    std::uint64_t landmarks = 0;
    std::uint64_t lines = 0;
    std::uint64_t routes = 0;
    std::uint64_t clusters = 0;
    double next_times_s = 0.0;  // of the mission
    std::shared_ptr<const WatchFrame> frame{};
    std::shared_ptr<const WatchFrame> last_frame{};
  };

  struct Map {
    const OccupancyGrid& grid;
    const LandmarkGraph& graph;
  };
  void stop_watching();
  void note(const Event& event, const MissionView& view);
  void note_tiles(const CellChanges& changes);
  void note_all(const Map& map);
  void note_routes(const LandmarkGraph& graph);
  void note_clusters(const LandmarkGraph& graph);
  void note_plan(const Event& event, double time_s);
  void serve(const MissionView& view);
  [[nodiscard]] WatchFrame frame_for(Reader& reader, const MissionView& view) const;
  void add_map(WatchFrame& frame, Reader& reader, const Map& map, std::size_t max_tiles) const;
  void add_past(WatchFrame& frame, Reader& reader) const;
  void add_lines(WatchFrame& frame, Reader& reader) const;
  void add_times(WatchFrame& frame, Reader& reader) const;

  // Of the mission's thread.
  Look look_;
  bool is_watched_ = false;
  std::int64_t tick_ = 0;
  bool is_paused_ = false;
  const OccupancyGrid* grid_ = nullptr;
  std::uint64_t epoch_ = 0;  // of the map that the change logs are of
  ChangeLog<Cell> tiles_;
  ChangeLog<LandmarkId> landmarks_;
  std::shared_ptr<const std::vector<Route>> routes_;
  std::uint64_t routes_version_ = 0;
  std::shared_ptr<const std::vector<ListedCluster>> clusters_;
  std::uint64_t clusters_version_ = 0;
  double next_clusters_s_ = 0.0;  // of the mission
  std::shared_ptr<const WatchPlan> plan_;
  bool is_from_planner_ = false;  // the plan
  LastRanges ranges_{kMaxFrameRanges};
  std::deque<WatchLine> lines_;
  std::uint64_t lines_begin_ = 0;  // number of the first line

  std::atomic<int> attached_{0};
  std::atomic<int> waiting_{0};  // frames that are wanted
  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<Reader> readers_;
  bool has_ended_ = false;
};

class WatchSource::Watch {
 public:
  Watch(WatchSource& source, std::list<Reader>::iterator reader) : source_(source), reader_(reader) {}
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  // The mission as it is at its next event; null when none has come by then, or when it has ended. with_status: the
  // frame has the status, which costs more.
  [[nodiscard]] std::shared_ptr<const WatchFrame> next(std::chrono::milliseconds at_most, bool with_status);
  [[nodiscard]] bool has_ended() const;  // and no frame is left

 private:
  WatchSource& source_;
  std::list<Reader>::iterator reader_;
};

}  // namespace cairn
