#include "maps/landmarks/marker_id.hpp"

#include <gtest/gtest.h>

#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {
namespace {

Landmark tag(MarkerFamily family, int number, const std::string& name = "") {
  Landmark landmark;
  landmark.marker = MarkerId{family, number};
  landmark.name = name;
  return landmark;
}

TEST(MarkerId, ReadsWhatItWrites) {
  for (const MarkerFamily family : kMarkerFamilies) {
    const MarkerId marker{family, 12};
    const auto name = marker_name_in(text_of(marker));
    ASSERT_TRUE(name) << text_of(marker);
    EXPECT_EQ((MarkerId{name->family.value_or(MarkerFamily::tag36h11), name->number}), marker);
    EXPECT_EQ(marker_family_of(name_of(family)), family);
  }
  EXPECT_EQ(text_of({MarkerFamily::tag36h11, 7}), "tag 7");
  EXPECT_EQ(text_of({MarkerFamily::tag25h9, 7}), "tag 25h9 7");
}

TEST(MarkerId, OtherTextsAreNoMarker) {
  for (const char* text : {"", "tag", "tag ", "tag -1", "tag 7 ", "tag seven", "tag 36h12 7", "tag 7.0", "Tag 7", "7",
                           "tag 99999999999999"})
    EXPECT_FALSE(marker_name_in(text)) << text;
}

TEST(MarkerId, ANumberThatNoFamilyHasIsAFaultThatSaysWhichTheyHave) {
  const std::vector<MarkerFamily> two{MarkerFamily::tag36h11, MarkerFamily::tag25h9};
  EXPECT_EQ(number_fault(586, two), "");
  EXPECT_EQ(number_fault(587, two), "36h11 has 0 to 586, 25h9 has 0 to 34");
  EXPECT_EQ(marker_name_fault("tag 2114"), "");
  EXPECT_EQ(marker_name_fault("tag 2115"),
            "there is no such tag: 36h11 has 0 to 586, 25h9 has 0 to 34, standard41h12 has 0 to 2114");
  EXPECT_EQ(marker_name_fault("tag 25h9 34"), "");
  EXPECT_EQ(marker_name_fault("tag 25h9 35"), "there is no such tag: 25h9 has 0 to 34");
  EXPECT_EQ(marker_name_fault("nearest dock"), "") << "no tag's name";
}

TEST(MarkerId, FindsItsLandmarkInAGraph) {
  LandmarkGraph graph;
  const LandmarkId other = graph.add(tag(MarkerFamily::tag25h9, 7));
  const LandmarkId seven = graph.add(tag(MarkerFamily::tag36h11, 7));
  const LandmarkId dock = graph.add(tag(MarkerFamily::tag25h9, 3, "dock"));
  EXPECT_EQ(graph.find_by_name("tag 7")->id, seven);
  EXPECT_EQ(graph.find_by_name("tag 25h9 7")->id, other);
  EXPECT_EQ(graph.find_by_name("tag 3")->id, dock) << "of whatever family";
  EXPECT_EQ(graph.find_by_name("tag 4"), nullptr);
  EXPECT_EQ(label_of(*graph.find(seven)), "tag 7");
  EXPECT_EQ(label_of(*graph.find(dock)), "dock");
}

}  // namespace
}  // namespace cairn
