#include "framework/experiments/shards/row_file.hpp"

#include <cmath>
#include <concepts>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <type_traits>

namespace cairn {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "cairn experiment row 3";

template <class T, class Of>
concept Is = std::same_as<std::remove_const_t<T>, Of>;

// The members of each struct, once for writing and reading.
void visit(auto& file, Is<LandmarkTruth> auto& v) {
  file(v.landmark, v.error_m);
}
void visit(auto& file, Is<TruthScore> auto& v) {
  file(v.matched, v.false_landmarks, v.missed_objects);
}
void visit(auto& file, Is<MapQuality> auto& v) {
  file(v.wall_cells, v.free_cells, v.wall_log_loss, v.free_log_loss, v.log_loss, v.brier, v.ghost_ratio,
       v.missed_ratio);
}
void visit(auto& file, Is<PlaceDegrees> auto& v) {
  file(v.degrees, v.time_s);
}
void visit(auto& file, Is<OrbitSample> auto& v) {
  file(v.angle_rad, v.categories, v.templates);
}
void visit(auto& file, Is<Verdict> auto& v) {
  file(v.is, v.found, v.position_error_m, v.orientation_error_rad, v.driven_m);
}
void visit(auto& file, Is<RingProfile> auto& v) {
  file(v.ol, v.cells);
}
void visit(auto& file, Is<ThresholdCount> auto& v) {
  file(v.degree, v.found, v.right);
}
void visit(auto& file, Is<WorldCounts> auto& v) {
  file(v.truly, v.counts);
}
void visit(auto& file, Is<DetectorSweep> auto& v) {
  file(v.detector, v.counts, v.wall_s);
}
void visit(auto& file, Is<Contact> auto& v) {
  file(v.speed_mps, v.could_be_seen);
}
void visit(auto& file, Is<TimedContact> auto& v) {
  file(v.time_s, v.contact);
}
void visit(auto& file, Is<Stand> auto& v) {
  file(v.begin_s, v.for_s);
}
void visit(auto& file, Is<SilenceFigures> auto& v) {
  file(v.silences, v.worst_stop_ticks);
}
void visit(auto& file, Is<GoalVerdict> auto& v) {
  file(v.path, v.goal, v.begin_s, v.end_s, v.end, v.reason, v.missed_m, v.is_reachable, v.is_mapped, v.is_struck,
       v.is_displaced);
}
void visit(auto& file, Is<TrialVerdict> auto& v) {
  file(v.contacts, v.fast_contacts, v.stand, v.silences, v.goals, v.fault_count);
}
void visit(auto& file, Is<HomeVerdict> auto& v) {
  file(v.rooms, v.entered, v.area_m2, v.known_ratio, v.known_90_s, v.contacts, v.fast_contacts, v.said_success, v.end,
       v.not_entered);
}
void visit(auto& file, Is<TagVerdict> auto& v) {
  file(v.hung, v.in_sight, v.found, v.found_besides, v.false_landmarks, v.sightings, v.false_sightings,
       v.position_error_m, v.direction_error_deg);
}
void visit(auto& file, Is<StageTime> auto& v) {
  file(v.stage, v.module, v.count, v.median_us, v.p99_us, v.worst_us, v.total_s, v.own_s);
}
void visit(auto& file, Is<MissionResult> auto& v) {
  file(v.outcome, v.reason, v.readings, v.matchings, v.collisions, v.distance_m, v.time_s, v.paused_s, v.explored_ratio,
       v.map_file);
}
void visit(auto& file, Is<ExperimentRow> auto& v) {
  file(v.mission, v.variant, v.seed, v.result, v.score, v.worst_error_m, v.quality, v.held_out,
       v.held_out_log_likelihood, v.places, v.orbit, v.verdicts, v.ring, v.sweeps, v.contacts, v.trial, v.home, v.tags,
       v.tick, v.step_rad, v.wall_s, v.detector_wall_s, v.gave_up);
}

template <class T>
concept Plain = std::is_arithmetic_v<T> || std::same_as<T, std::string>;

// A struct becomes a list of its members.
class Writer {
 public:
  void operator()(const auto&... values) { (list_.push_back(json_of(values)), ...); }
  [[nodiscard]] json taken() { return std::move(list_); }

 private:
  template <class T>
  static json json_of(const T& value) {
    if constexpr (std::is_enum_v<T>) {
      return static_cast<int>(value);
    } else if constexpr (Plain<T>) {
      return value;
    } else {
      Writer inner;
      visit(inner, value);
      return inner.taken();
    }
  }
  static json json_of(double value) {
    if (std::isnan(value)) return "nan";
    if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
    return value;
  }
  template <class T>
  static json json_of(const std::optional<T>& value) {
    return value ? json::array({json_of(*value)}) : json();
  }
  template <class T>
  static json json_of(const std::vector<T>& values) {
    json list = json::array();
    for (const T& value : values) list.push_back(json_of(value));
    return list;
  }
  static json json_of(const std::map<int, double>& values) {
    json list = json::array();
    for (const auto& [key, value] : values) list.push_back(json::array({key, json_of(value)}));
    return list;
  }

  json list_ = json::array();
};

// Throws what the JSON library throws where another value stands than the member can hold.
class Reader {
 public:
  explicit Reader(const json& list) : list_(list) {}
  void operator()(auto&... values) {
    if (!list_.is_array() || list_.size() != sizeof...(values))
      throw std::runtime_error("it is damaged: another number of values");
    std::size_t at = 0;
    (read(list_.at(at++), values), ...);
  }

 private:
  template <class T>
  static void read(const json& from, T& value) {
    if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(from.get<int>());
    } else if constexpr (Plain<T>) {
      value = from.get<T>();
    } else {
      Reader inner(from);
      visit(inner, value);
    }
  }
  static void read(const json& from, double& value) {
    if (from == "nan") {
      value = std::numeric_limits<double>::quiet_NaN();
    } else if (from == "inf" || from == "-inf") {
      value = from == "inf" ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
    } else {
      value = from.get<double>();
    }
  }
  template <class T>
  static void read(const json& from, std::optional<T>& value) {
    value.reset();
    if (!from.is_null()) read(from.at(0), value.emplace());
  }
  template <class T>
  static void read(const json& from, std::vector<T>& values) {
    values.assign(from.size(), T{});
    for (std::size_t i = 0; i < values.size(); ++i) read(from.at(i), values[i]);
  }
  static void read(const json& from, std::map<int, double>& values) {
    for (const json& entry : from) read(entry.at(1), values[entry.at(0).get<int>()]);
  }

  const json& list_;
};

}  // namespace

std::string row_text(const ExperimentRow& row, const std::string& experiment) {
  Writer writer;
  visit(writer, row);
  const nlohmann::ordered_json file{
      {"format", kFormat}, {"experiment", experiment}, {"row", nlohmann::ordered_json(writer.taken())}};
  return file.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

ExperimentRow row_from(const std::string& text, const std::string& experiment) {
  ExperimentRow row;
  try {
    const json file = json::parse(text);
    if (file.at("format") != kFormat) throw std::runtime_error("it is of another version of Cairn");
    if (file.at("experiment") != experiment)
      throw std::runtime_error("it is of another experiment, or of this one with other settings");
    Reader reader(file.at("row"));
    visit(reader, row);
  } catch (const json::exception&) {
    throw std::runtime_error("it is damaged");
  }
  return row;
}

}  // namespace cairn
