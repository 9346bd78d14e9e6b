#include "framework/program/run/progress_line.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "framework/mission/hearing/hearing_record.hpp"
#include "framework/mission/loop/hold_record.hpp"
#include "maps/base/printable.hpp"
#include "maps/landmarks/close_categories.hpp"

namespace cairn {
namespace {

constexpr double kRedraw_s = 2.0;        // of mission time
constexpr double kReportEvery_s = 60.0;  // the same, where nothing can be drawn over
constexpr std::size_t kMaxColumns = 110;
constexpr double kMuchWorse = 2.0;

std::string ended_text(const std::string& which, const std::string& name, const Status& status, bool is_halted) {
  const char* const how = is_halted ? "halted" : status.state == StepState::success ? "done" : "failed";
  return fmt::format("step {}: {} {}{}", which, name, how, status.reason.empty() ? "" : " (" + status.reason + ")");
}

std::string stall_text(const Stalled& stalled) {
  if (stalled.stage.empty())
    return fmt::format(
        "the robot was stopped: this whole process had stood still for {:.2f} s (stopped by a signal, or without a "
        "processor); it goes on",
        stalled.for_s);
  return fmt::format("the robot was stopped: no tick had ended for {:.2f} s (in stage {}{}{}); it goes on",
                     stalled.for_s, stalled.stage, stalled.module.empty() ? "" : " of module ", stalled.module);
}

std::string with_article(const std::string& category) {
  return (std::string_view("aeiou").find(category.front()) == std::string_view::npos ? "a " : "an ") + category;
}

}  // namespace

std::string progress_text(const RunStatus& status) {
  std::string text;
  if (status.steps > 0) text = fmt::format("step {} of {}: {}, ", status.step, status.steps, status.step_name);
  text += fmt::format("{:.0f} % known", 100.0 * status.explored_ratio);
  if (status.left) text += ", " + text_of(*status.left);
  return text;
}

void ProgressLine::on(const Event& event, const MissionView& view) {
  const double time_s = view.world.time_s;
  if (std::holds_alternative<TickDone>(event) &&
      std::abs(time_s - drawn_at_s_) >= (live_ ? kRedraw_s : kReportEvery_s)) {
    drawn_at_s_ = time_s;
    if (live_)
      draw();
    else
      report(time_s, progress_text(status_()));
  }
  if (const auto* e = std::get_if<LandmarkChanged>(&event)) report_landmark(*e, time_s);
  if (!has_begun_) remember_categories(view.world.graph);
  report_nodes(event, time_s);
  if (const auto* e = std::get_if<Autosaved>(&event)) {
    report(time_s,
           fmt::format("autosaved {} (state at {:.3f} s, written in {:.0f} ms)", e->file_name, e->time_s, e->took_ms));
    out_ << std::flush;
  }
  if (const auto* e = std::get_if<Stalled>(&event)) report_stall(*e, time_s);
  if (const auto* e = std::get_if<AutosaveFailed>(&event))
    report(time_s, "autosave failed, the mission continues: " + e->reason);
  if (const auto* e = std::get_if<Message>(&event)) report(time_s, e->sentence);
  if (std::holds_alternative<Bumped>(event)) report(time_s, "bumped into something: stopped");
  if (const auto* e = std::get_if<RobotStopped>(&event)) report(time_s, text_of(*e));
  if (const auto* e = std::get_if<RobotReleased>(&event)) report(time_s, text_of(*e));
  if (const auto* e = std::get_if<WentDeaf>(&event)) report(time_s, text_of(*e));
  if (const auto* e = std::get_if<HearsAgain>(&event)) report(time_s, text_of(*e));
  if (std::holds_alternative<Paused>(event)) {
    report(time_s, "paused: `cairn mission resume` or SIGUSR2 lets it go on");
    out_ << std::flush;
  }
  if (const auto* e = std::get_if<Resumed>(&event))
    report(time_s, e->paused_s ? fmt::format("resumed after {:.1f} s", *e->paused_s) : "resumed");
}

// A stage that is too slow stalls tick after tick: that is reported once, and again when it is much worse.
void ProgressLine::report_stall(const Stalled& stalled, double time_s) {
  const auto [longest_s, is_first] = stalls_s_.try_emplace({stalled.stage, stalled.module}, stalled.for_s);
  if (!is_first && stalled.for_s < kMuchWorse * longest_s->second) return;
  longest_s->second = stalled.for_s;
  report(time_s, stall_text(stalled));
}

// A map that the mission goes on with holds some already.
void ProgressLine::remember_categories(const LandmarkGraph& graph) {
  has_begun_ = true;
  for (const auto& [id, landmark] : graph.landmarks()) categories_[id] = landmark.category;
}

void ProgressLine::report_landmark(const LandmarkChanged& change, double time_s) {
  const Landmark& landmark = change.landmark;
  const std::string place = fmt::format("at ({:.2f}, {:.2f}), degree {}", landmark.T_map_landmark.x_m,
                                        landmark.T_map_landmark.y_m, degree_text(landmark));
  const std::string earlier = std::exchange(categories_[landmark.id], landmark.category);
  if (change.is_new)
    report(time_s, fmt::format("found {}: {} {}", label_of(landmark), landmark.category, place));
  else if (!earlier.empty() && earlier != landmark.category)
    report(time_s, fmt::format("{} is {} now, no longer {}, {}", label_of(landmark), with_article(landmark.category),
                               with_article(earlier), place));
}

// What control nodes and conditions make of it stands in the report.
void ProgressLine::report_nodes(const Event& event, double time_s) {
  if (const auto* e = std::get_if<StepStarted>(&event))
    report(time_s, fmt::format("step {}: {}", e->index + 1, e->name));
  if (const auto* e = std::get_if<StepEnded>(&event))
    report(time_s, ended_text(std::to_string(e->index + 1), e->name, e->status, false));
  if (const auto* e = std::get_if<NodeStarted>(&event); e != nullptr && e->kind == NodeKind::behaviour)
    report(time_s, fmt::format("step {}: {}", e->path, e->name));
  if (const auto* e = std::get_if<NodeEnded>(&event); e != nullptr && e->kind == NodeKind::behaviour)
    report(time_s, ended_text(e->path, e->name, e->status, e->is_halted));
}

void ProgressLine::report(double time_s, const std::string& sentence) {
  clear();
  out_ << fmt::format("{:7.1f} s  {}\n", time_s, printable(sentence));
}

void ProgressLine::draw() {
  const RunStatus status = status_();
  std::string line = printable(fmt::format("{:7.1f} s  {}", status.time_s, progress_text(status)));
  if (line.size() > kMaxColumns) line = line.substr(0, kMaxColumns - 3) + "...";
  clear();
  out_ << line << std::flush;
  drawn_ = line.size();
}

void ProgressLine::clear() {
  if (drawn_ > 0) out_ << "\r" << std::string(drawn_, ' ') << "\r";
  drawn_ = 0;
}

}  // namespace cairn
