// Missions and experiments, run in this process: in a thread of their own, while the calling one looks for Ctrl-C.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <optional>

#include "framework/experiments/experiment.hpp"
#include "framework/experiments/report.hpp"
#include "framework/mission/runner.hpp"
#include "framework/reporting/report.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"

namespace cairn::python {
namespace py = pybind11;
namespace {

constexpr std::chrono::milliseconds kSignalInterval(50);

// Runs the work in a thread, without the interpreter's lock here; Ctrl-C sets `cancel`, after which the work ends by
// itself, and KeyboardInterrupt is raised.
template <class Result>
Result interruptible(const std::function<Result()>& work, std::atomic<bool>& cancel) {
  std::future<Result> done = std::async(std::launch::async, work);
  bool was_interrupted = false;
  while (true) {
    {
      const py::gil_scoped_release others_run;
      if (done.wait_for(kSignalInterval) == std::future_status::ready) break;
    }
    if (PyErr_CheckSignals() == 0) continue;
    was_interrupted = true;
    PyErr_Clear();
    cancel = true;
  }
  Result result = done.get();
  if (was_interrupted) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }
  return result;
}

// How a mission stands after a tick.
struct Tick {
  RunStatus status;
  std::optional<Pose2> true_pose;
};

// Calls a function of Python after each tick. What it raises cancels the mission, and is kept.
class TickCaller : public Listener {
 public:
  TickCaller(const MissionRunner& runner, py::object& function, std::atomic<bool>& cancel)
      : runner_(runner), function_(function), cancel_(cancel) {}

  void on(const Event& event, const MissionView& view) override {
    if (!std::holds_alternative<TickDone>(event) || raised_) return;
    Tick tick{runner_.status(), view.truth ? std::optional(view.truth->T_map_robot) : std::nullopt};
    const py::gil_scoped_acquire lock;
    try {
      function_(std::move(tick));
    } catch (py::error_already_set& error) {
      raised_.emplace(std::move(error));
      cancel_ = true;
    }
  }
  // With the interpreter's lock.
  void raise_again() {
    if (raised_) throw py::error_already_set(std::move(*raised_));
  }

 private:
  const MissionRunner& runner_;
  py::object& function_;
  std::atomic<bool>& cancel_;
  std::optional<py::error_already_set> raised_;
};

struct Ended {
  std::string report_json;
  bool gave_up = false;
};

// What a mission is run with. A module's call that never returns may still use it: then it is never destroyed.
struct Running {
  py::object on_tick;
  Mission mission;
  std::atomic<bool> cancel{false};
  std::optional<MissionRunner> runner;
  std::optional<RunReport> report;
  std::optional<TickCaller> caller;
};

std::string run(const std::filesystem::path& file, const std::filesystem::path& out, std::optional<std::int64_t> seed,
                const std::vector<std::string>& overrides, py::object on_tick, double pace) {
  auto running = std::make_unique<Running>();
  running->on_tick = std::move(on_tick);
  {
    const py::gil_scoped_release others_run;
    running->mission = load_mission(file, overrides, seed);
    std::filesystem::create_directories(out);
    RunOptions options;
    options.out = out;
    options.pace = pace;
    options.cancel = &running->cancel;
    running->runner.emplace(running->mission, module_library(), options);
    running->report.emplace(running->mission.config.history);
  }
  running->runner->subscribe(*running->report);
  if (!running->on_tick.is_none()) {
    running->caller.emplace(*running->runner, running->on_tick, running->cancel);
    running->runner->subscribe(*running->caller);
  }
  const auto work = [&]() -> Ended {
    const MissionResult result = running->runner->run();
    std::string report = running->report->report_json(running->mission, result, running->runner->graph(), {});
    write_file(out / "report.json", report);
    return {std::move(report), running->runner->gave_up()};
  };
  Ended ended;
  try {
    ended = interruptible<Ended>(work, running->cancel);
  } catch (...) {
    if (running->runner->gave_up()) static_cast<void>(running.release());
    throw;
  }
  if (running->caller) running->caller->raise_again();
  if (ended.gave_up) static_cast<void>(running.release());
  return ended.report_json;
}

// Returns the table (Markdown) and all figures (JSON).
std::pair<std::string, std::string> experiment(const std::filesystem::path& file, const std::filesystem::path& out,
                                               const std::vector<std::string>& overrides, py::object on_run) {
  std::atomic<bool> cancel{false};
  const std::function<std::pair<std::string, std::string>()> work = [&] {
    const ExperimentConfig config = load_experiment(file, overrides);
    std::filesystem::create_directories(out);
    const auto ended = [&](std::size_t done, std::size_t of) {
      const py::gil_scoped_acquire lock;
      if (on_run.is_none() || cancel) return;
      try {
        on_run(done, of);
      } catch (py::error_already_set& error) {
        error.discard_as_unraisable("on_run");
        cancel = true;
      }
    };
    const std::vector<ExperimentRow> rows = run_experiment(config, module_library(), out, cancel, ended);
    std::pair<std::string, std::string> found{table_of(config, rows), json_of(config, rows)};
    write_file(out / "table.md", found.first);
    write_file(out / "table.json", found.second + "\n");
    return found;
  };
  return interruptible<std::pair<std::string, std::string>>(work, cancel);
}

}  // namespace

void add_run(py::module_& module) {
  const auto pose_tuple = [](const Pose2& pose) { return py::make_tuple(pose.x_m, pose.y_m, pose.theta_rad); };
  py::class_<Tick>(module, "Tick", "How a mission stands after a tick.")
      .def_property_readonly(
          "time_s", [](const Tick& it) { return it.status.time_s; }, "By the mission's clock.")
      .def_property_readonly(
          "pose", [=](const Tick& it) { return pose_tuple(it.status.T_map_robot); },
          "As estimated: (x m, y m, heading rad) in the map.")
      .def_property_readonly(
          "true_pose",
          [=](const Tick& it) -> py::object {
            if (!it.true_pose) return py::none();
            return pose_tuple(*it.true_pose);
          },
          "The same in truth; None where that is not known.")
      .def_property_readonly(
          "step", [](const Tick& it) { return it.status.step; }, "The step under way, from 1; 0: none.")
      .def_property_readonly("steps", [](const Tick& it) { return it.status.steps; })
      .def_property_readonly("step_name", [](const Tick& it) { return it.status.step_name; })
      .def_property_readonly("doing", [](const Tick& it) { return it.status.doing; })
      .def_property_readonly("explored_ratio", [](const Tick& it) { return it.status.explored_ratio; })
      .def_property_readonly("distance_m", [](const Tick& it) { return it.status.distance_m; })
      .def_property_readonly("landmarks", [](const Tick& it) { return it.status.landmarks; });
  module.def("run", &run, py::arg("mission"), py::arg("out"), py::arg("seed"), py::arg("overrides"), py::arg("on_tick"),
             py::arg("pace"));
  module.def("experiment", &experiment, py::arg("file"), py::arg("out"), py::arg("overrides"), py::arg("on_run"));
}

}  // namespace cairn::python
