// What a behaviour written in Python may ask for in a tick.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/behaviour.hpp"
#include "plugins/python_module/views.hpp"

namespace cairn::python_module {

// The path that a behaviour follows, from tick to tick.
struct FollowedPath {
  std::vector<Point> points;
  PathProgress progress;
  Twist commanded;
  std::optional<double> last_s;
};

// During one tick. What the host throws below a request is raised in Python; when it comes out of the tick there, it is
// the host's again.
class Requests {
 public:
  Requests(BehaviourContext& context, const WorldView& world, FollowedPath& path, std::uint64_t seed)
      : context_(context), world_(world), path_(path), seed_(seed) {}

  void drive(const Twist& wanted);
  [[nodiscard]] ControlResult follow(const std::vector<Point>& path, double speed_mps, double tolerance_m);
  [[nodiscard]] PlanResult plan(const Place& from, const Place& to, CostKind cost);
  [[nodiscard]] const WorldView& world() const { return world_; }
  // Asks the host, without the interpreter's lock.
  template <class Ask>
  auto ask(Ask&& request) -> decltype(request(std::declval<BehaviourContext&>())) {
    try {
      const pybind11::gil_scoped_release others_run;
      return request(context_);
    } catch (...) {
      thrown_ = std::current_exception();
    }
    raise();
  }
  // Throws what the host threw, where it must not be kept from it, or where that is what Python has raised; otherwise
  // returns.
  void rethrow(const pybind11::error_already_set* error) const;

 private:
  [[noreturn]] void raise();
  [[nodiscard]] std::vector<Point> obstacles() const;

  BehaviourContext& context_;
  const WorldView& world_;
  FollowedPath& path_;
  const std::uint64_t seed_;
  std::exception_ptr thrown_;    // the last one
  pybind11::object raised_;      // what it became in Python
  std::exception_ptr pressing_;  // that Python may not keep: no std::exception
};

struct RequestsProxy {
  Lent<Requests> requests;
};
void add_requests(const pybind11::module_& module);

}  // namespace cairn::python_module
