// Which of a world's tags a robot has had within sight, by the truth, and which of them its map has.
#pragma once

#include <map>
#include <vector>

#include "framework/contracts/world.hpp"
#include "framework/experiments/homes/tag_sight.hpp"
#include "framework/mission/events.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

struct TagVerdict {
  int hung = 0;
  int in_sight = 0;
  int found = 0;            // of those that were in sight, in the map
  int found_besides = 0;    // others of the world, in the map: seen from farther away, or more aslant
  int false_landmarks = 0;  // in the map: of no tag of the world, or too far from it
  int sightings = 0;
  int false_sightings = 0;               // of no tag of the world
  std::vector<double> position_error_m;  // in the map, of each that was found
  std::vector<double> direction_error_deg;
};

class TagRecord : public Listener {
 public:
  explicit TagRecord(const World& world) : world_(world), sight_(world) {}

  // Notes the pictures of ticks in which the truth is known.
  void on(const Event& event, const MissionView& view) override;

  // A tag was in sight when it was so in pictures from at least three places 0.2 m apart, from at most 3 m and at most
  // 60 degrees aslant. tolerance_m: a landmark further from its tag is false.
  [[nodiscard]] TagVerdict verdict(const LandmarkGraph& graph, double tolerance_m) const;

 private:
  [[nodiscard]] bool was_in_sight(const MarkerId& marker) const;

  World world_;
  TagSight sight_;
  std::map<MarkerId, std::vector<Point>> seen_from_m_;
  int sightings_ = 0;
  int false_sightings_ = 0;
};

}  // namespace cairn
