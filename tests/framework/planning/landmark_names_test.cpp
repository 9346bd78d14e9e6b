#include "framework/planning/landmark_names.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(LandmarkNames, ANameMustFindWhatItNamesAndNothingElse) {
  LandmarkGraph graph;
  Landmark desk;
  desk.name = "desk";
  graph.add(desk);
  ClusterTree clusters;
  Cluster kitchen;
  kitchen.id = 1;
  kitchen.name = "kitchen";
  kitchen.level = 1;
  kitchen.anchor = 1;
  clusters.clusters[1] = kitchen;
  const auto refusal = [&](const std::string& name) { return refusal_of_name(name, graph, clusters, nullptr); };
  EXPECT_EQ(refusal("sofa"), "");
  EXPECT_EQ(refusal("Küche"), "");
  EXPECT_EQ(refusal(""), "it is empty");
  EXPECT_EQ(refusal(std::string(201, 'a')), "it is longer than 200 bytes");
  EXPECT_EQ(refusal("\xff"), "it is not UTF-8 text");
  EXPECT_EQ(refusal("a\nb"), "it holds a control character");
  EXPECT_EQ(refusal(" sofa"), "it begins or ends with a blank");
  EXPECT_EQ(refusal("L12"), "it looks like an id");
  EXPECT_EQ(refusal("nearest square"), "it reads as a place: x,y or nearest CATEGORY");
  EXPECT_EQ(refusal("desk"), "landmark L1 has it");
  EXPECT_EQ(refusal("kitchen"), "cluster C1:L1 has it");
  EXPECT_EQ(refusal_of_name("desk", graph, clusters, &graph.find(1)->name), "") << "it may keep its own";
}

}  // namespace
}  // namespace cairn
