// A question to a planner as people write it: by names, which only a map makes places of.
#pragma once

#include <string>
#include <vector>

namespace cairn {

struct PlanQuestion {
  std::string from;  // a place: `x,y`, a landmark's id or name, `nearest CATEGORY`; in a mission also `here`
  std::string to;
  std::vector<std::string> via;     // places, passed in this order
  std::vector<std::string> avoid;   // landmarks and clusters
  std::vector<std::string> closed;  // routes
  int alternatives = 0;
  std::string cost = "length";
  bool explain = false;
  bool trajectory = false;
};

}  // namespace cairn
