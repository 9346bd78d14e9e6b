// How wide an opening is by its echoes: what the sonars hear through it while the robot stands before it and looks in.
//
// An echo from behind the opening says that nothing nearer stands in its beam, so all of the beam has room where it
// crosses the opening. The map cannot say that: it draws each post as wide as the beams that have heard it.
//
// A large room behind a door is silent: its far wall is out of range. Silence counts as an echo from the end of the
// range where a wall could not be silent: in a beam that holds the direction straight through the opening, as even a
// smooth wall echoes at right angles, of a transducer that has echoed in the same look.
#pragma once

#include <algorithm>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/observation.hpp"

namespace cairn::behaviours {

struct OpeningEchoSettings {
  double beam_ratio = 0.8;
  double behind_m = 0.35;
  double bin_m = 0.02;
  double aside_m = 1.0;
  double gap_m = 0.05;
  double off_middle_m = 0.4;
  int min_passes = 1;
  int min_silent = 3;
  static void describe(Fields<OpeningEchoSettings>& fields);
};

// As it was heard. Width 0: no echo came from behind it.
struct HeardOpening {
  bool is_heard = false;  // any echo from its side came at all
  double width_m = 0.0;
  Point middle_m{0.0, 0.0};
  Point from_m{0.0, 0.0};  // of the look: the line from here through the middle is free
};

class OpeningEchoes {
 public:
  explicit OpeningEchoes(const OpeningEchoSettings& settings = {}) : settings_(settings) {}

  // A new look at the opening, from a place before it. What was heard so far is forgotten.
  void begin(const Point& at_m, const Point& from_m);
  // Every tick of the look.
  void see(const Observation& observation, const Pose2& T_map_robot);
  // The widest part about the middle that enough echoes have passed.
  [[nodiscard]] HeardOpening heard() const;

 private:
  // Adds to the parts that lie between.
  void pass(double from_m, double to_m, std::vector<int>& passes) const;
  // Of the bins from first to last: between the outermost that more than the fewest echoes have passed.
  [[nodiscard]] double surer_middle_m(std::size_t first, std::size_t last) const;
  [[nodiscard]] bool has_echoed(int sensor) const { return std::ranges::find(echoed_, sensor) != echoed_.end(); }
  [[nodiscard]] double middle_of(std::size_t bin) const {
    return (static_cast<double>(bin) + 0.5) * settings_.bin_m - settings_.aside_m;
  }

  OpeningEchoSettings settings_;
  Point from_m_{0.0, 0.0};
  Pose2 T_map_opening_;      // x through it, y along it
  std::vector<int> passes_;  // along it
  std::vector<int> silent_;  // the same, by silence
  std::vector<int> echoed_;  // transducers
  bool is_heard_ = false;
};

}  // namespace cairn::behaviours
