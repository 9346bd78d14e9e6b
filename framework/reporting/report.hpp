// The report of a run, gathered from the event stream and written as JSON.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/mission/events.hpp"
#include "framework/mission/history.hpp"
#include "framework/mission/runner.hpp"
#include "framework/reporting/event_log.hpp"
#include "framework/reporting/marker_figures.hpp"
#include "framework/reporting/near_misses.hpp"
#include "framework/reporting/pose_errors.hpp"
#include "framework/reporting/run_track.hpp"
#include "framework/reporting/thinned_series.hpp"
#include "framework/reporting/timeline.hpp"

namespace cairn {

// Best degree a category at one matching, for charts and reports.
struct DegreeSample {
  double time_s = 0.0;
  Point region_centre_m{0.0, 0.0};
  std::vector<CategoryDegree> degrees;
  std::vector<TemplateDegree> templates{};  // where the detector reports them
  Point robot_m{0.0, 0.0};                  // in truth where that is known, otherwise as estimated
  std::optional<double> fits_above{};       // as Matching has it
};

// A touch that the simulation judged.
struct TimedContact {
  double time_s = 0.0;
  Contact contact;
};

class RunReport : public Listener {
 public:
  // history: bounds its size, and that of the report.
  explicit RunReport(const HistoryConfig& history = {});

  void on(const Event& event, const MissionView& view) override;

  // The same bytes for the same build, mission and seed: no clock, no path of this machine.
  [[nodiscard]] std::string report_json(const Mission& mission, const MissionResult& result, const LandmarkGraph& graph,
                                        const std::vector<std::string>& pictures) const;
  // One line for `--json`: the report's main figures, where its files are, and the wall clock (of the
  // whole run, and a stage and module).
  [[nodiscard]] std::string summary_json(const Mission& mission, const MissionResult& result,
                                         const MissionRunner& runner, const std::filesystem::path& out,
                                         const std::vector<std::string>& pictures, double wall_s) const;

  [[nodiscard]] const std::vector<DegreeSample>& degrees() const { return degrees_.samples(); }
  [[nodiscard]] const std::vector<TimedContact>& contacts() const { return contacts_; }
  [[nodiscard]] const PoseErrors& pose_errors() const { return pose_errors_; }
  [[nodiscard]] const MarkerFigures& markers() const { return markers_; }
  [[nodiscard]] const NearMisses& near_misses() const { return near_misses_; }
  [[nodiscard]] const RunTimeline& timeline() const { return timeline_; }
  [[nodiscard]] const RunTrack& track() const { return track_; }
  [[nodiscard]] const EventLog& events() const { return events_; }

 private:
  void note_contact(const MissionView& view);

  const std::size_t max_contacts_;
  ThinnedSeries<DegreeSample> degrees_;
  std::vector<TimedContact> contacts_;
  NearMisses near_misses_;
  PoseErrors pose_errors_;
  MarkerFigures markers_;
  RunTimeline timeline_;
  RunTrack track_;
  EventLog events_;  // sentences with their time
};

// Wall-clock times of modules as JSON; not in the report, which is the same in every run.
[[nodiscard]] std::string timing_json(const std::vector<StageTime>& times);

// One landmark against the world it was found in: the nearest true object of its category.
struct LandmarkTruth {
  LandmarkId landmark = 0;
  double error_m = 0.0;
};

struct TruthScore {
  std::vector<LandmarkTruth> matched;  // right category, within the tolerance; each object once
  int false_landmarks = 0;             // found, but no such object there
  int missed_objects = 0;              // standing there, but not found
};
[[nodiscard]] TruthScore score_against(const World& world, const LandmarkGraph& graph, double tolerance_m);

}  // namespace cairn
