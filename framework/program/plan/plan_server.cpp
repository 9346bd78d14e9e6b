#include "framework/program/plan/plan_server.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <nlohmann/json.hpp>

#include "framework/config/config_value.hpp"
#include "framework/program/plan/answer_line.hpp"

namespace cairn {
namespace {

constexpr int kLookEvery_ms = 50;
constexpr timeval kTakesNothingFor{10, 0};  // then the connection ends
constexpr const char* kQuery = "query";     // in errors, in place of a file's name

using Json = nlohmann::ordered_json;

std::string error_line(const nlohmann::json& id, const std::string& what) {
  return Json{{"id", id}, {"error", what}}.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

// Of a line that may be anything.
nlohmann::json id_in(const std::string& line) {
  const nlohmann::json value = nlohmann::json::parse(line, nullptr, false);
  return value.is_object() ? value.value("id", nlohmann::json("")) : nlohmann::json("");
}

bool send_all(int socket, std::string_view text) {
  while (!text.empty()) {
    const ssize_t sent = ::send(socket, text.data(), text.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

}  // namespace

bool AnswerPlaces::enter(const std::atomic<bool>& end) {
  std::unique_lock lock(mutex_);
  if (busy_ >= at_once_ && waiting_ >= max_waiting_) return false;
  const std::uint64_t ticket = next_ticket_++;
  ++waiting_;
  left_.wait(lock, [&] { return (ticket == next_served_ && busy_ < at_once_) || end; });
  --waiting_;
  ++next_served_;
  ++busy_;
  left_.notify_all();
  if (!end) return true;
  --busy_;
  return false;
}

void AnswerPlaces::leave() {
  const std::scoped_lock lock(mutex_);
  --busy_;
  left_.notify_all();
}

void AnswerPlaces::wake() {
  const std::scoped_lock lock(mutex_);
  left_.notify_all();
}

PlanServer::PlanServer(ServedMaps& maps, const live::Address& address, std::size_t jobs, PlanQuestion defaults)
    : maps_(maps),
      address_(address),
      defaults_(std::move(defaults)),
      listening_(live::listen_at(address)),
      places_(jobs, kMaxWaiting) {}

PlanServer::~PlanServer() {
  std::error_code none;
  if (!address_.socket.empty()) std::filesystem::remove(address_.socket, none);
}

void PlanServer::run(const std::atomic<bool>& end) {
  while (!end) {
    pollfd ready{listening_.get(), POLLIN, 0};
    const bool is_called = ::poll(&ready, 1, kLookEvery_ms) > 0;
    std::erase_if(clients_, [](const Client& client) { return client.is_done.load(); });
    if (is_called) accept_client();
  }
  is_ending_ = true;
  places_.wake();
  // What is being answered is still sent.
  for (const Client& client : clients_) ::shutdown(client.connection.get(), SHUT_RD);
  clients_.clear();
}

void PlanServer::accept_client() {
  const int made = ::accept4(listening_.get(), nullptr, nullptr, SOCK_CLOEXEC);
  if (made < 0) return;
  Descriptor connection(made);
  ::setsockopt(made, SOL_SOCKET, SO_SNDTIMEO, &kTakesNothingFor, sizeof kTakesNothingFor);
  if (clients_.size() >= kMaxClients) {
    (void)live::send_now(made, error_line("", "too many connections"));
    return;
  }
  Client& client = clients_.emplace_back();
  client.connection = std::move(connection);
  client.thread = std::jthread([this, &client] {
    serve(client);
    ::shutdown(client.connection.get(), SHUT_RDWR);
    client.is_done = true;
  });
}

void PlanServer::serve(const Client& client) {
  const int socket = client.connection.get();
  live::LineReader lines;
  int number = 0;
  bool is_there = true;
  while (is_there && !is_ending_) {
    pollfd ready{socket, POLLIN, 0};
    if (::poll(&ready, 1, -1) < 0 && errno != EINTR) return;
    is_there = lines.read(socket);
    for (std::optional<std::string> line; !is_ending_ && (line = lines.next());)
      if (!send_all(socket, answer_to(*line, ++number))) return;
  }
}

std::string PlanServer::answer_to(const std::string& line, int number) {
  try {
    const PlanQuery query = query_of_line(line, kQuery, number, defaults_);
    if (!places_.enter(is_ending_)) return error_line(query.id, "busy: too many questions wait");
    struct Leaving {
      AnswerPlaces& places;
      ~Leaving() { places.leave(); }
    };
    const Leaving leaving{places_};
    const std::shared_ptr<const MapPlanner> planner = maps_.planner(query.map);
    return json_line_of(query, planner->answer(query.question), *planner);
  } catch (const std::exception& error) {
    return error_line(id_in(line), error.what());
  }
}

}  // namespace cairn
