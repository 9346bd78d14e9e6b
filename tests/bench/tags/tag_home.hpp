// Random homes with tags, and places in them from which pictures of the tags are taken.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/world.hpp"
#include "framework/experiments/homes/home.hpp"

namespace cairn {

struct PhotoPlan {
  int tags = 10;     // in each home
  int per_ring = 3;  // pictures of each tag from each metre of distance, up to 4 m
};

struct TaggedHome {
  Home home;
  World world;
};

// Throws ConfigError.
[[nodiscard]] TaggedHome tagged_home(const PhotoPlan& plan, std::uint64_t seed);

// Of each tag in turn: from places that a robot gets to and that have it within sight at up to 60 degrees aslant, the
// camera turned up to 20 degrees off it. Fewer where there are no such places.
[[nodiscard]] std::vector<Pose2> photo_places(const PhotoPlan& plan, const TaggedHome& home, const CameraModel& camera,
                                              std::uint64_t seed);

}  // namespace cairn
