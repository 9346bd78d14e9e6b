// What one matching shows at each place of the region that it has searched.
#pragma once

#include <vector>

#include "framework/contracts/detector.hpp"

namespace cairn {

// One matching a place, the best first: degrees further than apart_m from a better one are of another place. What does
// not fit is left out; a part has at least one degree. The detection stands in one of them, as its first degree. The
// templates of each are those of the detection's whose categories fit best there.
[[nodiscard]] std::vector<Matching> parts_of(const Matching& matching, double apart_m);

// Where a part is: its detection, or else its best degree.
[[nodiscard]] Point place_of(const Matching& part);

}  // namespace cairn
