#include "tests/enki/enki_world.hpp"

#include <enki/PhysicalEngine.h>
#include <enki/interactions/IRSensor.h>
#include <enki/robots/DifferentialWheeled.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <vector>

#include "framework/live/steady_time.hpp"

namespace cairn::enki {
namespace {

constexpr double kCm = 100.0;  // of Enki in a metre
constexpr double kRadius_m = 0.25;
constexpr double kWheels_m = 0.33;  // apart
constexpr double kMaxSpeed_mps = 1.2;
constexpr double kWheelNoise = 0.02;
constexpr double kRange_m = 5.0;
constexpr double kHeight_cm = 25.0;

struct Mounted {
  double x_m;
  double y_m;
  double angle_deg;
};
// As in config/robots/pioneer3dx.yaml.
constexpr Mounted kSonars[] = {
    {0.069, 0.136, 90},    {0.114, 0.119, 50},     {0.148, 0.078, 30},     {0.166, 0.027, 10},
    {0.166, -0.027, -10},  {0.148, -0.078, -30},   {0.114, -0.119, -50},   {0.069, -0.136, -90},
    {-0.157, -0.136, -90}, {-0.203, -0.119, -130}, {-0.237, -0.078, -150}, {-0.255, -0.027, -170},
    {-0.255, 0.027, 170},  {-0.237, 0.078, 150},   {-0.203, 0.119, 130},   {-0.157, 0.136, 90}};

class Pioneer : public Enki::DifferentialWheeled {
 public:
  Pioneer() : DifferentialWheeled(kWheels_m * kCm, kMaxSpeed_mps * kCm, kWheelNoise) {
    setCylindric(kRadius_m * kCm, kHeight_cm, 9000.0);
    for (const Mounted& at : kSonars) {
      sonars_.push_back(std::make_unique<Enki::IRSensor>(this, Enki::Vector(at.x_m * kCm, at.y_m * kCm), 20.0,
                                                         at.angle_deg * std::numbers::pi / 180.0, kRange_m * kCm,
                                                         1000.0, 0.0, 20.0));
      addLocalInteraction(sonars_.back().get());
    }
  }
  // The nearest of its rays.
  [[nodiscard]] double range_m(std::size_t sonar) const {
    double nearest_cm = std::numeric_limits<double>::infinity();
    for (unsigned ray = 0; ray < 3; ++ray) {
      const double cm = sonars_[sonar]->getRayDist(ray);
      if (cm < kRange_m * kCm) nearest_cm = std::min(nearest_cm, std::max(0.0, cm));
    }
    return nearest_cm / kCm;
  }
  void collisionEvent(PhysicalObject* /*other*/) override { ++touches; }

  int touches = 0;

 private:
  std::vector<std::unique_ptr<Enki::IRSensor>> sonars_;
};

class EnkiWorld : public p2os_robot::PioneerBody {
 public:
  explicit EnkiWorld(const std::filesystem::path& log) : world_(8.0 * kCm, 4.0 * kCm), log_(log) {
    log_ << "monotonic_s,x_m,y_m,angle_deg,v_mps,touches\n";
    add_box(4.0, 0.75, 0.1, 1.5);  // the wall between the rooms, with a door of 1 m from y = 1.5 m on
    add_box(4.0, 3.25, 0.1, 1.5);
    add_box(2.6, 2.7, 0.5, 0.5);
    add_box(6.2, 2.4, 0.5, 0.5);
    auto* circle = new Enki::PhysicalObject;
    circle->setCylindric(0.25 * kCm, kHeight_cm, -1.0);
    circle->pos = Enki::Point(1.6 * kCm, 1.3 * kCm);
    world_.addObject(circle);
    pioneer_ = new Pioneer;  // the world deletes what is in it
    pioneer_->pos = Enki::Point(0.7 * kCm, 0.7 * kCm);
    world_.addObject(pioneer_);
    world_.step(1e-3);
  }
  void drive(const Twist& twist, double dt_s) override {
    pioneer_->leftSpeed = (twist.v_mps - 0.5 * kWheels_m * twist.w_radps) * kCm;
    pioneer_->rightSpeed = (twist.v_mps + 0.5 * kWheels_m * twist.w_radps) * kCm;
    const double left_cm = pioneer_->leftOdometry;
    const double right_cm = pioneer_->rightOdometry;
    const int touches = pioneer_->touches;
    world_.step(dt_s, 4);
    const double left_m = (pioneer_->leftOdometry - left_cm) / kCm;
    const double right_m = (pioneer_->rightOdometry - right_cm) / kCm;
    const double turned_rad = (right_m - left_m) / kWheels_m;
    const double ahead_m = 0.5 * (left_m + right_m);
    odometry_.x_m += ahead_m * std::cos(odometry_.theta_rad + 0.5 * turned_rad);
    odometry_.y_m += ahead_m * std::sin(odometry_.theta_rad + 0.5 * turned_rad);
    odometry_.theta_rad += turned_rad;
    is_bumped_ = pioneer_->touches != touches;
    const double now_s = live::now_s();
    if (now_s - logged_s_ < 0.1) return;
    logged_s_ = now_s;
    log_ << now_s << "," << pioneer_->pos.x / kCm << "," << pioneer_->pos.y / kCm << ","
         << pioneer_->angle * 180.0 / std::numbers::pi << "," << ahead_m / dt_s << "," << pioneer_->touches << "\n"
         << std::flush;
  }
  [[nodiscard]] Pose2 odometry() const override { return odometry_; }
  [[nodiscard]] int sonars() const override { return static_cast<int>(std::size(kSonars)); }
  [[nodiscard]] double range_m(int sonar) override { return pioneer_->range_m(static_cast<std::size_t>(sonar)); }
  [[nodiscard]] bool is_bumped() const override { return is_bumped_; }

 private:
  void add_box(double x_m, double y_m, double size_x_m, double size_y_m) {
    auto* box = new Enki::PhysicalObject;
    box->setRectangular(size_x_m * kCm, size_y_m * kCm, kHeight_cm, -1.0);
    box->pos = Enki::Point(x_m * kCm, y_m * kCm);
    world_.addObject(box);
  }

  Enki::World world_;
  Pioneer* pioneer_ = nullptr;
  Pose2 odometry_;
  bool is_bumped_ = false;
  std::ofstream log_;
  double logged_s_ = 0.0;
};

}  // namespace

std::unique_ptr<p2os_robot::PioneerBody> pioneer_in_two_rooms(const std::filesystem::path& log) {
  return std::make_unique<EnkiWorld>(log);
}

}  // namespace cairn::enki
