#include "framework/mission/hearing/hearing_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace cairn {
namespace {

std::string why(DeafCause cause) {
  switch (cause) {
    case DeafCause::missed_echo:
      return "where the map predicts an echo";
    case DeafCause::silent_ring:
      return "like all others there, where the map predicts echoes";
    case DeafCause::deaf_neighbour:
      return "beside one that is deaf";
    case DeafCause::bump:
      return "where the robot has bumped into something";
  }
  return {};
}

}  // namespace

std::string transducers_text(const std::vector<int>& sensors) {
  if (sensors.size() == 1) return fmt::format("transducer {}", sensors.front());
  const bool is_range = sensors.size() > 2 && sensors.back() - sensors.front() + 1 == std::ssize(sensors);
  if (is_range) return fmt::format("transducers {} to {}", sensors.front(), sensors.back());
  std::string text = "transducers ";
  for (std::size_t i = 0; i < sensors.size(); ++i)
    text += (i == 0 ? "" : i + 1 == sensors.size() ? " and " : ", ") + std::to_string(sensors[i]);
  return text;
}

std::string text_of(const WentDeaf& event) {
  return fmt::format("{} {} nothing {}: the robot creeps to where only {} look{}", transducers_text(event.sensors),
                     event.sensors.size() == 1 ? "hears" : "hear", why(event.cause),
                     event.sensors.size() == 1 ? "it" : "they", event.sensors.size() == 1 ? "s" : "");
}

std::string text_of(const HearsAgain& event) {
  return transducers_text(event.sensors) + (event.sensors.size() == 1 ? " hears again" : " hear again");
}

std::vector<Event> HearingRecord::update(const DeafTransducers& hearing, double time_s) {
  std::vector<Event> events;
  std::vector<int> hears;
  std::array<std::vector<int>, 4> went_deaf;  // by cause
  for (const HearingChange& change : hearing.changes()) {
    std::vector<int>& changed = change.is_deaf ? went_deaf[static_cast<std::size_t>(change.cause)] : hears;
    changed.push_back(change.sensor);
  }
  if (!hears.empty()) {
    std::ranges::sort(hears);
    events.emplace_back(HearsAgain{std::move(hears)});
    last_s_ = time_s;
  }
  for (std::size_t cause = 0; cause < went_deaf.size(); ++cause) {
    if (went_deaf[cause].empty()) continue;
    std::ranges::sort(went_deaf[cause]);
    if (ever_deaf_.empty()) first_s_ = time_s;
    for (const int sensor : went_deaf[cause])
      if (const auto at = std::ranges::lower_bound(ever_deaf_, sensor); at == ever_deaf_.end() || *at != sensor)
        ever_deaf_.insert(at, sensor);
    events.emplace_back(WentDeaf{std::move(went_deaf[cause]), static_cast<DeafCause>(cause)});
  }
  deaf_ = hearing.deaf();
  if (hearing.is_ring_silent() != was_ring_silent_) {
    was_ring_silent_ = hearing.is_ring_silent();
    events.emplace_back(Message{was_ring_silent_ ? "no transducer has heard anything for metres: the robot slows down"
                                                 : "something is heard again: the robot goes on as before"});
  }
  return events;
}

std::string HearingRecord::summary() const {
  if (ever_deaf_.empty()) return {};
  if (deaf_ == ever_deaf_) return fmt::format("deaf from {:.1f} s to the end: {}", first_s_, transducers_text(deaf_));
  std::string text =
      fmt::format("deaf for a time between {:.1f} s and {}: {}", first_s_,
                  deaf_.empty() ? fmt::format("{:.1f} s", last_s_) : "the end", transducers_text(ever_deaf_));
  if (!deaf_.empty()) text += "; to the end: " + transducers_text(deaf_);
  return text;
}

}  // namespace cairn
