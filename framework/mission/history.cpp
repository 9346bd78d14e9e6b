#include "framework/mission/history.hpp"

namespace cairn {

void HistoryConfig::describe(Fields<HistoryConfig>& fields) {
  using C = HistoryConfig;
  fields.integer("max_path_poses", &C::max_path_poses, {100.0, 1e7},
                 "poses of the driven path: when there are more, every second one of the older half goes where the "
                 "others still show the way, then the oldest are forgotten");
  fields.integer("max_samples", &C::max_samples, {10.0, 1e7},
                 "samples of each series in the report: when there are more, every second one goes, and from then on "
                 "half as many are taken");
  fields.integer("max_events", &C::max_events, {10.0, 1e7},
                 "events and contacts in the report: when there are more events, the first and the last half of that "
                 "many stay");
}

}  // namespace cairn
