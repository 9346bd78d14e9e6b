// Which landmarks are printed markers, in the saved map.
#include "maps/store/repair.hpp"
#include "tests/maps/store/store_fixture.hpp"

namespace cairn {
namespace {

using testing::HasSubstr;

SavedMap map_with_markers() {
  SavedMap map = map_of_a_mission();
  Landmark door;
  door.category = "door";
  door.T_map_landmark = {1.0, 2.0, 0.5};
  door.marker = MarkerId{MarkerFamily::tag36h11, 7};
  map.clusters.cluster_of[map.graph.add(door)] = map.clusters.cluster_of.begin()->second;
  door.marker = MarkerId{MarkerFamily::tagStandard41h12, 2114};
  map.graph.retire(map.graph.add(door), "its place was seen free");
  return map;
}

TEST_F(MapStore, KeepsMarkersAsVersionTwo) {
  const SavedMap map = map_with_markers();
  save_map(file(), map);
  expect_equal(load_map(file()), map);
  EXPECT_EQ(load_map(file()).graph, map.graph);
  EXPECT_EQ(schema_version_of(file()), 2);
  EXPECT_EQ(salvage_map(file()).map.graph, map.graph);
}

TEST_F(MapStore, RefusesMarkersThatAreNone) {
  const auto refusal_after = [&](const std::string& sql) {
    save_map(file(), map_with_markers());
    run_sql(file(), sql);
    return refusal_of(file());
  };
  EXPECT_THAT(refusal_after("UPDATE landmark_markers SET number = 8 WHERE number = 7"), HasSubstr("landmark_markers"));
  EXPECT_THAT(refusal_after("UPDATE landmark_markers SET family = '36h12' WHERE number = 7"),
              HasSubstr("landmark_markers"));
  const SalvagedMap salvaged = salvage_map(file());
  EXPECT_EQ(salvaged.map.graph.find_by_name("tag 7"), nullptr) << "of no family that is known";
  EXPECT_EQ(salvaged.map.graph.of_category("door").size(), 1U) << "the landmark itself is left";
}

}  // namespace
}  // namespace cairn
