#include "framework/reporting/event_sentences.hpp"

#include <fmt/format.h>

#include "framework/mission/hearing/hearing_record.hpp"
#include "framework/mission/loop/hold_record.hpp"
#include "maps/landmarks/close_categories.hpp"

namespace cairn {
namespace {

struct Sentence {
  std::string operator()(const TickDone&) const { return {}; }
  std::string operator()(const MatchingDone&) const { return {}; }
  std::string operator()(const LandmarkChanged& e) const {
    const Pose2& T_map_landmark = e.landmark.T_map_landmark;
    return fmt::format("{} {}, {} at ({:.2f}, {:.2f}), degree {}", e.is_new ? "found" : "improved",
                       label_of(e.landmark), e.landmark.category, T_map_landmark.x_m, T_map_landmark.y_m,
                       degree_text(e.landmark));
  }
  std::string operator()(const LandmarkRetired& e) const {
    return "retired " + label_of(e.landmark) + ", " + e.landmark.category + ": " + e.reason;
  }
  std::string operator()(const PlanDone& e) const {
    return "plan: " + std::string(name_of(e.result.outcome)) + (e.result.reason.empty() ? "" : ", " + e.result.reason);
  }
  std::string operator()(const PathStarted&) const { return {}; }
  static std::string ended(const Status& status) {
    return std::string(" ends: ") + (status.state == StepState::success ? "success" : "failure") +
           (status.reason.empty() ? "" : ", " + status.reason);
  }
  std::string operator()(const StepStarted& e) const { return fmt::format("step {} ({}) begins", e.index + 1, e.name); }
  std::string operator()(const StepEnded& e) const {
    return fmt::format("step {} ({})", e.index + 1, e.name) + ended(e.status);
  }
  std::string operator()(const NodeStarted& e) const { return "node " + e.path + " (" + e.name + ") begins"; }
  std::string operator()(const NodeEnded& e) const {
    return "node " + e.path + " (" + e.name + ")" + (e.is_halted ? " is halted: " + e.status.reason : ended(e.status));
  }
  std::string operator()(const MapSaved& e) const { return "saved " + e.file_name; }
  std::string operator()(const Autosaved&) const { return {}; }
  std::string operator()(const Stalled&) const { return {}; }
  std::string operator()(const AutosaveFailed& e) const {
    return "autosave failed, the mission continues: " + e.reason;
  }
  std::string operator()(const Message& e) const { return e.sentence; }
  std::string operator()(const Bumped&) const { return "bumped into something"; }
  std::string operator()(const RobotStopped& e) const { return text_of(e); }
  std::string operator()(const RobotReleased& e) const { return text_of(e); }
  std::string operator()(const WentDeaf& e) const { return text_of(e); }
  std::string operator()(const HearsAgain& e) const { return text_of(e); }
  std::string operator()(const Paused&) const { return "paused"; }
  std::string operator()(const Resumed&) const { return "resumed"; }
};

}  // namespace

std::string sentence_of(const Event& event) {
  return std::visit(Sentence(), event);
}

}  // namespace cairn
