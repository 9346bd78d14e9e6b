#include "framework/program/progress_line.hpp"

#include <fmt/format.h>

namespace cairn {
namespace {

constexpr double kRedraw_s = 2.0;  // of mission time

}  // namespace

void ProgressLine::on(const Event& event, const MissionView& view) {
  const double time_s = view.world.time_s;
  const auto tell = [&](const std::string& sentence) {
    clear();
    out_ << fmt::format("{:7.1f} s  {}\n", time_s, sentence);
  };
  if (std::holds_alternative<MatchingDone>(event)) ++matchings_;
  if (std::holds_alternative<TickDone>(event) && live_ && time_s >= drawn_at_s_ + kRedraw_s) draw(view.world);
  if (const auto* e = std::get_if<LandmarkChanged>(&event); e != nullptr && e->is_new)
    tell(fmt::format("found {}: {} at ({:.2f}, {:.2f}), degree {:.2f}", label_of(e->landmark), e->landmark.category,
                     e->landmark.T_map_landmark.x_m, e->landmark.T_map_landmark.y_m, e->landmark.degree));
  if (const auto* e = std::get_if<StepStarted>(&event)) tell(fmt::format("step {}: {}", e->index + 1, e->name));
  const auto ended = [&](const std::string& which, const std::string& name, const Status& status, bool is_halted) {
    const char* const how = is_halted ? "halted" : status.progress == Progress::success ? "done" : "failed";
    tell(fmt::format("step {}: {} {}{}", which, name, how, status.reason.empty() ? "" : " (" + status.reason + ")"));
  };
  if (const auto* e = std::get_if<StepEnded>(&event)) ended(std::to_string(e->index + 1), e->name, e->status, false);
  // What control nodes and conditions make of it stands in the report.
  if (const auto* e = std::get_if<NodeStarted>(&event); e != nullptr && e->kind == NodeKind::behaviour)
    tell(fmt::format("step {}: {}", e->path, e->name));
  if (const auto* e = std::get_if<NodeEnded>(&event); e != nullptr && e->kind == NodeKind::behaviour)
    ended(e->path, e->name, e->status, e->is_halted);
  if (const auto* e = std::get_if<Autosaved>(&event)) {
    tell(fmt::format("autosaved {}: all up to {:.3f} s, in {:.0f} ms", e->file_name, e->time_s, e->took_ms));
    out_ << std::flush;
  }
  if (const auto* e = std::get_if<AutosaveFailed>(&event)) tell("autosaving failed, the mission goes on: " + e->reason);
  if (const auto* e = std::get_if<Said>(&event)) tell(e->sentence);
  if (std::holds_alternative<Bumped>(event)) tell("bumped into something: stopped");
}

void ProgressLine::draw(const WorldView& world) {
  drawn_at_s_ = world.time_s;
  drawn_ = true;
  out_ << fmt::format("\r{:7.1f} s  at ({:.2f}, {:.2f})  known {:3.0f} %  landmarks {}  matchings {}   ", world.time_s,
                      world.pose.T_map_robot.x_m, world.pose.T_map_robot.y_m, 100.0 * known_ratio(world.grid),
                      world.graph.landmarks().size(), matchings_)
       << std::flush;
}

void ProgressLine::clear() {
  if (drawn_) out_ << "\r" << std::string(78, ' ') << "\r";
  drawn_ = false;
}

}  // namespace cairn
