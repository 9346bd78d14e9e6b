// Settings of a module written in Python: the same for every kind, and the names of places for a behaviour.
#pragma once

#include <string>

#include "framework/config/fields.hpp"

namespace cairn::python_module {

// As they stand, so that errors can name the place.
struct Config {
  ConfigValue file;
  ConfigValue class_name;
  ConfigValue settings;

  static void describe(Fields<Config>& fields) { describe_for(fields); }
  template <class Derived>
  static void describe_for(Fields<Derived>& fields) {
    fields.raw("file", &Derived::file, "file", "the Python file").required = true;
    fields.raw("class", &Derived::class_name, "text", "the class in it that an object is made of").required = true;
    fields.raw("settings", &Derived::settings, "map", "what the class is made with, by the names of its parameters");
  }
};

struct BehaviourConfig : Config {
  std::string input;
  std::string output;

  static void describe(Fields<BehaviourConfig>& fields) {
    describe_for(fields);
    fields.input("input", &BehaviourConfig::input, "the name of a place that an earlier step gives: `context.input`");
    fields.output("output", &BehaviourConfig::output, "the name of the place that this step gives: `context.output`");
  }
};

}  // namespace cairn::python_module
