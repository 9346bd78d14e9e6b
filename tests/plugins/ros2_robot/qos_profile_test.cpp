#include "plugins/ros2_robot/dds/qos_profile.hpp"

#include <gtest/gtest.h>

namespace cairn::ros2_robot {
namespace {

QosProfile reliable() {
  QosProfile profile;
  profile.is_reliable = true;
  return profile;
}

TEST(QosProfiles, ThatOfferAsMuchAsIsWantedFit) {
  EXPECT_EQ(misfit_of(reliable(), reliable()), "");
  EXPECT_EQ(misfit_of(reliable(), QosProfile{}), "") << "more than is wanted";
  QosProfile latched = reliable();
  latched.durability = DDS_DURABILITY_TRANSIENT_LOCAL;
  EXPECT_EQ(misfit_of(latched, reliable()), "");
  EXPECT_EQ(misfit_of(latched, latched), "");
}

TEST(QosProfiles, ThatOfferLessAreNamedByTheirPolicy) {
  EXPECT_EQ(misfit_of(QosProfile{}, reliable()), "reliability: best_effort is offered, reliable wanted");
  QosProfile wanted = reliable();
  wanted.durability = DDS_DURABILITY_TRANSIENT_LOCAL;
  EXPECT_EQ(misfit_of(reliable(), wanted), "durability: volatile is offered, transient_local wanted");
  wanted = reliable();
  wanted.deadline = DDS_MSECS(100);
  EXPECT_EQ(misfit_of(reliable(), wanted), "deadline: none is offered, 0.1 s wanted");
  wanted = reliable();
  wanted.liveliness = DDS_LIVELINESS_MANUAL_BY_TOPIC;
  EXPECT_EQ(misfit_of(reliable(), wanted), "liveliness: automatic is offered, manual_by_topic wanted");
  wanted = reliable();
  wanted.lease = DDS_SECS(2);
  EXPECT_EQ(misfit_of(reliable(), wanted), "liveliness_lease_duration: none is offered, 2 s wanted");
}

TEST(QosProfiles, AreSaidAsRosNamesThem) {
  EXPECT_EQ(text_of(QosProfile{}), "best_effort, volatile");
  QosProfile profile = reliable();
  profile.durability = DDS_DURABILITY_TRANSIENT_LOCAL;
  profile.deadline = DDS_MSECS(500);
  profile.lease = DDS_SECS(3);
  EXPECT_EQ(text_of(profile), "reliable, transient_local, deadline 0.5 s, liveliness automatic 3 s");
}

}  // namespace
}  // namespace cairn::ros2_robot
