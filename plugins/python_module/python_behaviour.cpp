#include "plugins/python_module/python_behaviour.hpp"

#include "plugins/python_module/values.hpp"

namespace cairn::python_module {
namespace py = pybind11;
namespace {

void add_to_context(py::dict& attributes, const BehaviourConfig& config, const BehaviourFactoryContext& context) {
  py::list categories;
  for (const std::string& category : context.categories) categories.append(category);
  attributes["categories"] = categories;
  attributes["input"] = config.input;
  attributes["output"] = config.output;
}

Status status_from(const py::handle& value, const std::string& what) {
  const auto fail = [&]() -> Status {
    throw std::runtime_error(what + " must return (state, reason) with one of running, success, failure; found " +
                             found_text(value));
  };
  if (!py::isinstance<py::tuple>(value) || py::len(value) != 2) return fail();
  const auto [state, reason] = value.cast<std::pair<py::object, py::object>>();
  if (!py::isinstance<py::str>(state)) return fail();
  const std::string name = text_from(state, "the state that " + what + " returned");
  const std::string text = text_from(reason, "the reason that " + what + " returned");
  if (name == "running") return {StepState::running, text};
  if (name == "success") return {StepState::success, text};
  if (name == "failure") return {StepState::failure, text};
  return fail();
}

}  // namespace

PythonBehaviour::PythonBehaviour(const BehaviourConfig& config, const BehaviourFactoryContext& context)
    : object_(config, context, [&](py::dict& attributes) { add_to_context(attributes, config, context); }, {"tick"}),
      seed_(context.seed) {
  object_.call(nullptr, [&](py::object& object) {
    has_halt_ = py::hasattr(object, "halt");
    if (py::hasattr(object, "needs_pose")) needs_pose_ = flag_from(object.attr("needs_pose"), "needs_pose");
  });
}

Status PythonBehaviour::tick(const WorldView& world, BehaviourContext& context) {
  if (std::exchange(is_stale_, false)) object_.make_anew();
  return object_.call(nullptr, [&](py::object& object) {
    const Loan loan;
    Requests requests(context, world, path_, seed_);
    try {
      const py::object status =
          object.attr("tick")(WorldProxy{{world, loan.is_open()}}, RequestsProxy{{requests, loan.is_open()}});
      requests.rethrow(nullptr);
      return status_from(status, object_.name_of("tick"));
    } catch (const py::error_already_set& error) {
      requests.rethrow(&error);
      throw;
    }
  });
}

void PythonBehaviour::halt() {
  path_ = {};
  if (!has_halt_) {
    is_stale_ = true;
    return;
  }
  object_.call(nullptr, [](py::object& object) { object.attr("halt")(); });
}

}  // namespace cairn::python_module
