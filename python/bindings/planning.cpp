// Plans on a saved map, by what `cairn plan` uses.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <optional>
#include <thread>

#include "framework/planning/plan_answer.hpp"
#include "framework/planning/saved_map/map_planner.hpp"
#include "framework/planning/trajectory.hpp"
#include "maps/base/ordered_parallel_map.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"

namespace cairn::python {
namespace py = pybind11;
namespace {

struct Answer {
  std::string json;  // without path and trajectory
  std::vector<Pose2> path;
  std::vector<TrajectoryPoint> trajectory;
};

class Planner {
 public:
  Planner(const Map& map, MapPlannerOptions options)
      : planner_(with_file(std::move(options), map), map.shared(), module_library()) {}

  [[nodiscard]] Answer answer(const PlanQuestion& question) const {
    check(question);
    PlanResult result = planner_.answer(question);
    Answer answer;
    if (question.trajectory && result.outcome == PlanOutcome::solved)
      answer.trajectory = trajectory_of(result.path, planner_.robot());
    answer.path = std::move(result.path);
    result.path.clear();
    const ClusterTree& clusters = result.explanation ? planner_.clusters() : planner_.map().clusters;
    answer.json = json_text_of({"\"\"", question, result, planner_.map().graph, clusters});
    return answer;
  }

  [[nodiscard]] std::vector<Answer> answers(const std::vector<PlanQuestion>& questions, std::size_t jobs) const {
    std::vector<Answer> answers;
    answers.reserve(questions.size());
    auto next = questions.begin();
    ordered_parallel_map(
        jobs,
        [&]() -> std::optional<PlanQuestion> {
          return next == questions.end() ? std::nullopt : std::optional(*next++);
        },
        [&](const PlanQuestion& question) { return answer(question); },
        [&](Answer given, bool) { answers.push_back(std::move(given)); }, [] {});
    return answers;
  }

 private:
  static MapPlannerOptions with_file(MapPlannerOptions options, const Map& map) {
    options.map = map.file();
    return options;
  }

  MapPlanner planner_;
};

py::tuple tuple_of(const Answer& answer) {
  return py::make_tuple(answer.json, array_of(answer.path), array_of(answer.trajectory));
}

std::shared_ptr<Planner> planner_for(const Map& map, const std::string& planner,
                                     const std::vector<std::string>& settings, const std::filesystem::path& robot,
                                     std::optional<double> radius_m, std::optional<double> margin_m,
                                     std::optional<double> budget_ms, std::int64_t seed) {
  const py::gil_scoped_release others_run;
  return std::make_shared<Planner>(
      map, MapPlannerOptions{"", planner, settings, robot, radius_m, margin_m, budget_ms, seed});
}

}  // namespace

void add_planning(py::module_& module) {
  py::class_<PlanQuestion>(module, "Question")
      .def(py::init([](std::string from, std::string to, std::vector<std::string> via, std::vector<std::string> avoid,
                       std::vector<std::string> closed, int alternatives, std::string cost, bool explain,
                       bool trajectory) {
             return PlanQuestion{std::move(from), std::move(to),   std::move(via), std::move(avoid), std::move(closed),
                                 alternatives,    std::move(cost), explain,        trajectory};
           }),
           py::arg("from_"), py::arg("to"), py::arg("via"), py::arg("avoid"), py::arg("closed"),
           py::arg("alternatives"), py::arg("cost"), py::arg("explain"), py::arg("trajectory"));
  py::class_<Planner, std::shared_ptr<Planner>>(module, "Planner")
      .def(py::init(&planner_for), py::arg("map"), py::arg("planner"), py::arg("settings"), py::arg("robot"),
           py::arg("radius_m"), py::arg("margin_m"), py::arg("budget_ms"), py::arg("seed"))
      .def(
          "plan",
          [](const Planner& planner, const PlanQuestion& question) {
            const Answer answer = [&] {
              const py::gil_scoped_release others_run;
              return planner.answer(question);
            }();
            return tuple_of(answer);
          },
          py::arg("question"))
      .def(
          "plan_many",
          [](const Planner& planner, const std::vector<PlanQuestion>& questions, int jobs) {
            const std::size_t threads =
                jobs > 0 ? static_cast<std::size_t>(jobs) : std::max(1U, std::thread::hardware_concurrency());
            const std::vector<Answer> answers = [&] {
              const py::gil_scoped_release others_run;
              return planner.answers(questions, threads);
            }();
            py::list list;
            for (const Answer& answer : answers) list.append(tuple_of(answer));
            return list;
          },
          py::arg("questions"), py::arg("jobs") = 0);
}

}  // namespace cairn::python
