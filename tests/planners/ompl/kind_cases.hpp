// Every way a robot may move with every algorithm that takes it, as parameters of tests.
#pragma once

#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "planners/ompl/pose/motion_kind.hpp"

namespace cairn::test {

struct KindCase {
  std::string kind_name;
  MotionKind kind;
  std::string name;
  Algorithm algorithm;

  friend void PrintTo(const KindCase& of, std::ostream* out) { *out << of.kind_name << " " << of.name; }
};

inline std::vector<std::pair<std::string, MotionKind>> kind_names() {
  return {{"disc", MotionKind::holonomic},
          {"differential", MotionKind::differential},
          {"dubins", MotionKind::dubins},
          {"reeds_shepp", MotionKind::reeds_shepp}};
}

inline std::vector<KindCase> every_kind_case() {
  std::vector<KindCase> cases;
  for (const auto& [kind_name, kind] : kind_names())
    for (const auto& [name, algorithm] : algorithm_names())
      if (works_with(kind, algorithm)) cases.push_back({kind_name, kind, name, algorithm});
  return cases;
}

// For INSTANTIATE_TEST_SUITE_P.
inline std::string name_of(const KindCase& of) {
  return of.kind_name + "_" + of.name;
}

}  // namespace cairn::test
