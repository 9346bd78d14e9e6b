// Streams of matchings for the association of detections with landmarks, made of recorded ones.
//
// A recorded sight is what the template matcher has said of one landmark in a simulated run: where it placed it, how it
// turned it, the degrees of all categories and its template set. A stream visits landmarks in turn; each of its
// matchings is a recorded one, moved to where the landmark is and by the error of the pose.
#pragma once

#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "framework/contracts/detector.hpp"
#include "framework/contracts/localizer.hpp"
#include "maps/geometry/contour.hpp"

namespace cairn::bench {

// In the landmark's own frame.
struct RecordedSight {
  std::string category;  // of the landmark
  int nth = 0;           // sight of this landmark, from 0
  Detection detection;
  std::vector<CategoryDegree> degrees;
};

// One a line. Throws std::runtime_error when a line cannot be read.
void write_sights(const std::filesystem::path& file, const std::vector<RecordedSight>& sights);
[[nodiscard]] std::vector<RecordedSight> read_sights(const std::filesystem::path& file);

struct SceneObject {
  std::string category;
  Pose2 T_map_object;
};

struct Scene {
  std::string name;
  std::vector<LandmarkShape> shapes;
  std::vector<SceneObject> objects;  // those next to each other are visited together
  double visit_m = 2.0;              // objects no further apart than this are seen at one visit
  bool begins_wrong = false;         // the first sights of an object name another category
};

// The pose error wanders: its standard deviation is that of the distance, and it forgets as a first-order process.
struct PoseErrorModel {
  double error_m = 0.3;
  double forgets_after_visits = 1.5;
  double reported_ratio = 1.0;  // of the standard deviation that the localizer reports
};

struct StreamItem {
  PoseEstimate pose;
  Matching matching;
  int object = 0;
};

[[nodiscard]] std::vector<StreamItem> stream_of(const Scene& scene, const PoseErrorModel& error,
                                                const std::vector<RecordedSight>& sights, std::uint64_t seed);

}  // namespace cairn::bench
