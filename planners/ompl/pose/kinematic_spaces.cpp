#include "planners/ompl/pose/kinematic_spaces.hpp"

#include <fmt/format.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "maps/base/portable_random.hpp"
#include "planners/common/pose_space/dubins.hpp"
#include "planners/ompl/disc/disc_states.hpp"

namespace cairn {
namespace {

namespace ob = ompl::base;

class MotionSpace {
 public:
  virtual ~MotionSpace() = default;
  [[nodiscard]] virtual Motion motion(const ob::State* from, const ob::State* to) const = 0;
};

// What all three have in common, on top of OMPL's space.
template <class Base>
class SpaceOfMotions : public Base, public MotionSpace {
 public:
  using Base::Base;
  using Base::interpolate;

  void interpolate(const ob::State* from, const ob::State* to, double share, ob::State* state) const override {
    if (share >= 1.0) {
      this->copyState(state, to);
    } else {
      const Motion whole = motion(from, to);
      set_pose(state, whole.pose_at(share * whole.extent_m()));
    }
  }
  // A compound space of 1.5.2 asks its parts, which know the straight line only.
  unsigned validSegmentCount(const ob::State* from, const ob::State* to) const override {
    return this->longestValidSegmentCountFactor_ *
           static_cast<unsigned>(std::ceil(this->distance(from, to) / this->longestValidSegment_));
  }
};

class Differential : public SpaceOfMotions<ob::SE2StateSpace> {
 public:
  explicit Differential(const KinematicRules& rules) : driving_(rules.driving), spot_turn_m_(rules.spot_turn_m) {}

  Motion motion(const ob::State* from, const ob::State* to) const override {
    return turn_drive_turn(pose_of(from), pose_of(to), driving_, spot_turn_m_);
  }
  double distance(const ob::State* from, const ob::State* to) const override {
    return turn_drive_turn_m(pose_of(from), pose_of(to), driving_, spot_turn_m_);
  }
  double getMaximumExtent() const override {
    return getSubspace(0)->getMaximumExtent() + 2.0 * std::numbers::pi * spot_turn_m_;
  }
  bool isMetricSpace() const override { return false; }
  // Driven from its end to its start, a motion is another one, unless the robot reverses as well.
  bool hasSymmetricDistance() const override { return driving_ == Driving::either; }
  bool hasSymmetricInterpolate() const override { return driving_ == Driving::either; }

 private:
  Driving driving_;
  double spot_turn_m_;
};

class Dubins : public SpaceOfMotions<ob::DubinsStateSpace> {
 public:
  using SpaceOfMotions::SpaceOfMotions;

  Motion motion(const ob::State* from, const ob::State* to) const override {
    return dubins_motion(pose_of(from), pose_of(to), rho_, kMotionEnd);
  }
  double distance(const ob::State* from, const ob::State* to) const override {
    return dubins_length_m(pose_of(from), pose_of(to), rho_, kMotionEnd);
  }
};

class ReedsShepp : public SpaceOfMotions<ob::ReedsSheppStateSpace> {
 public:
  using SpaceOfMotions::SpaceOfMotions;

  Motion motion(const ob::State* from, const ob::State* to) const override {
    const ReedsSheppPath word = reedsShepp(from, to);
    Motion motion(pose_of(from));
    for (int i = 0; i < 5; ++i) {
      const double part = word.length_[i];  // in turning radii, negative in reverse
      if (word.type_[i] == RS_STRAIGHT) motion.append(MotionElement::straight(rho_ * part));
      if (word.type_[i] == RS_LEFT) motion.append({rho_ * part, part});
      if (word.type_[i] == RS_RIGHT) motion.append({rho_ * part, -part});
    }
    return motion;
  }
};

const MotionSpace& motions_of(const ob::StateSpace& space) {
  const auto* motions = dynamic_cast<const MotionSpace*>(&space);
  if (motions == nullptr) throw std::logic_error("motion_between: " + space.getName() + " is not a space of motions");
  return *motions;
}

void check_positive(double value, const std::string& name) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw std::invalid_argument(fmt::format("{} must be positive, not {:f}", name, value));
}

std::shared_ptr<ob::SE2StateSpace> space_for(const KinematicRules& rules) {
  switch (rules.kind) {
    case MotionKind::differential:
      check_positive(rules.spot_turn_m, "spot_turn_m");
      return std::make_shared<Differential>(rules);
    case MotionKind::dubins:
      check_positive(rules.turning_radius_m, "turning_radius_m");
      return std::make_shared<Dubins>(rules.turning_radius_m);
    case MotionKind::reeds_shepp:
      check_positive(rules.turning_radius_m, "turning_radius_m");
      return std::make_shared<ReedsShepp>(rules.turning_radius_m);
    case MotionKind::holonomic:
      break;
  }
  throw std::invalid_argument("a disc that may move in any direction has no space of poses");
}

}  // namespace

Pose2 pose_of(const ob::State* state) {
  const auto* pose = state->as<ob::SE2StateSpace::StateType>();
  return {pose->getX(), pose->getY(), pose->getYaw() > -std::numbers::pi ? pose->getYaw() : std::numbers::pi};
}

void set_pose(ob::State* state, const Pose2& pose) {
  auto* values = state->as<ob::SE2StateSpace::StateType>();
  values->setXY(pose.x_m, pose.y_m);
  // OMPL's headings end short of half a turn; ours begin behind it. At the wrong one OMPL aborts.
  const double yaw_rad = wrap_angle(pose.theta_rad);
  values->setYaw(yaw_rad < std::numbers::pi ? yaw_rad : -std::numbers::pi);
}

std::shared_ptr<ob::SE2StateSpace> make_kinematic_space(const KinematicRules& rules, const DistanceField& field) {
  auto space = space_for(rules);
  space->setBounds(bounds_of(field));
  return space;
}

Motion motion_between(const ob::StateSpace& space, const ob::State* from, const ob::State* to) {
  return motions_of(space).motion(from, to);
}

Motion motion_between(const ob::StateSpace& space, const Pose2& from, const Pose2& to) {
  ob::State* const states[] = {space.allocState(), space.allocState()};
  set_pose(states[0], from);
  set_pose(states[1], to);
  Motion motion = motion_between(space, states[0], states[1]);
  for (ob::State* state : states) space.freeState(state);
  return motion;
}

PoseMotionValidator::PoseMotionValidator(const ob::SpaceInformationPtr& info, const PoseSpace& poses)
    : MotionValidator(info), poses_(&poses) {}

bool PoseMotionValidator::checkMotion(const ob::State* from, const ob::State* to) const {
  const Motion motion = motion_between(*si_->getStateSpace(), from, to);
  return motion.ends_at(pose_of(to), kMotionEnd) && poses_->fits_along(motion);
}

bool PoseMotionValidator::checkMotion(const ob::State* from, const ob::State* to,
                                      std::pair<ob::State*, double>& last_valid) const {
  if (checkMotion(from, to)) return true;
  const Motion motion = motion_between(*si_->getStateSpace(), from, to);
  last_valid.second = motion.ends_at(pose_of(to), kMotionEnd) ? poses_->share_that_fits(motion) : 0.0;
  if (last_valid.first != nullptr) set_pose(last_valid.first, motion.pose_at(last_valid.second * motion.extent_m()));
  return false;
}

ob::SpaceInformationPtr kinematic_information(const KinematicRules& rules, const PoseSpace& poses, const PoseDraw& draw,
                                              std::uint64_t seed) {
  const DistanceField& field = poses.ground().field();
  const auto space = make_kinematic_space(rules, field);
  auto samplers = std::make_shared<std::uint64_t>(0);
  space->setStateSamplerAllocator([&field, &draw, seed, samplers](const ob::StateSpace* of) {
    return std::make_shared<PoseSampler>(of, field, draw, mixed_seed(mixed_seed(seed) + ++*samplers));
  });
  auto info = std::make_shared<ob::SpaceInformation>(space);
  info->setStateValidityChecker([&poses](const ob::State* state) { return poses.fits(pose_of(state)); });
  info->setMotionValidator(std::make_shared<PoseMotionValidator>(info, poses));
  // For what still counts in steps: half a cell.
  info->setStateValidityCheckingResolution(0.5 * field.cell_m() / space->getMaximumExtent());
  info->setup();
  return info;
}

}  // namespace cairn
