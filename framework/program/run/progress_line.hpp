// Progress of a run for people: one line that is drawn again and again on a terminal, or printed now and then
// elsewhere, and the events that matter as lines of their own.
#pragma once

#include <functional>
#include <map>
#include <ostream>
#include <string>
#include <utility>

#include "framework/mission/events.hpp"
#include "framework/mission/run_control.hpp"

namespace cairn {

// "step 1 of 3: explore, 63 % known, about 80 s left; goto, save not counted".
[[nodiscard]] std::string progress_text(const RunStatus& status);

class ProgressLine : public Listener {
 public:
  // live: draw the moving line (out is a terminal). status: how the mission stands, asked while it publishes something.
  ProgressLine(std::ostream& out, bool live, std::function<RunStatus()> status)
      : out_(out), live_(live), status_(std::move(status)) {}
  ~ProgressLine() override { clear(); }

  void on(const Event& event, const MissionView& view) override;

 private:
  void report(double time_s, const std::string& sentence);
  void report_stall(const Stalled& stalled, double time_s);
  void report_landmark(const LandmarkChanged& change, double time_s);
  void remember_categories(const LandmarkGraph& graph);
  void report_nodes(const Event& event, double time_s);
  void clear();
  void draw();

  std::ostream& out_;
  bool live_;
  std::function<RunStatus()> status_;
  std::size_t drawn_ = 0;  // characters
  double drawn_at_s_ = 0.0;
  std::map<LandmarkId, std::string> categories_;  // as reported last
  bool has_begun_ = false;
  std::map<std::pair<std::string, std::string>, double> stalls_s_;  // the longest reported, by stage and module
};

}  // namespace cairn
