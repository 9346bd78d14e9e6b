// OMPL's view of robots that cannot slide sideways: states are poses, and between two of them there is
// one motion that the robot can drive (planners/pose_space/motion.hpp).
//
// The spaces derive from those of OMPL 1.5.2. Repaired here: validSegmentCount() counted a share of the
// straight line, and a Dubins motion to a place on another one ended up to micrometres beside it.
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateSampler.h>
#include <ompl/base/spaces/SE2StateSpace.h>

#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "planners/common/any_angle/numbered_cells.hpp"
#include "planners/common/pose_space/pose_space.hpp"
#include "planners/ompl/pose/motion_kind.hpp"

namespace cairn {

inline constexpr double kMotionEnd = 1e-9;  // metres and radians

struct KinematicRules {
  MotionKind kind = MotionKind::reeds_shepp;
  double turning_radius_m = 1.0;        // dubins, reeds_shepp
  Driving driving = Driving::forwards;  // differential
  double spot_turn_m = 0.3;             // differential: metres that a radian turned on the spot counts
};

[[nodiscard]] Pose2 pose_of(const ompl::base::State* state);
void set_pose(ompl::base::State* state, const Pose2& pose);

// Bounds: the box of the distance field. Throws std::invalid_argument for `disc`, or unless
// turning_radius_m and spot_turn_m are positive.
[[nodiscard]] std::shared_ptr<ompl::base::SE2StateSpace> make_kinematic_space(const KinematicRules& rules,
                                                                              const DistanceField& field);
// In a space that make_kinematic_space() made: from exactly the first to kMotionEnd of the second, its
// extent_m() being the space's distance. Should rounding leave no such motion, which takes poses that are
// nearly but not quite alike, it ends elsewhere: Motion::ends_at() detects it, and the validator refuses it.
[[nodiscard]] Motion motion_between(const ompl::base::StateSpace& space, const ompl::base::State* from,
                                    const ompl::base::State* to);
[[nodiscard]] Motion motion_between(const ompl::base::StateSpace& space, const Pose2& from, const Pose2& to);

// Whole motions, at every instant of them; OMPL's own validators sample.
class PoseMotionValidator : public ompl::base::MotionValidator {
 public:
  PoseMotionValidator(const ompl::base::SpaceInformationPtr& info, const PoseSpace& poses);

  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to) const override;
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                   std::pair<ompl::base::State*, double>& last_valid) const override;

 private:
  const PoseSpace* poses_;
};

// Where poses are drawn from: evenly over cells with any heading, and a share of them about a route.
struct PoseDraw {
  NumberedCells cells;            // not empty
  std::vector<Point> guide;       // corners of the route; no share with fewer than two
  double guide_share = 0.0;       // of the draws
  double guide_width_m = 0.5;     // not further beside the route, along each axis
  double guide_spread_rad = 0.5;  // not further from its direction
};

// From its own generator: the same draws for the same seed, whatever else runs.
class PoseSampler : public ompl::base::StateSampler {
 public:
  PoseSampler(const ompl::base::StateSpace* space, const DistanceField& field, const PoseDraw& draw,
              std::uint64_t seed);

  void sampleUniform(ompl::base::State* state) override;
  // Headings as far off as positions, a radian for a metre.
  void sampleUniformNear(ompl::base::State* state, const ompl::base::State* near, double distance_m) override;
  void sampleGaussian(ompl::base::State* state, const ompl::base::State* mean, double deviation_m) override;

 private:
  [[nodiscard]] double unit();  // [0, 1)
  [[nodiscard]] double symmetric(double most) { return most * (2.0 * unit() - 1.0); }
  [[nodiscard]] Pose2 near_guide();

  const DistanceField* field_;
  const PoseDraw* draw_;
  std::vector<double> guide_ends_m_;  // length of the route up to the end of each of its segments
  std::mt19937_64 generator_;
};

// Space, sampler and validators put together and set up; keeps references to `poses` and `draw`.
// The n-th sampler that a planner asks for draws from a stream of its own that hangs on seed and n.
[[nodiscard]] ompl::base::SpaceInformationPtr kinematic_information(const KinematicRules& rules, const PoseSpace& poses,
                                                                    const PoseDraw& draw, std::uint64_t seed);

}  // namespace cairn
