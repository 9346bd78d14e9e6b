#include "tests/plugins/rosbridge_robot/rosbridge_server.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cmath>
#include <deque>
#include <future>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "framework/live/steady_time.hpp"

namespace cairn::rosbridge_robot {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using nlohmann::json;

constexpr std::chrono::milliseconds kTick{20};
constexpr std::size_t kPiece = 100;

}  // namespace

struct RosbridgeServer::Loop {
  struct Session : std::enable_shared_from_this<Session> {
    Session(Loop& owner, tcp::socket socket) : loop(owner), stream(std::move(socket)) {}

    void begin() {
      beast::get_lowest_layer(stream).socket().set_option(tcp::no_delay(true));
      stream.async_accept([self = shared_from_this()](beast::error_code error) {
        if (error) return;
        self->is_open = true;
        self->read();
      });
    }
    void read() {
      stream.async_read(heard, [self = shared_from_this()](beast::error_code error, std::size_t) {
        if (error) return self->end();
        const json message = json::parse(beast::buffers_to_string(self->heard.data()), nullptr, false);
        self->heard.consume(self->heard.size());
        if (message.is_object()) self->loop.take(*self, message);
        self->read();
      });
    }
    void say(std::string text, bool is_text = true) {
      if (!is_open) return;
      queue.emplace_back(std::move(text), is_text);
      if (queue.size() == 1) write();
    }
    void write() {
      stream.text(queue.front().second);
      stream.async_write(asio::buffer(queue.front().first),
                         [self = shared_from_this()](beast::error_code error, std::size_t) {
                           if (error) return self->end();
                           self->queue.pop_front();
                           if (!self->queue.empty()) self->write();
                         });
    }
    void end() {
      is_open = false;
      beast::error_code ignored;
      beast::get_lowest_layer(stream).socket().close(ignored);
    }

    Loop& loop;
    websocket::stream<beast::tcp_stream> stream;
    beast::flat_buffer heard;
    std::deque<std::pair<std::string, bool>> queue;
    std::set<std::string> topics;
    bool is_open = false;
  };

  Loop(RosbridgeServer& its_owner, int its_ros) : owner(its_owner), ros(its_ros) {}

  void accept() {
    acceptor.async_accept([this](beast::error_code error, tcp::socket socket) {
      if (error) return;
      sessions.push_back(std::make_shared<Session>(*this, std::move(socket)));
      sessions.back()->begin();
      accept();
    });
  }

  [[nodiscard]] std::string type(const std::string& package, const std::string& name) const {
    return package + (ros == 1 ? "/" : "/msg/") + name;
  }
  [[nodiscard]] std::map<std::string, std::string> types() const {
    return {{"/odom", type("nav_msgs", "Odometry")},
            {"/sonar", type("sensor_msgs", "Range")},
            {"/scan", type("sensor_msgs", "LaserScan")},
            {"/imu", type("sensor_msgs", "Imu")},
            {"/e_stop", type("std_msgs", "Bool")},
            {"/cmd_vel", type("geometry_msgs", owner.wants_stamped ? "TwistStamped" : "Twist")}};
  }

  void take(Session& session, const json& message) {
    const std::string op = message.value("op", "");
    {
      const std::scoped_lock guard(lock);
      requests.push_back(message);
    }
    const std::string topic = message.value("topic", "");
    if (op == "subscribe") {
      subscribe(session, topic, message.value("type", ""));
    } else if (op == "unsubscribe") {
      session.topics.erase(topic);
    } else if (op == "publish" && topic == "/cmd_vel") {
      const json& msg = message["msg"];
      owner.v_mps = (owner.wants_stamped ? msg["twist"] : msg)["linear"]["x"].get<double>();
    } else if (op == "call_service") {
      answer(session, message);
    }
  }

  void subscribe(Session& session, const std::string& topic, const std::string& type) {
    const auto known = types();
    if (known.contains(topic) && known.at(topic) != type)
      return session.say(json{{"op", "status"},
                              {"level", "error"},
                              {"id", "cairn:" + topic},
                              {"msg", "subscribe: Tried to subscribe to topic " + topic + " with type " + type +
                                          " but topic has type " + known.at(topic)}}
                             .dump());
    if (topic != "/sonar" || !owner.is_deaf_sonar) session.topics.insert(topic);
  }

  void answer(Session& session, const json& call) {
    json values = json::object();
    const std::string service = call["service"];
    if (!owner.has_rosapi) {
      values = "Service " + service + " does not exist";
    } else if (service == "/rosapi/topics") {
      values = {{"topics", json::array()}, {"types", json::array()}};
      for (const auto& [topic, its_type] : types()) {
        values["topics"].push_back(topic);
        values["types"].push_back(its_type);
      }
    } else {
      values = {{"subscribers", {"/base"}}};
    }
    session.say(json{{"op", "service_response"},
                     {"id", call["id"]},
                     {"service", service},
                     {"values", values},
                     {"result", owner.has_rosapi.load()}}
                    .dump());
  }

  [[nodiscard]] json header(const std::string& frame) const {
    const double now_s = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
    const auto whole = static_cast<std::int64_t>(now_s);
    const auto rest = static_cast<std::int64_t>(1e9 * (now_s - static_cast<double>(whole)));
    if (ros == 1) return {{"seq", 7}, {"stamp", {{"secs", whole}, {"nsecs", rest}}}, {"frame_id", "/" + frame}};
    return {{"stamp", {{"sec", whole}, {"nanosec", rest}}}, {"frame_id", frame}};
  }
  [[nodiscard]] json range_value() const {
    return std::isfinite(owner.range_m) ? json(owner.range_m.load()) : json(nullptr);
  }

  void publish_all() {
    x_m += 0.02 * owner.v_mps;
    const json zero{{"x", 0.0}, {"y", 0.0}, {"z", 0.0}};
    const json straight{{"x", 0.0}, {"y", 0.0}, {"z", 0.0}, {"w", 1.0}};
    publish("/sonar", {{"header", header("sonar_1")},
                       {"radiation_type", 0},
                       {"field_of_view", 0.5},
                       {"min_range", 0.1},
                       {"max_range", 5.0},
                       {"range", range_value()}});
    publish("/scan", {{"header", header("laser")},
                      {"angle_min", -0.5},
                      {"angle_max", 0.5},
                      {"angle_increment", 0.5},
                      {"range_min", 0.1},
                      {"range_max", 8.0},
                      {"ranges", {1.0, range_value(), 3.0}},
                      {"intensities", json::array()}});
    publish("/imu", {{"header", header("imu")},
                     {"orientation", straight},
                     {"orientation_covariance", {0, 0, 0, 0, 0, 0, 0, 0, 0}},
                     {"angular_velocity", zero}});
    publish("/odom",
            {{"header", header("odom")},
             {"child_frame_id", "base_link"},
             {"pose", {{"pose", {{"position", {{"x", x_m}, {"y", 0.0}, {"z", 0.0}}}, {"orientation", straight}}}}}});
  }

  void publish(const std::string& topic, json&& msg) {
    const std::string text = json{{"op", "publish"}, {"topic", topic}, {"msg", std::move(msg)}}.dump();
    for (const auto& session : sessions) {
      if (!session->topics.contains(topic)) continue;
      if (owner.with_noise) {
        session->say(R"({"op":"hologram","data":[1,2,3]})");
        session->say("\x7f{]no JSON");
        session->say(R"(["op"])");
      }
      if (owner.in_pieces)
        say_in_pieces(*session, text);
      else
        session->say(text);
    }
  }

  // The last ones first.
  void say_in_pieces(Session& session, const std::string& text) {
    const std::size_t total = (text.size() + kPiece - 1) / kPiece;
    const std::string id = std::to_string(++piece);
    for (std::size_t i = total; i-- > 0;)
      session.say(
          json{{"op", "fragment"}, {"id", id}, {"num", i}, {"total", total}, {"data", text.substr(i * kPiece, kPiece)}}
              .dump());
  }

  void tick() {
    std::erase_if(sessions, [](const auto& session) { return !session->is_open && session.use_count() == 1; });
    if (!owner.is_silent) publish_all();
    timer.expires_after(kTick);
    timer.async_wait([this](beast::error_code error) {
      if (!error) tick();
    });
  }

  RosbridgeServer& owner;
  int ros;
  asio::io_context io{1};
  tcp::acceptor acceptor{io, tcp::endpoint(asio::ip::address_v4::loopback(), 0)};
  asio::steady_timer timer{io};
  std::vector<std::shared_ptr<Session>> sessions;
  double x_m = 0.0;
  int piece = 0;
  mutable std::mutex lock;
  std::vector<json> requests;
  std::jthread thread;
};

RosbridgeServer::RosbridgeServer(int ros) : loop_(std::make_shared<Loop>(*this, ros)) {
  loop_->accept();
  loop_->tick();
  loop_->thread = std::jthread([loop = loop_.get()] { loop->io.run(); });
}

RosbridgeServer::~RosbridgeServer() {
  loop_->io.stop();
  loop_->thread.join();
}

int RosbridgeServer::port() const {
  return loop_->acceptor.local_endpoint().port();
}

void RosbridgeServer::cut() {
  asio::post(loop_->io, [loop = loop_.get()] {
    for (const auto& session : loop->sessions) session->end();
  });
}

void RosbridgeServer::say(const std::string& text) {
  asio::post(loop_->io, [loop = loop_.get(), text] {
    for (const auto& session : loop->sessions) session->say(text);
  });
}

void RosbridgeServer::say_binary(const std::string& bytes) {
  asio::post(loop_->io, [loop = loop_.get(), bytes] {
    for (const auto& session : loop->sessions) session->say(bytes, false);
  });
}

std::vector<json> RosbridgeServer::requests(const std::string& op) const {
  const std::scoped_lock guard(loop_->lock);
  std::vector<json> found;
  for (const json& request : loop_->requests)
    if (request.value("op", "") == op) found.push_back(request);
  return found;
}

int RosbridgeServer::connections() const {
  std::promise<int> count;
  asio::post(loop_->io, [&] {
    int open = 0;
    for (const auto& session : loop_->sessions) open += session->is_open ? 1 : 0;
    count.set_value(open);
  });
  return count.get_future().get();
}

bool RosbridgeServer::wait_for_wheels(bool turning, double within_s) const {
  for (const double begin_s = live::now_s(); live::now_s() - begin_s < within_s;) {
    if ((v_mps != 0.0) == turning) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

}  // namespace cairn::rosbridge_robot
