// An object of a class in a Python file, made for a mission.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <initializer_list>
#include <memory>
#include <string>

#include "framework/contracts/budget.hpp"
#include "framework/contracts/module_context.hpp"
#include "plugins/python_module/config.hpp"
#include "plugins/python_module/raised.hpp"

namespace cairn::python_module {

class PythonObject {
 public:
  // Adds to `context` what this kind of module gets besides robot, seed, rng, path() and exhausted().
  using AddToContext = std::function<void(pybind11::dict& context)>;

  // Runs the file and makes an object of the class: `Class(context, **settings)`. Each object has a run of the file of
  // its own. methods: that it must have. Throws ConfigError at the place in the mission (no such file or class, a
  // method that is missing, a setting that is unknown or missing) or in the Python file (whatever that raises).
  PythonObject(const Config& config, const ModuleContext& context, const AddToContext& add_to_context,
               std::initializer_list<const char*> methods);
  PythonObject(const PythonObject&) = delete;
  PythonObject& operator=(const PythonObject&) = delete;
  ~PythonObject();

  // What follows throws std::runtime_error with place and trace.

  // call: takes the object, and runs with the interpreter's lock. budget: what context.exhausted() asks meanwhile.
  template <class Call>
  auto call(const Budget* budget, Call&& call) -> decltype(call(std::declval<pybind11::object&>())) {
    return in_python(file_, [&]() -> decltype(call(std::declval<pybind11::object&>())) {
      const BudgetOfCall during(*budget_, budget);
      return call(object_);
    });
  }
  // Another one of the class, as after the constructor.
  void make_anew();

  [[nodiscard]] const std::string& file() const { return file_; }
  // "side_square.py: tick()", for what it has returned.
  [[nodiscard]] std::string name_of(const char* method) const { return file_ + ": " + method + "()"; }

 private:
  class BudgetOfCall {
   public:
    BudgetOfCall(const Budget*& place, const Budget* budget) : place_(place) { place_ = budget; }
    BudgetOfCall(const BudgetOfCall&) = delete;
    BudgetOfCall& operator=(const BudgetOfCall&) = delete;
    ~BudgetOfCall() { place_ = nullptr; }

   private:
    const Budget*& place_;
  };

  void load(const Config& config, std::initializer_list<const char*> methods);
  [[nodiscard]] pybind11::object made() const;
  [[nodiscard]] pybind11::dict plain_context(const Config& config, const ModuleContext& context) const;
  // Drops what is of Python; with the lock.
  void release();

  std::string file_;
  std::string module_name_;  // in sys.modules
  std::shared_ptr<const Budget*> budget_ = std::make_shared<const Budget*>(nullptr);
  std::uint64_t seed_ = 1;
  pybind11::object class_;
  pybind11::object context_;   // a dict
  pybind11::object settings_;  // a dict
  pybind11::object object_;
};

}  // namespace cairn::python_module
