// What an endpoint offers or wants of a connection, and whether two of them fit.
#pragma once

#include <dds/dds.h>

#include <string>

namespace cairn::ros2_robot {

struct QosProfile {
  bool is_reliable = false;
  dds_durability_kind_t durability = DDS_DURABILITY_VOLATILE;
  dds_duration_t deadline = DDS_INFINITY;
  dds_liveliness_kind_t liveliness = DDS_LIVELINESS_AUTOMATIC;
  dds_duration_t lease = DDS_INFINITY;
};

[[nodiscard]] QosProfile profile_of(const dds_qos_t* qos);
// Of an endpoint of this process.
[[nodiscard]] QosProfile profile_of(dds_entity_t endpoint);

// As ROS names them: "reliable, volatile"; what is not the rule is added.
[[nodiscard]] std::string text_of(const QosProfile& profile);
// The first policy by which a reader does not get what it wants: "reliability: best_effort is offered, reliable
// wanted"; empty: they fit.
[[nodiscard]] std::string misfit_of(const QosProfile& offered, const QosProfile& wanted);

}  // namespace cairn::ros2_robot
