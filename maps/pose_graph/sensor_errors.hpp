// What a robot's own sensors say too much, as unknowns of a pose graph: wheels that count too much, and the bias of a
// compass, of the whole run and, along the way, from one group of readings to the next.
#pragma once

#include <cstddef>
#include <vector>

namespace cairn {

struct SensorErrors {
  double length_ratio = 0.0;  // 0.03: wheels count 1.03 m for a metre
  double turn_ratio = 0.0;
  double compass_rad = 0.0;               // bias of the whole run
  std::vector<double> local_compass_rad;  // and, added to it, of each group; groups that are not there have none
};

// Standard deviations around 0. 0: such an error is not looked for.
struct ExpectedErrors {
  double length_ratio = 0.0;
  double turn_ratio = 0.0;
  double compass_rad = 0.0;
  double local_compass_rad = 0.0;
  double local_kept_ratio = 0.0;  // first-order Gauss-Markov: of a group's bias in the next one's; less than 1
};

[[nodiscard]] bool is_valid(const ExpectedErrors& expected);
[[nodiscard]] double chi2_of(const ExpectedErrors& expected, const SensorErrors& errors);
// Of what is new in a group's bias beside what is left of the one before.
[[nodiscard]] double innovation_sigma_rad(const ExpectedErrors& expected);

// Where the unknown ones stand in a system of equations, behind the poses.
struct ErrorRows {
  int length = -1;  // not looked for
  int turn = -1;
  int compass = -1;
  int first_local = -1;
  int end = 0;

  // first: the row behind the poses.
  ErrorRows(const ExpectedErrors& expected, std::size_t groups, int first);
  [[nodiscard]] int of_group(std::size_t group) const {
    return first_local < 0 ? -1 : first_local + static_cast<int>(group);
  }
};

}  // namespace cairn
