// Which landmarks of a graph might be joined by routes, and how long the travel between them is.
#pragma once

#include <utility>
#include <vector>

#include "maps/grid/travel_regions.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

using RouteEnds = std::pair<LandmarkId, LandmarkId>;  // the lower id first

// The landmarks of level 0 with approach poses, as places on a disc lattice. Two whose travel regions meet are a
// candidate, and the candidates alone join all that the lattice joins. O(cells log cells) to build.
class JoinCandidates {
 public:
  JoinCandidates(const LandmarkGraph& graph, const OccupancyGrid& grid, const DiscLattice& lattice);

  struct Candidate {
    RouteEnds pair;
    double length_m = 0.0;  // of the travel
  };
  [[nodiscard]] const std::vector<Candidate>& by_length() const { return by_length_; }
  // Each landmark with its `nearest` others by travel over regions that meet, and a minimum spanning set, so that all
  // landmarks between which the lattice has a way are joined. By rising ids.
  [[nodiscard]] std::vector<RouteEnds> wanted(int nearest) const;
  // The travel of by_length()[i], from the lower id to the higher.
  [[nodiscard]] std::vector<Cell> path_of(std::size_t i) const { return regions_.path_across(regions_.borders()[i]); }

 private:
  std::vector<LandmarkId> ids_;  // by place
  TravelRegions regions_;
  std::vector<Candidate> by_length_;  // as the borders
};

}  // namespace cairn
