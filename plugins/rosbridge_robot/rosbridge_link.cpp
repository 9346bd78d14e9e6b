#include "plugins/rosbridge_robot/rosbridge_link.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>
#include <utility>

#include "framework/live/steady_time.hpp"
#include "maps/base/printable.hpp"
#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"
#include "plugins/rosbridge_robot/json_messages.hpp"
#include "plugins/rosbridge_robot/text_frame.hpp"

namespace cairn::rosbridge_robot {
namespace {

using nlohmann::json;

constexpr double kOpenWithin_s = 3.0;
constexpr double kFindWithin_s = 2.0;
constexpr std::chrono::milliseconds kStep{20};
constexpr const char* kModule = "rosbridge_robot";
constexpr std::size_t kMaxListed = 8;

const char* type_of(CommandKind kind) {
  return kind == CommandKind::twist ? "geometry_msgs/Twist" : "geometry_msgs/TwistStamped";
}

std::array<std::uint8_t, 4> any_key() {
  std::random_device device;
  std::array<std::uint8_t, 4> key{};
  for (std::uint8_t& byte : key) byte = static_cast<std::uint8_t>(device());
  return key;
}

void check_settings(const Config& config, const RobotModel& robot) {
  ros::check_topics(kModule, config, robot);
  ros::check_topic(kModule, "command.topic", config.command.topic, false);
  if (config.host.empty()) throw std::invalid_argument("rosbridge_robot: `host` is empty");
  if (!config.path.starts_with('/'))
    throw std::invalid_argument(
        fmt::format("rosbridge_robot: `path` is {}; it begins with a slash", in_quotes(config.path)));
  for (const ros::RangeTopic& range : config.ranges)
    if (range.kind == ros::RangeKind::point_cloud2)
      throw std::invalid_argument(
          fmt::format("rosbridge_robot: {} is a PointCloud2, which is not read in JSON; PointCloud is", range.topic));
}

std::string text_in(const json& message, const char* key) {
  const auto found = message.find(key);
  return found != message.end() && found->is_string() ? found->get<std::string>() : std::string();
}

}  // namespace

RosbridgeLink::RosbridgeLink(const Config& config, const RobotModel& robot)
    : config_(config),
      robot_(robot),
      address_{config.host, config.port, config.path},
      observer_(config_, robot_),
      subscriptions_(config_, observer_),
      fragments_(std::size_t{1024} * static_cast<std::size_t>(config.max_message_kib)),
      stop_frame_(text_frame(velocity_text(config.command, {}), any_key())),
      nowhere_(::open("/dev/null", O_WRONLY | O_CLOEXEC)),
      stop_line_(::fcntl(nowhere_.get(), F_DUPFD_CLOEXEC, 0)) {
  check_settings(config, robot);
  if (stop_line_.get() < 0) throw std::runtime_error("rosbridge_robot: no descriptor is left");
}

RosbridgeLink::~RosbridgeLink() {
  disconnect();
}

bool RosbridgeLink::connect(const Budget& budget, std::string& why) {
  if (!open_sockets(budget, why)) return false;
  if (!is_set_up_) set_up();
  make_guard();
  for (const double until_s = live::now_s() + kFindWithin_s; live::now_s() < until_s && !budget.exhausted();) {
    take_all(kStep, first_);
    if (socket_->state() != WebSocket::State::open) break;
    if (first_.empty()) continue;
    observer_.interrupt();
    return true;
  }
  why = socket_->state() == WebSocket::State::open ? nobody_there() : socket_->why();
  if (socket_->state() != WebSocket::State::open) disconnect();
  return false;
}

bool RosbridgeLink::open_sockets(const Budget& budget, std::string& why) {
  const std::size_t max_bytes = std::size_t{1024} * static_cast<std::size_t>(config_.max_message_kib);
  if (!socket_) {
    socket_ = std::make_unique<WebSocket>(address_, max_bytes);
    stop_socket_ = std::make_unique<WebSocket>(address_, max_bytes);
  }
  const double until_s = live::now_s() + kOpenWithin_s;
  for (const WebSocket* socket : {socket_.get(), stop_socket_.get()}) {
    while (socket->state() == WebSocket::State::connecting && live::now_s() < until_s && !budget.exhausted())
      std::this_thread::sleep_for(kStep);
    if (socket->state() == WebSocket::State::open) continue;
    why = socket->state() == WebSocket::State::closed ? socket->why() : address_.text() + " does not answer";
    closed_why_ = why;
    disconnect();
    return false;
  }
  return true;
}

void RosbridgeLink::set_up() {
  const std::string type = type_name(type_of(config_.command.kind), config_.ros);
  for (WebSocket* const socket : {socket_.get(), stop_socket_.get()}) {
    socket->send(advertise_text(config_.command.topic, type));
    socket->send(velocity_text(config_.command, {}));
  }
  ::dup3(stop_socket_->descriptor(), stop_line_.get(), O_CLOEXEC);
  for (std::string& request : subscriptions_.requests(live::now_s())) socket_->send(std::move(request));
  socket_->send(call_text(KnownTopics::kTopicsCall, "/rosapi/topics"));
  socket_->send(call_text(KnownTopics::kListenersCall, "/rosapi/subscribers", config_.command.topic));
  closed_why_.clear();
  is_set_up_ = true;
}

// Makes one when there is none any more.
void RosbridgeLink::make_guard() {
  if (guard_ && guard_->is_there()) return;
  const std::scoped_lock lock(guarding_);
  const std::chrono::milliseconds silence(std::lround(1e3 * config_.guard_s));
  guard_ = std::make_unique<live::GuardProcess>(
      [&](int beats) { live::write_in_silence(beats, stop_line_.get(), stop_frame_, silence); });
}

void RosbridgeLink::disconnect() {
  {
    const std::scoped_lock lock(guarding_);
    guard_.reset();
  }
  (void)send_stop();
  ::dup3(nowhere_.get(), stop_line_.get(), O_CLOEXEC);
  if (socket_ && socket_->state() == WebSocket::State::closed) closed_why_ = socket_->why();
  socket_.reset();
  stop_socket_.reset();
  is_set_up_ = false;
  first_.clear();
  observer_.forget_readings();
}

bool RosbridgeLink::receive(std::vector<Observation>& seen) {
  if (!socket_ || !guard_ || !guard_->is_there()) return false;
  for (Observation& observation : std::exchange(first_, {})) seen.push_back(std::move(observation));
  if (seen.empty()) take_all(kStep, seen);
  return socket_->state() == WebSocket::State::open && stop_socket_->state() == WebSocket::State::open;
}

void RosbridgeLink::take_all(std::chrono::milliseconds wait_for, std::vector<Observation>& seen) {
  for (const std::string& text : socket_->take(wait_for)) take(text, false, seen);
  (void)stop_socket_->take(std::chrono::milliseconds(0));
  for (std::string& request : subscriptions_.repeated_requests(live::now_s())) socket_->send(std::move(request));
}

void RosbridgeLink::take(const std::string& text, bool is_whole, std::vector<Observation>& seen) {
  const json message = json::parse(text, nullptr, false);
  const std::string op = message.is_object() ? text_in(message, "op") : "";
  if (op == "publish" && message.contains("msg")) {
    if (auto observation = subscriptions_.take(text_in(message, "topic"), message["msg"], live::now_s()))
      seen.push_back(std::move(*observation));
  } else if (op == "status") {
    take_status(message);
  } else if (op == "service_response") {
    known_.take_answer(message);
  } else if (op == "fragment" && !is_whole) {
    if (const auto whole = fragments_.add(message)) take(*whole, true, seen);
  } else {
    ++not_understood_;
  }
}

// An error is about something that this program has asked for: the robot would not be seen, or not drive.
void RosbridgeLink::take_status(const json& message) {
  const std::string level = text_in(message, "level");
  const std::string said = printable_excerpt(text_in(message, "msg"));
  const std::string id = text_in(message, "id");
  const bool is_question = id == KnownTopics::kTopicsCall || id == KnownTopics::kListenersCall;
  if (level == "error" && !is_question) throw std::runtime_error("rosbridge says: " + said);
  if (level == "error" || level == "warning") last_warning_ = said;
}

std::string RosbridgeLink::nobody_there() const {
  if (!known_.types())
    return fmt::format(
        "nothing comes on {}: does its driver run? What there is cannot be listed, since rosapi does not "
        "answer",
        config_.odometry);
  std::vector<std::string> all;
  for (const auto& [topic, type] : *known_.types()) all.push_back(topic);
  if (known_.types()->contains(config_.odometry))
    return fmt::format("nothing comes on {}, which is {}: does its driver run?", config_.odometry,
                       known_.types()->at(config_.odometry));
  const std::vector<std::string> some(all.begin(),
                                      all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), kMaxListed)));
  return fmt::format("nobody publishes {}{}; there are {}{}", config_.odometry, did_you_mean(config_.odometry, all),
                     joined(some), all.size() > some.size() ? ", ..." : "");
}

void RosbridgeLink::send(const Twist& wanted) noexcept {
  try {
    socket_->send_latest(velocity_text(config_.command, observer_.is_emergency() ? Twist{} : wanted));
  } catch (const std::exception&) {
    (void)send_stop();  // no memory
  }
}

void RosbridgeLink::beat() noexcept {
  const std::unique_lock lock(guarding_, std::try_to_lock);
  if (lock.owns_lock() && guard_) guard_->beat();
}

bool RosbridgeLink::send_stop() noexcept {
  const int error = errno;
  (void)::send(stop_line_.get(), stop_frame_.data(), stop_frame_.size(), MSG_NOSIGNAL);  // nothing: not connected
  errno = error;
  return true;
}

}  // namespace cairn::rosbridge_robot
