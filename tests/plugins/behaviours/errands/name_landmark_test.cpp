#include "plugins/behaviours/errands/name_landmark.hpp"

#include <gmock/gmock.h>

#include "maps/hierarchy/hierarchies.hpp"
#include "tests/plugins/behaviours/fake_host.hpp"
#include "tests/plugins/behaviours/written_config.hpp"

namespace cairn::behaviours {
namespace {

using testing::HasSubstr;

const std::string kRoom = R"(
  ##########
  #........#
  #.R......#
  #........#
  ##########
)";

// L1 and L3 are squares, L2 is a circle between them.
FakeHost room() {
  FakeHost host(kRoom, {.all_known = true});
  host.graph.add(landmark_at("square", {0.2, 0.2, 0.0}, {0.2, 0.2, 0.0}));
  host.graph.add(landmark_at("circle", {0.4, 0.2, 0.0}, {0.4, 0.2, 0.0}));
  host.graph.add(landmark_at("square", {0.8, 0.2, 0.0}, {0.8, 0.2, 0.0}));
  return host;
}

NameLandmark naming(const std::string& yaml) {
  return NameLandmark(config_of<NameConfig>(yaml));
}

Status named(FakeHost& host, const std::string& yaml) {
  NameLandmark step = naming(yaml);
  return host.tick(step);
}

LandmarkId id_of(const FakeHost& host, const std::string& name) {
  const Landmark* const landmark = host.graph.find_by_name(name);
  return landmark == nullptr ? 0 : landmark->id;
}

TEST(NameLandmark, NamesTheOneThatAnIdNames) {
  FakeHost host = room();
  const Status status = named(host, "{landmark: L2, as: stove}");
  EXPECT_EQ(status.state, StepState::success) << status.reason;
  EXPECT_EQ(id_of(host, "stove"), 2);
}

TEST(NameLandmark, OfACategoryNamesTheOneWithTheCheapestPath) {
  FakeHost host = room();
  EXPECT_EQ(named(host, "{landmark: nearest square, as: sofa}").state, StepState::success);
  EXPECT_EQ(id_of(host, "sofa"), 1) << "the robot stands at (0.25, 0.25)";
}

TEST(NameLandmark, WithoutAWordOnWhichItNamesTheOneFoundLast) {
  FakeHost host = room();
  EXPECT_EQ(named(host, "{as: desk}").state, StepState::success);
  EXPECT_EQ(id_of(host, "desk"), 3);
}

TEST(NameLandmark, OfWhatAStepHasGivenNamesTheOneFoundLastThatIsStillKnown) {
  FakeHost host = room();
  host.values["found"] = Place{std::nullopt, false, {1, 2, 9}};
  EXPECT_EQ(named(host, "{input: found, as: desk}").state, StepState::success);
  EXPECT_EQ(id_of(host, "desk"), 2);
}

TEST(NameLandmark, NearAPointNamesTheNearestOfThoseThatAreMeant) {
  FakeHost host = room();
  EXPECT_EQ(named(host, "{near_m: [0.45, 0.2], as: stove}").state, StepState::success);
  EXPECT_EQ(id_of(host, "stove"), 2);
  EXPECT_EQ(named(host, "{landmark: square, near_m: [0.45, 0.2], as: sofa}").state, StepState::success);
  EXPECT_EQ(id_of(host, "sofa"), 1);
}

TEST(NameLandmark, TooFarFromThePointItSaysWhichIsTheNearest) {
  FakeHost host = room();
  const Status status = named(host, "{landmark: circle, near_m: [0.4, 0.7], within_m: 0.2, as: stove}");
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_EQ(status.reason,
            "names nothing stove: no landmark \"circle\" within 0.20 m of (0.40, 0.70): the nearest, L2 (circle) is "
            "0.50 m away");
  EXPECT_EQ(id_of(host, "stove"), 0);
}

TEST(NameLandmark, OfAClusterNamesTheClusterUnlessAPointChoosesOneOfItsLandmarks) {
  FakeHost host = room();
  const ClusterTree clusters{{{1, {1, 1, 0, 2, ""}}, {2, {2, 1, 0, 3, "den"}}}, {{1, 1}, {2, 1}, {3, 2}}, 3};
  const Hierarchies hierarchies(host.graph, clusters, {});
  host.hierarchies = &hierarchies;
  EXPECT_EQ(named(host, "{landmark: C1:L2, as: lounge}"), (Status{StepState::success, "C1:L2 is now lounge"}));
  EXPECT_EQ(named(host, "{landmark: den, as: study}").state, StepState::success);
  EXPECT_THAT(host.named_clusters, testing::ElementsAre("C1:L2 lounge", "den study"));
  EXPECT_EQ(id_of(host, "lounge"), 0) << "none of its landmarks has the name";
  EXPECT_EQ(named(host, "{landmark: C1:L2, near_m: [0.2, 0.2], as: sofa}").state, StepState::success);
  EXPECT_EQ(id_of(host, "sofa"), 1);
  EXPECT_EQ(named(host, "{landmark: L2, as: stove}").state, StepState::success);
  EXPECT_EQ(id_of(host, "stove"), 2);
  EXPECT_EQ(host.named_clusters.size(), 2U);
}

TEST(NameLandmark, WithoutSuchALandmarkFailsAndSaysWhatThereIs) {
  FakeHost host = room();
  const Status unknown = named(host, "{landmark: nearest triangle, as: lamp}");
  EXPECT_EQ(unknown.state, StepState::failure);
  EXPECT_THAT(unknown.reason, HasSubstr("no landmark of category \"triangle\""));
  const Status not_given = named(host, "{input: found, as: lamp}");
  EXPECT_EQ(not_given.state, StepState::failure);
  EXPECT_THAT(not_given.reason, HasSubstr("no step has given the place \"found\" yet"));
  FakeHost empty(kRoom, {.all_known = true});
  EXPECT_EQ(named(empty, "{as: lamp}").reason, "names nothing lamp: the map holds no landmark");
}

TEST(NameLandmark, ANameThatMeansSomethingElseIsAnErrorWithItsPlace) {
  const auto error = [](const std::string& yaml) { return error_of([&] { (void)naming(yaml); }); };
  EXPECT_EQ(error("{as: nearest square}"),
            "mission.yaml:1:6: as: \"nearest square\" is no name: it means a landmark of a category");
  EXPECT_EQ(error("{as: L4}"), "mission.yaml:1:6: as: \"L4\" is no name: it looks like an id");
  EXPECT_THAT(error("{as: '1,2'}"), HasSubstr("mission.yaml:1:6: as: "));
  EXPECT_THAT(error("{as: ''}"), HasSubstr("mission.yaml:1:6: as: "));
  EXPECT_THAT(error("{landmark: L1}"), HasSubstr("as"));
  EXPECT_THAT(error("{landmark: L1, input: found, as: sofa}"), HasSubstr("landmark and input exclude each other"));
}

}  // namespace
}  // namespace cairn::behaviours
