// The robot and the world of a mission in Enki, on a ROS 2 network by Fast DDS, on this computer only, in wall-clock
// time:
//     enki_ros2 MISSION DOMAIN LOG LATENCIES [KEY=VALUE...]
// Publishes /odom every 70 ms, and on /sonar a Range of the next of its sonars every 40 ms (frames sonar_0, sonar_1,
// ...); obeys a Twist on /cmd_vel, for two seconds. LOG: tests/enki/enki_world.hpp; KEY=VALUE: as with
// `cairn run --set`. LATENCIES: lines `odometry,MS`, from each odometry to the first velocity after it, if that comes
// before the next, and `range,MS`, from each Range that was sent before that odometry to the same velocity. Cairn
// repeats a velocity after 50 ms, before the next odometry: a velocity within 30 ms is the answer.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "framework/live/steady_time.hpp"
#include "tests/enki/enki_world.hpp"
#include "tests/fast_dds/messages_by_hand.hpp"
#include "tests/fast_dds/stranger.hpp"

namespace {

using cairn::Pose2;
using cairn::Twist;
using cairn::fast_dds::Cdr;
using cairn::fast_dds::Offer;
using cairn::fast_dds::Stamped;
using cairn::fast_dds::Stranger;

constexpr double kOdometryEvery_s = 0.07;
constexpr double kSonarEvery_s = 0.04;
constexpr double kObeysFor_s = 2.0;
constexpr double kStep_s = 0.01;

std::atomic<bool> is_ended{false};

Stamped stamped_now(const std::string& frame) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto seconds = std::chrono::floor<std::chrono::seconds>(now);
  return {static_cast<std::int32_t>(seconds.count()),
          static_cast<std::uint32_t>(std::chrono::nanoseconds(now - seconds).count()), frame};
}

bool is_due(double& last_s, double every_s, double now_s) {
  if (now_s - last_s < every_s) return false;
  last_s = now_s;
  return true;
}

class RosPioneer {
 public:
  RosPioneer(const cairn::Mission& mission, int domain, const std::string& log, const std::string& latencies)
      : body_(cairn::enki::robot_in_its_world(mission, log)),
        network_(domain),
        odometry_(network_.writer("/odom", "nav_msgs::msg::dds_::Odometry_")),
        sonar_(network_.writer("/sonar", "sensor_msgs::msg::dds_::Range_", Offer{false, false})),
        velocity_(network_.reader("/cmd_vel", "geometry_msgs::msg::dds_::Twist_")),
        latencies_(latencies) {}

  void step() {
    const double now_s = cairn::live::now_s();
    take_velocity(now_s);
    if (const double moved_s = moved_s_; is_due(moved_s_, kStep_s, now_s))
      body_->drive(now_s - commanded_s_ < kObeysFor_s ? twist_ : Twist{}, std::min(now_s - moved_s, 0.1));
    if (is_due(fired_s_, kSonarEvery_s, now_s)) fire();
    if (is_due(published_s_, kOdometryEvery_s, now_s)) publish_odometry();
  }

 private:
  void take_velocity(double now_s) {
    for (cairn::fast_dds::Bytes& message : velocity_->take()) {
      cairn::fast_dds::TwistNumbers numbers{};
      cairn::fast_dds::read_all(std::move(message), [&](Cdr& from) { from >> numbers; });
      twist_ = {numbers[0], numbers[5]};
      commanded_s_ = now_s;
      if (!is_answered_) write_latencies(now_s);
      is_answered_ = true;
    }
  }
  void write_latencies(double now_s) {
    latencies_ << "odometry," << 1000.0 * (now_s - published_s_) << "\n";
    const auto later = std::find_if(ranges_s_.begin(), ranges_s_.end(), [&](double s) { return s > published_s_; });
    for (auto sent_s = ranges_s_.begin(); sent_s != later; ++sent_s)
      latencies_ << "range," << 1000.0 * (now_s - *sent_s) << "\n";
    latencies_ << std::flush;
    ranges_s_.erase(ranges_s_.begin(), later);
  }
  void fire() {
    const auto range_m = static_cast<float>(body_->range_m(next_));
    sonar_->write(cairn::fast_dds::written(
        [&](Cdr& to) { cairn::fast_dds::write_range(to, stamped_now("sonar_" + std::to_string(next_)), range_m); }));
    next_ = (next_ + 1) % body_->sonars();
    ranges_s_.push_back(cairn::live::now_s());
  }
  void publish_odometry() {
    const Pose2 pose = body_->odometry();
    odometry_->write(cairn::fast_dds::written([&](Cdr& to) {
      cairn::fast_dds::write_odometry(
          to, stamped_now("odom"), "base_link",
          {pose.x_m, pose.y_m, 0.0, 0.0, 0.0, std::sin(0.5 * pose.theta_rad), std::cos(0.5 * pose.theta_rad)});
    }));
    is_answered_ = false;
  }

  std::unique_ptr<cairn::p2os_robot::PioneerBody> body_;
  Stranger network_;
  std::unique_ptr<Stranger::Writer> odometry_;
  std::unique_ptr<Stranger::Writer> sonar_;
  std::unique_ptr<Stranger::Reader> velocity_;
  std::ofstream latencies_;
  Twist twist_;
  double commanded_s_ = -1.0;
  double moved_s_ = cairn::live::now_s();
  double fired_s_ = 0.0;
  double published_s_ = 0.0;
  int next_ = 0;
  bool is_answered_ = true;
  std::vector<double> ranges_s_;  // when those were sent that no velocity has answered
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) {
    std::cerr << "enki_ros2 MISSION DOMAIN LOG LATENCIES [KEY=VALUE...]\n";
    return 2;
  }
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { is_ended = true; });
  try {
    RosPioneer pioneer(cairn::load_mission(argv[1], {argv + 5, argv + argc}), std::stoi(argv[2]), argv[3], argv[4]);
    std::cout << "a Pioneer 3-DX in the ROS domain " << argv[2] << "\n" << std::flush;
    while (!is_ended) {
      pioneer.step();
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
  } catch (const std::exception& fault) {
    std::cerr << "enki_ros2: " << fault.what() << "\n";
    return 1;
  }
  return 0;
}
