#include "plugins/python_module/requests.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

#include "plugins/python_module/values.hpp"
#include "python/shared/pose_arrays.hpp"

namespace cairn::python_module {
namespace py = pybind11;
namespace {

constexpr double kObstaclesWithin_m = 1.5;

Place place_from(const py::handle& value, const std::string& what) {
  Place place;
  if (py::isinstance<Landmark>(value)) {
    place.landmarks = {value.cast<const Landmark&>().id};
  } else if (py::isinstance<py::int_>(value)) {
    place.landmarks = {value.cast<LandmarkId>()};
  } else {
    place.pose = pose_from(value, what);
    place.heading_matters = py::len(value) == 3;
  }
  return place;
}

py::object object_of(const Place& place) {
  if (!place.pose) return py::cast(place.landmarks);
  return place.heading_matters ? py::object(python::tuple_of(*place.pose))
                               : py::object(py::make_tuple(place.pose->x_m, place.pose->y_m));
}

std::vector<Point> points_from(const py::handle& path) {
  std::vector<Point> points;
  for (const py::handle pose : py::iter(path)) points.push_back(pose_from(pose, "each point of path").position());
  return points;
}

py::tuple answer_of(const Status& status) {
  return py::make_tuple(status.state == StepState::success, status.reason);
}

py::object plan(const RequestsProxy& it, const py::handle& to, const py::object& from, const std::string& cost) {
  Requests& requests = it.requests.get();
  Place start;
  start.pose = requests.world().pose.T_map_robot;
  const std::vector<std::pair<const char*, CostKind>> costs{
      {"length", CostKind::length}, {"time", CostKind::time}, {"clearance", CostKind::clearance}};
  const auto kind = std::find_if(costs.begin(), costs.end(), [&](const auto& known) { return cost == known.first; });
  if (kind == costs.end()) throw std::runtime_error("cost must be length, time or clearance, found " + cost);
  const PlanResult found =
      requests.plan(from.is_none() ? start : place_from(from, "from_"), place_from(to, "to"), kind->second);
  py::dict plan;
  plan["solved"] = found.outcome == PlanOutcome::solved;
  plan["outcome"] = std::string(name_of(found.outcome));
  plan["reason"] = found.reason;
  plan["path"] = python::array_of(found.path);
  plan["length_m"] = found.length_m;
  plan["cost_m"] = found.cost_m;
  plan["clearance_m"] = found.clearance_m;
  plan["landmarks"] = py::cast(found.landmarks);
  plan["routes"] = py::cast(found.routes);
  return namespace_of(plan);
}

py::tuple follow(const RequestsProxy& it, const py::handle& path, double speed_mps, double tolerance_m) {
  const ControlResult result = it.requests.get().follow(points_from(path), speed_mps, tolerance_m);
  return py::make_tuple(std::string(name_of(result.state)), result.left_m);
}

void add_driving(py::class_<RequestsProxy>& to) {
  to.def(
        "drive",
        [](const RequestsProxy& it, double v_mps, double w_radps) {
          it.requests.get().drive({v_mps, w_radps});
        },
        py::arg("v_mps"), py::arg("w_radps") = 0.0, "Drives so for this tick. Without it the robot stops.")
      .def("follow", follow, py::arg("path"), py::arg("speed_mps") = 0.2, py::arg("tolerance_m") = 0.1,
           "Drives along a path, (N, 2) or (N, 3), by the mission's controller: (state, metres left). The state is "
           "following, blocked or arrived. Call it each tick with the same path.")
      .def("plan", plan, py::arg("to"), py::arg("from_") = py::none(), py::arg("cost") = "length",
           "By the mission's planner, to a point, a pose, a landmark or its id; from the robot unless from_ says "
           "otherwise. Has solved, outcome, reason, path (N, 3), length_m, landmarks, ...");
}

void add_outputs(py::class_<RequestsProxy>& to) {
  to.def(
        "save",
        [](const RequestsProxy& it, const std::string& file) {
          return answer_of(it.requests.get().ask([&](BehaviourContext& context) { return context.save(file); }));
        },
        py::arg("file"), "The map so far into the output folder: (True or False, reason).")
      .def(
          "write",
          [](const RequestsProxy& it, const std::string& file, const std::string& text, bool append) {
            return answer_of(it.requests.get().ask([&](BehaviourContext& context) {
              return context.write({file, text, append});
            }));
          },
          py::arg("file"), py::arg("text"), py::arg("append") = false,
          "A text into a file of the output folder: (True or False, reason).")
      .def(
          "report",
          [](const RequestsProxy& it, const std::string& sentence) {
            it.requests.get().ask([&](BehaviourContext& context) { context.report(sentence); });
          },
          py::arg("sentence"), "An event for people.");
}

void add_places(py::class_<RequestsProxy>& to) {
  to.def(
        "input",
        [](const RequestsProxy& it, const std::string& name) -> py::object {
          const auto place = it.requests.get().ask([&](BehaviourContext& context) { return context.input(name); });
          return place ? object_of(*place) : py::object(py::none());
        },
        py::arg("name"), "What a step has last given by that name: a point, a pose, ids of landmarks, or None.")
      .def(
          "output",
          [](const RequestsProxy& it, const std::string& name, const py::handle& place) {
            const Place given = place_from(place, "place");
            it.requests.get().ask([&](BehaviourContext& context) { context.output(name, given); });
          },
          py::arg("name"), py::arg("place"), "Gives later steps a place: a point, a pose, a landmark or its id.")
      .def(
          "name_landmark",
          [](const RequestsProxy& it, LandmarkId id, const std::string& name) {
            return answer_of(
                it.requests.get().ask([&](BehaviourContext& context) { return context.name_landmark(id, name); }));
          },
          py::arg("id"), py::arg("name"), "From then on it is found by this name too: (True or False, reason).")
      .def(
          "name_cluster",
          [](const RequestsProxy& it, const std::string& cluster, const std::string& name) {
            return answer_of(
                it.requests.get().ask([&](BehaviourContext& context) { return context.name_cluster(cluster, name); }));
          },
          py::arg("cluster"), py::arg("name"), "The same of a cluster, by its id (C1:L4) or name.");
}

}  // namespace

void Requests::drive(const Twist& wanted) {
  path_.commanded = wanted;
  ask([&](BehaviourContext& context) { context.drive(wanted); });
}

ControlResult Requests::follow(const std::vector<Point>& path, double speed_mps, double tolerance_m) {
  ControlRequest request;
  request.is_new_path = path != path_.points;
  if (request.is_new_path) path_ = {path, {}, path_.commanded, path_.last_s};
  const std::vector<Point> near = obstacles();
  request.path = path_.points;
  request.progress = path_.progress;
  request.speed_mps = std::min(speed_mps, world_.robot.max_v_mps);
  request.tolerance_m = tolerance_m;
  request.obstacles = near;
  const double left = 1.0 - world_.speed_reduction_ratio;
  request.velocity = {left * path_.commanded.v_mps, left * path_.commanded.w_radps};
  request.period_s = path_.last_s ? std::max(0.0, world_.time_s - *path_.last_s) : 0.0;
  path_.last_s = world_.time_s;
  ControlResult result = ask([&](BehaviourContext& context) { return context.control(request); });
  path_.progress = result.progress;
  drive(result.twist);
  return result;
}

PlanResult Requests::plan(const Place& from, const Place& to, CostKind cost) {
  PlanRequest request;
  request.from = from;
  request.to = to;
  request.radius_m = world_.robot.radius_m;
  request.seed = seed_;
  request.cost = cost;
  return ask([&](BehaviourContext& context) { return context.plan(request); });
}

// The map's, near the robot and in its frame.
std::vector<Point> Requests::obstacles() const {
  std::vector<Point> found;
  const Pose2& T_map_robot = world_.pose.T_map_robot;
  if (!is_finite(T_map_robot)) return found;
  const Point around = Point::Constant(kObstaclesWithin_m);
  const Pose2 T_robot_map = inverse(T_map_robot);
  const Cell last = world_.grid.cell_at(T_map_robot.position() + around);
  const CellBox box =
      intersected({world_.grid.cell_at(T_map_robot.position() - around), last + Cell{1, 1}}, world_.grid.bounds());
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (world_.grid.state({x, y}) == CellState::occupied)
        found.push_back(T_robot_map * world_.grid.centre_of({x, y}));
  return found;
}

void Requests::raise() {
  try {
    std::rethrow_exception(thrown_);
  } catch (const std::exception& error) {
    PyErr_SetString(PyExc_RuntimeError, error.what());
  } catch (...) {
    pressing_ = thrown_;
    PyErr_SetString(PyExc_SystemExit, "the mission is over");
  }
  const py::error_already_set error;
  raised_ = error.value();
  throw error;
}

void Requests::rethrow(const py::error_already_set* error) const {
  if (pressing_) std::rethrow_exception(pressing_);
  if (error != nullptr && raised_ && error->value().is(raised_)) std::rethrow_exception(thrown_);
}

void add_requests(const py::module_& module) {
  py::class_<RequestsProxy> requests(module, "Requests", "What a behaviour may ask for in a tick.", py::module_local());
  add_driving(requests);
  add_outputs(requests);
  add_places(requests);
}

}  // namespace cairn::python_module
