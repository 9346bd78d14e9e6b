// Behaviour: one step of a mission, ticked until it is done.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/controller.hpp"
#include "framework/contracts/order.hpp"
#include "framework/contracts/plan_question.hpp"
#include "framework/contracts/planner.hpp"

namespace cairn {

enum class StepState { running, success, failure };

struct Status {
  StepState state = StepState::running;
  std::string reason;  // for people: what it is doing, or why it ended
  // While it runs: about how long it still takes, where it can say. For people; decides nothing.
  std::optional<double> left_s{};
  bool operator==(const Status&) const = default;
};

// A text for a file of the output folder.
struct OutputText {
  std::string file_name;  // plain, without folders
  std::string text;
  bool append = false;  // to what this mission has written there before; otherwise it takes the place of that
};

// What a behaviour may ask for, in three parts. Each request is carried out by the host, inside its own limits.
// "Throws": std::runtime_error.

class MotionRequests {
 public:
  virtual ~MotionRequests() = default;
  virtual void drive(const Twist& wanted) = 0;  // for this tick; no call: stop. Throws: no drive, no number
  // By the mission's controller, at once; the robot moves only by drive(). Throws: no controller.
  virtual ControlResult control(const ControlRequest& request) = 0;
  virtual PlanResult plan(const PlanRequest& request) = 0;  // by the mission's planner, at once; without one, no_route
};

class OutputRequests {
 public:
  virtual ~OutputRequests() = default;
  // Asks the mission's planner and adds its answer to a file of the output folder, one JSON object a line. Success when
  // it is solved; failure with the reason, which is in the file too, unless the question makes no sense on this map.
  virtual Status answer(const PlanQuestion& question, const std::string& file_name) = 0;
  // The map so far, into the output folder; success, or failure with its reason.
  virtual Status save(const std::string& file_name) = 0;
  // Success, or failure with its reason. Files of earlier missions are replaced, whatever is asked for.
  virtual Status write(const OutputText& output) = 0;
  virtual void report(const std::string& sentence) = 0;  // an event for people
};

// Places by name: those that steps hand to later ones, saved with the mission's progress, and landmarks and clusters of
// the map.
class NamedPlaces {
 public:
  virtual ~NamedPlaces() = default;
  virtual std::optional<Place> input(const std::string& name) = 0;  // what output() was last given; none: nothing yet
  virtual void output(const std::string& name, const Place& place) = 0;
  // From then on the landmark is found by this name as well. Success, or failure with the reason: no such landmark, or
  // a name that would find something else.
  virtual Status name_landmark(LandmarkId id, const std::string& name) = 0;
  // The same of a cluster, as the mission last formed them, by its id (C1:L4) or name. It keeps the name while it
  // lasts.
  virtual Status name_cluster(const std::string& cluster, const std::string& name) = 0;
};

// Orders that people give while the mission runs. Those that no behaviour asks for are refused with the tick.
class OrderRequests {
 public:
  virtual ~OrderRequests() = default;
  // The next one that has come, each once; none: no more in this tick.
  virtual std::optional<Order> next_order() = 0;
  // Of the order that was handed out last, before the next one: success when it is taken, and recorded with this tick;
  // failure when it is refused, with the reason. Whoever has sent it gets the answer.
  virtual void answer_order(const Status& answer) = 0;
};

class BehaviourContext : public MotionRequests, public OutputRequests, public NamedPlaces, public OrderRequests {};

class Behaviour {
 public:
  virtual ~Behaviour() = default;
  virtual Status tick(const WorldView& world, BehaviourContext& context) = 0;
  // Called when the step is left before it ended, and when it is to be done once more after its end; it must
  // not ask for anything. A tick after it begins the step afresh.
  virtual void halt() = 0;
  // Whether it makes sense only where the robot knows its place in the map. While it does not (PoseTrust::lost), such a
  // behaviour is not ticked: it waits.
  [[nodiscard]] virtual bool needs_pose() const { return true; }
};

// Not the BehaviourContext of a tick.
struct BehaviourFactoryContext : ModuleContext {
  std::vector<std::string> categories{};  // of landmarks that the mission can find; empty: not known
};

template <>
struct PluginTraits<Behaviour> {
  static constexpr PluginKind kKind = PluginKind::behaviour;
  using Context = BehaviourFactoryContext;
};

}  // namespace cairn
