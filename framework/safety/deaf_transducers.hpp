// Which transducers hear nothing although there is something to hear: a dead transducer says "no echo", as a healthy
// one does before open space.
//
// It counts as deaf
// - when it has said "no echo" for some rounds where an echo was expected,
// - when no transducer of the ring, or of its left or right half, has answered several expected echoes in a row: then
//   all of these that are silent,
// - when it is silent beside a deaf one, as long as that, and has not answered since that one went deaf,
// - when it was silent and the robot has bumped into something at its side.
// An echo ends it. Beams of lasers are never deaf: nothing answers a sonar but a wall that is straight across, and
// everything a laser. Where one looks, a deaf sonar is not alone. Expectations are plain numbers: this class knows no
// map, and trusts whoever makes them with slowing the robot down only.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "framework/contracts/observation.hpp"
#include "framework/safety/config.hpp"
#include "framework/safety/ray_directions.hpp"

namespace cairn {

// What the map lets a transducer of this observation hear.
struct ExpectedEcho {
  int sensor = 0;
  double range_m = 0.0;
  bool is_certain = true;  // false: of something that a good transducer may not hear, for its shape or its slant
};

enum class DeafCause { missed_echo, silent_ring, deaf_neighbour, bump };

struct HearingChange {
  int sensor = 0;
  bool is_deaf = false;
  DeafCause cause = DeafCause::missed_echo;  // of deafness
};

// Whether a reading says "no echo".
[[nodiscard]] bool is_no_echo(const RangeReading& reading);

class DeafTransducers {
 public:
  // kept_s: how long a transducer's last answer counts.
  DeafTransducers(const DeafConfig& config, double kept_s) : config_(config), kept_s_(kept_s) {}

  // Every observation, in order, placed; expected echoes of its readings.
  void see(const Observation& observation, std::span<const ExpectedEcho> expected);
  // The robot has met something in that direction of it. After see().
  void feel_bump(double side_rad);
  // The clock has jumped: counts begin afresh, who is deaf stays so.
  void forget();

  // Whether a deaf transducer alone looks into some direction that the robot sweeps when it moves that way.
  [[nodiscard]] bool is_towards(double direction_rad) const;
  // Nothing at all has been heard for silent_m of driving.
  [[nodiscard]] bool is_ring_silent() const { return silent_path_m_ >= config_.silent_m; }
  // Rising.
  [[nodiscard]] const std::vector<int>& deaf() const { return deaf_; }
  // With the last see() and what was felt since.
  [[nodiscard]] const std::vector<HearingChange>& changes() const { return changes_; }

 private:
  struct Transducer {
    int sensor = 0;
    double axis_rad = 0.0;
    double half_beam_rad = 0.0;
    double stamp_s = 0.0;     // of its last answer
    double echo_s = -1e9;     // of its last echo
    double deaf_s = -1e9;     // when it went deaf
    double counted_s = -1e9;  // of the last one that made a round
    int silent_rounds = 0;    // "no echo" in a row
    int missed_rounds = 0;    // of these, where an echo was expected
    bool is_silent = false;   // its last answer
    bool is_deaf = false;
  };

  // The whole ring, its left and its right half.
  struct Group {
    double missed = 0.0;  // expected echoes in a row; uncertain ones count less
    double last_echo_s = -1e9;
  };
  static constexpr std::size_t kGroups = 3;
  [[nodiscard]] static bool is_in(std::size_t group, const Transducer& transducer);
  [[nodiscard]] Transducer& transducer_of(const RangeReading& reading);
  void take_echo(Transducer& transducer);
  void take_silence(Transducer& transducer, const ExpectedEcho* expected);
  void judge();
  void spread();
  void take_ray(const RangeReading& ray);
  void set_deaf(Transducer& transducer, bool is_deaf, DeafCause cause);

  DeafConfig config_;
  double kept_s_;
  double stamp_s_ = 0.0;
  std::vector<Transducer> transducers_;  // as they were heard of
  std::vector<int> deaf_;
  std::vector<HearingChange> changes_;
  std::array<Group, kGroups> groups_;
  RayDirections ray_directions_;
  double silent_path_m_ = 0.0;  // driven since
  bool has_place_ = false;
  Point at_odom_{0.0, 0.0};
};

}  // namespace cairn
