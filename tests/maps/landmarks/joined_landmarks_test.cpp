#include "maps/landmarks/joined_landmarks.hpp"

#include <gtest/gtest.h>

#include "tests/maps/drawn_graph.hpp"

namespace cairn {
namespace {

TEST(JoinedLandmarks, ASetGoesByItsLowestId) {
  JoinedLandmarks joined;
  EXPECT_EQ(joined.set_of(7), 7);
  EXPECT_TRUE(joined.join(7, 9));
  EXPECT_TRUE(joined.join(9, 4));
  EXPECT_FALSE(joined.join(4, 7)) << "already";
  EXPECT_EQ(joined.set_of(9), 4);
  EXPECT_TRUE(joined.are_joined(7, 4));
  EXPECT_FALSE(joined.are_joined(7, 5));
}

TEST(JoinedLandmarks, OpenRoutesJoinWhicheverWayTheyLead) {
  LandmarkGraph graph = drawn_graph("1>2 3>2 4>5");
  graph.set_closed(3, true);
  JoinedLandmarks joined = joined_by_routes(graph);
  EXPECT_TRUE(joined.are_joined(1, 3));
  EXPECT_FALSE(joined.are_joined(4, 5)) << "closed";
}

}  // namespace
}  // namespace cairn
