#include "plugins/ros2_robot/dds/qos_profile.hpp"

#include <fmt/format.h>

#include <array>

namespace cairn::ros2_robot {
namespace {

constexpr std::array kDurabilities{"volatile", "transient_local", "transient", "persistent"};
constexpr std::array kLivelinesses{"automatic", "manual_by_participant", "manual_by_topic"};

const char* name_of(dds_durability_kind_t durability) {
  return kDurabilities[static_cast<std::size_t>(durability) % kDurabilities.size()];
}

const char* name_of(dds_liveliness_kind_t liveliness) {
  return kLivelinesses[static_cast<std::size_t>(liveliness) % kLivelinesses.size()];
}

const char* reliability_of(const QosProfile& profile) {
  return profile.is_reliable ? "reliable" : "best_effort";
}

std::string seconds(dds_duration_t duration) {
  return duration == DDS_INFINITY ? "none" : fmt::format("{:g} s", static_cast<double>(duration) / 1e9);
}

std::string misfit(const char* policy, const std::string& offered, const std::string& wanted) {
  return fmt::format("{}: {} is offered, {} wanted", policy, offered, wanted);
}

}  // namespace

QosProfile profile_of(const dds_qos_t* qos) {
  QosProfile profile;
  dds_reliability_kind_t reliability = DDS_RELIABILITY_BEST_EFFORT;
  (void)dds_qget_reliability(qos, &reliability, nullptr);
  profile.is_reliable = reliability == DDS_RELIABILITY_RELIABLE;
  (void)dds_qget_durability(qos, &profile.durability);
  (void)dds_qget_deadline(qos, &profile.deadline);
  (void)dds_qget_liveliness(qos, &profile.liveliness, &profile.lease);
  return profile;
}

QosProfile profile_of(dds_entity_t endpoint) {
  dds_qos_t* const qos = dds_create_qos();
  (void)dds_get_qos(endpoint, qos);
  const QosProfile profile = profile_of(qos);
  dds_delete_qos(qos);
  return profile;
}

std::string text_of(const QosProfile& profile) {
  std::string text = fmt::format("{}, {}", reliability_of(profile), name_of(profile.durability));
  if (profile.deadline != DDS_INFINITY) text += ", deadline " + seconds(profile.deadline);
  if (profile.liveliness != DDS_LIVELINESS_AUTOMATIC || profile.lease != DDS_INFINITY)
    text += fmt::format(", liveliness {} {}", name_of(profile.liveliness), seconds(profile.lease));
  return text;
}

std::string misfit_of(const QosProfile& offered, const QosProfile& wanted) {
  if (wanted.is_reliable && !offered.is_reliable)
    return misfit("reliability", reliability_of(offered), reliability_of(wanted));
  if (wanted.durability > offered.durability)
    return misfit("durability", name_of(offered.durability), name_of(wanted.durability));
  if (wanted.deadline < offered.deadline)
    return misfit("deadline", seconds(offered.deadline), seconds(wanted.deadline));
  if (wanted.liveliness > offered.liveliness)
    return misfit("liveliness", name_of(offered.liveliness), name_of(wanted.liveliness));
  if (wanted.lease < offered.lease)
    return misfit("liveliness_lease_duration", seconds(offered.lease), seconds(wanted.lease));
  return {};
}

}  // namespace cairn::ros2_robot
