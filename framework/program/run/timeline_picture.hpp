// A run as a timeline: a row for each node that ran.
#pragma once

#include "framework/mission/runner.hpp"
#include "framework/reporting/timeline.hpp"
#include "maps/pictures/timeline_picture.hpp"

namespace cairn {

// Deep nodes are left out when there are more rows than a picture holds; its subtitle says so.
[[nodiscard]] Timeline timeline_of(const Mission& mission, const MissionResult& result, const RunTimeline& beside);

}  // namespace cairn
