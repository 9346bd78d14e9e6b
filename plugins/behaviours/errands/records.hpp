// Steps that write: a template of what was mapped, the planner's answer to a question, a line for people.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/behaviour.hpp"
#include "plugins/behaviours/places/place_name.hpp"

namespace cairn::behaviours {

struct CaptureTemplateConfig {
  ConfigValue at;    // a place
  ConfigValue name;  // text
  ConfigValue file;  // text; none: the name and .yaml
  double radius_m = 0.8;
  static void describe(Fields<CaptureTemplateConfig>& fields);
};

// Writes a template of what is mapped at a place, as `cairn template capture` does.
class CaptureTemplate : public Behaviour {
 public:
  // Throws ConfigError on a place that is none, a name that no template can have, and a file that is not NAME.yaml.
  explicit CaptureTemplate(const CaptureTemplateConfig& config);
  Status tick(const WorldView& world, BehaviourContext& context) override;
  void halt() override {}

 private:
  PlaceName at_;
  std::string category_;
  std::string file_name_;
  double radius_m_;
};

struct PlanQueryConfig {
  ConfigValue from;  // text; none: here
  ConfigValue to;    // text
  ConfigValue via;   // list of texts
  std::vector<std::string> avoid;
  std::vector<std::string> closed;
  int alternatives = 0;
  enum class Cost { length, time, clearance } cost = Cost::length;
  bool explain = false;
  ConfigValue file;  // text; none: answers.jsonl
  static void describe(Fields<PlanQueryConfig>& fields);
};

// Asks the mission's planner, and adds its answer to a file.
class PlanQuery : public Behaviour {
 public:
  // Throws ConfigError on questions that make no sense on any map, and a file that is not NAME.jsonl.
  explicit PlanQuery(const PlanQueryConfig& config);
  Status tick(const WorldView& world, BehaviourContext& context) override;
  void halt() override {}

 private:
  PlanQuestion question_;
  std::string file_name_;
};

struct LogConfig {
  ConfigValue text;
  static void describe(Fields<LogConfig>& fields);
};

// Says a line, with values of the moment in the place of their names in braces.
class Log : public Behaviour {
 public:
  // Throws ConfigError on a name in braces that is none, with the nearest one, and on a brace without its other one.
  explicit Log(const LogConfig& config);
  Status tick(const WorldView& world, BehaviourContext& context) override;
  void halt() override {}
  [[nodiscard]] bool needs_pose() const override { return false; }

 private:
  struct Piece {
    std::string text;
    bool is_name = false;
  };
  std::vector<Piece> segments_;
};

}  // namespace cairn::behaviours
