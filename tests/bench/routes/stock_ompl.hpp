// OMPL as its users set it up: SimpleSetup, a plane, its own discrete motion validator, its own sampler.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "planners/common/disc_space/disc_space.hpp"

namespace cairn {

using StraightMotion = std::pair<Point, Point>;

// Where the disc fits, exactly, in one of the two ways that users write it:
enum class StockValidity {
  by_distance_field,  // the one that Cairn's own checks use: mostly one look-up a state
  by_cells,           // every cell about the disc is looked at
};

struct StockAnswer {
  bool exact = false;
  std::vector<Point> path;
  double length_m = 0.0;  // of the path
  double took_s = 0.0;    // with making and setting up planner and space
};

class StockOmpl {
 public:
  // step_m: between the states that the motion validator looks at; 0: OMPL's own, 1 % of the map's extent.
  // The space must outlive this.
  StockOmpl(const DiscSpace& space, double radius_m, double step_m,
            StockValidity validity = StockValidity::by_distance_field);
  ~StockOmpl();
  StockOmpl(const StockOmpl&) = delete;
  StockOmpl& operator=(const StockOmpl&) = delete;

  [[nodiscard]] double step_m() const;
  // How many of the motions the validator takes for valid.
  [[nodiscard]] std::size_t count_valid(const std::vector<StraightMotion>& motions) const;
  // Until the path is no longer than enough_m or the time is over. RRTConnect's are simplified, and it begins anew as
  // long as they are too long. Planners: BITstar, InformedRRTstar, RRTstar, RRTConnect.
  [[nodiscard]] StockAnswer solve(const std::string& planner, const StraightMotion& ends, double enough_m,
                                  double limit_s) const;
  // The first motions that the planner asks about on the way to a solution, and after it.
  [[nodiscard]] std::vector<StraightMotion> motions_asked(const std::string& planner, const StraightMotion& ends,
                                                          std::size_t count, double limit_s) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace cairn
