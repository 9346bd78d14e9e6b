// Answers questions about saved maps over a socket: `cairn plan MAPS --serve ADDRESS`.
//
// Each line is a query as in a file of queries, with "map" beside; each answer is the line that `cairn plan --json`
// gives, or {"id", "error"}. A connection gets its answers in order, one after the other; several are answered at once.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <list>
#include <mutex>
#include <string>
#include <thread>

#include "framework/live/line_socket.hpp"
#include "framework/planning/plan_task.hpp"
#include "framework/program/plan/served_maps.hpp"

namespace cairn {

// So many answers are made at a time; the others wait in the order in which they came, and one too many is turned away.
class AnswerPlaces {
 public:
  AnswerPlaces(std::size_t at_once, std::size_t waiting) : at_once_(at_once), max_waiting_(waiting) {}
  // False: too many wait already, or it is to end.
  [[nodiscard]] bool enter(const std::atomic<bool>& end);
  void leave();
  void wake();

 private:
  const std::size_t at_once_;
  const std::size_t max_waiting_;
  std::mutex mutex_;
  std::condition_variable left_;
  std::size_t busy_ = 0;
  std::size_t waiting_ = 0;
  std::uint64_t next_ticket_ = 0;
  std::uint64_t next_served_ = 0;
};

class PlanServer {
 public:
  static constexpr std::size_t kMaxClients = 128;
  static constexpr std::size_t kMaxWaiting = 64;  // for a place; the rest is told so

  // maps must outlive it. defaults: of what a query leaves out. Throws std::runtime_error when it cannot listen there.
  PlanServer(ServedMaps& maps, const live::Address& address, std::size_t jobs, PlanQuestion defaults);
  ~PlanServer();
  PlanServer(const PlanServer&) = delete;
  PlanServer& operator=(const PlanServer&) = delete;

  // Until end is true. Answers that are under way are given.
  void run(const std::atomic<bool>& end);

 private:
  struct Client {
    Descriptor connection;
    std::atomic<bool> is_done{false};
    std::jthread thread{};
  };
  void accept_client();
  void serve(const Client& client);
  // Ends with its line feed.
  [[nodiscard]] std::string answer_to(const std::string& line, int number);

  ServedMaps& maps_;
  const live::Address address_;
  const PlanQuestion defaults_;
  Descriptor listening_;
  AnswerPlaces places_;
  std::atomic<bool> is_ending_{false};
  std::list<Client> clients_;
};

}  // namespace cairn
