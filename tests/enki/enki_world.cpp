#include "tests/enki/enki_world.hpp"

#include <enki/PhysicalEngine.h>
#include <enki/interactions/IRSensor.h>
#include <enki/robots/DifferentialWheeled.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "framework/live/steady_time.hpp"

namespace cairn::enki {
namespace {

constexpr double kCm = 100.0;       // of Enki in a metre
constexpr double kWheels_m = 0.33;  // apart
constexpr double kMaxSpeed_mps = 1.2;
constexpr double kWheelNoise = 0.02;
constexpr double kHeight_cm = 25.0;
constexpr double kMass_g = 9000.0;
constexpr double kStandsFast = -1.0;  // for a mass
constexpr double kOnTheBorder_m = 1e-6;

class Robot : public Enki::DifferentialWheeled {
 public:
  explicit Robot(const RobotModel& model) : DifferentialWheeled(kWheels_m * kCm, kMaxSpeed_mps * kCm, kWheelNoise) {
    setCylindric(model.radius_m * kCm, kHeight_cm, kMass_g);
    sonars_.reserve(model.sonars.size());
    for (const SonarModel& sonar : model.sonars) {
      const Pose2& at = sonar.T_robot_sonar;
      sonars_.push_back(std::make_unique<Enki::IRSensor>(this, Enki::Vector(at.x_m * kCm, at.y_m * kCm), 20.0,
                                                         at.theta_rad, sonar.max_m * kCm, 1000.0, 0.0, 20.0));
      addLocalInteraction(sonars_.back().get());
    }
  }
  [[nodiscard]] int sonars() const { return static_cast<int>(sonars_.size()); }
  // The nearest of its rays.
  [[nodiscard]] double range_m(std::size_t sonar) const {
    double nearest_cm = std::numeric_limits<double>::infinity();
    for (unsigned ray = 0; ray < sonars_[sonar]->getRayCount(); ++ray) {
      const double cm = sonars_[sonar]->getRayDist(ray);
      if (cm < sonars_[sonar]->getRange()) nearest_cm = std::min(nearest_cm, std::max(0.0, cm));
    }
    return nearest_cm / kCm;
  }
  void collisionEvent(PhysicalObject* /*other*/) override { ++touches; }

  int touches = 0;

 private:
  std::vector<std::unique_ptr<Enki::IRSensor>> sonars_;
};

bool turns_left_everywhere(const std::vector<Point>& corners_m) {
  for (std::size_t i = 0; i < corners_m.size(); ++i) {
    const Point& corner = corners_m[(i + 1) % corners_m.size()];
    const Point to = corner - corners_m[i];
    const Point on = corners_m[(i + 2) % corners_m.size()] - corner;
    if (to.x() * on.y() - to.y() * on.x() <= 0.0) return false;
  }
  return true;
}

const World& checked_world_of(const Mission& mission) {
  if (!mission.world) throw std::invalid_argument("the mission has no world");
  const World& world = *mission.world;
  if (world.min_m != Point(0.0, 0.0)) throw std::invalid_argument("a world of Enki begins at [0, 0]");
  if (!world.doors.empty() || !world.movers.empty()) throw std::invalid_argument("nothing moves in Enki but the robot");
  for (const WorldWall& wall : world.walls)
    for (const Point& p : wall.points_m)
      if ((p - world.min_m).minCoeff() > kOnTheBorder_m && (world.max_m - p).minCoeff() > kOnTheBorder_m)
        throw std::invalid_argument("walls inside the bounds are thin: draw them as polygons for Enki");
  return world;
}

class EnkiWorld : public p2os_robot::PioneerBody {
 public:
  EnkiWorld(const Mission& mission, const std::filesystem::path& log)
      : world_(checked_world_of(mission).max_m.x() * kCm, mission.world->max_m.y() * kCm), log_(log) {
    world_.setRandomSeed(static_cast<unsigned long>(mission.config.seed));
    log_ << "monotonic_s,x_m,y_m,angle_deg,v_mps,touches\n";
    for (const WorldObject& object : mission.world->objects) add(object);
    robot_ = new Robot(mission.robot);  // the world deletes what is in it
    robot_->pos = Enki::Point(mission.config.start.at_m.x() * kCm, mission.config.start.at_m.y() * kCm);
    robot_->angle = mission.config.start.angle_rad;
    world_.addObject(robot_);
    world_.step(1e-3);
  }
  void drive(const Twist& twist, double dt_s) override {
    robot_->leftSpeed = (twist.v_mps - 0.5 * kWheels_m * twist.w_radps) * kCm;
    robot_->rightSpeed = (twist.v_mps + 0.5 * kWheels_m * twist.w_radps) * kCm;
    const double left_cm = robot_->leftOdometry;
    const double right_cm = robot_->rightOdometry;
    const int touches = robot_->touches;
    world_.step(dt_s, 4);
    const double left_m = (robot_->leftOdometry - left_cm) / kCm;
    const double right_m = (robot_->rightOdometry - right_cm) / kCm;
    const double turned_rad = (right_m - left_m) / kWheels_m;
    const double ahead_m = 0.5 * (left_m + right_m);
    odometry_.x_m += ahead_m * std::cos(odometry_.theta_rad + 0.5 * turned_rad);
    odometry_.y_m += ahead_m * std::sin(odometry_.theta_rad + 0.5 * turned_rad);
    odometry_.theta_rad += turned_rad;
    is_bumped_ = robot_->touches != touches;
    const double now_s = live::now_s();
    if (now_s - logged_s_ < 0.1) return;
    logged_s_ = now_s;
    log_ << now_s << "," << robot_->pos.x / kCm << "," << robot_->pos.y / kCm << ","
         << robot_->angle * 180.0 / std::numbers::pi << "," << ahead_m / dt_s << "," << robot_->touches << "\n"
         << std::flush;
  }
  [[nodiscard]] Pose2 odometry() const override { return odometry_; }
  [[nodiscard]] int sonars() const override { return robot_->sonars(); }
  [[nodiscard]] double range_m(int sonar) override { return robot_->range_m(static_cast<std::size_t>(sonar)); }
  [[nodiscard]] bool is_bumped() const override { return is_bumped_; }

 private:
  void add(const WorldObject& object) {
    if (object.contour.is_circle()) {
      auto* circle = new Enki::PhysicalObject;
      circle->setCylindric(0.5 * object.contour.circle_diameter_m * kCm, kHeight_cm, kStandsFast);
      put(circle, object.T_map_object.position());
    }
    for (const std::vector<Point>& corners_m : object.contour.polygons_m) {
      if (!turns_left_everywhere(corners_m)) throw std::invalid_argument("Enki has no outlines that turn inwards");
      // Enki turns and moves a body about its centre of mass.
      const Point centre_m = object.T_map_object * Contour::polygon_in_place(corners_m).centroid_m();
      Enki::Polygon shape;
      for (const Point& corner : corners_m) {
        const Point from_centre_cm = (object.T_map_object * corner - centre_m) * kCm;
        shape.push_back(Enki::Point(from_centre_cm.x(), from_centre_cm.y()));
      }
      auto* body = new Enki::PhysicalObject;
      body->setCustomHull(Enki::PhysicalObject::Part(shape, kHeight_cm), kStandsFast);
      put(body, centre_m);
    }
  }
  void put(Enki::PhysicalObject* body, const Point& at_m) {
    body->pos = Enki::Point(at_m.x() * kCm, at_m.y() * kCm);
    world_.addObject(body);
  }

  Enki::World world_;
  Robot* robot_ = nullptr;
  Pose2 odometry_;
  bool is_bumped_ = false;
  std::ofstream log_;
  double logged_s_ = 0.0;
};

}  // namespace

std::unique_ptr<p2os_robot::PioneerBody> robot_in_its_world(const Mission& mission, const std::filesystem::path& log) {
  return std::make_unique<EnkiWorld>(mission, log);
}

}  // namespace cairn::enki
