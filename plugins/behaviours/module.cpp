#include "framework/contracts/module.hpp"

#include <memory>
#include <type_traits>

#include "framework/config/named_category.hpp"
#include "plugins/behaviours/docking/dock.hpp"
#include "plugins/behaviours/errands/await_orders.hpp"
#include "plugins/behaviours/errands/find_myself.hpp"
#include "plugins/behaviours/errands/go_to.hpp"
#include "plugins/behaviours/errands/name_landmark.hpp"
#include "plugins/behaviours/errands/records.hpp"
#include "plugins/behaviours/errands/return_home.hpp"
#include "plugins/behaviours/errands/search.hpp"
#include "plugins/behaviours/errands/simple_steps.hpp"
#include "plugins/behaviours/errands/tour.hpp"
#include "plugins/behaviours/exploring/explore.hpp"
#include "plugins/behaviours/exploring/inspect.hpp"
#include "plugins/behaviours/following/waiting_while_stopped.hpp"

namespace {

using namespace cairn;
using namespace cairn::behaviours;

template <class Step, class Config>
std::unique_ptr<Behaviour> made(const Config& config, const BehaviourFactoryContext& context) {
  if constexpr (std::is_constructible_v<Step, Config, std::uint64_t, std::vector<std::string>>)
    return std::make_unique<Step>(config, context.seed, context.categories);
  else if constexpr (std::is_constructible_v<Step, Config, std::uint64_t>)
    return std::make_unique<Step>(config, context.seed);
  else
    return std::make_unique<Step>(config);
}

// places: the settings that name some.
template <class Step, class Config, class... Member>
void add(Registrar& registrar, const char* name, const char* summary, Member... places) {
  registrar.add<Behaviour, Config>(name, summary, [=](const Config& config, const BehaviourFactoryContext& context) {
    (check_named_categories(config.*places, name, context.categories), ...);
    return made<Step>(config, context);
  });
}

// A behaviour that drives all the time.
template <class Step, class Config, class... Member>
void add_driving(Registrar& registrar, const char* name, const char* summary, Member... places) {
  registrar.add<Behaviour, Config>(name, summary, [=](const Config& config, const BehaviourFactoryContext& context) {
    (check_named_categories(config.*places, name, context.categories), ...);
    return std::make_unique<WaitingWhileStopped>(made<Step>(config, context));
  });
}

void register_module(Registrar& registrar) {
  add_driving<Explore, ExploreConfig>(
      registrar, "explore", "explores the reachable space at a safe distance and looks closer at what it finds");
  add_driving<FindMyself, FindMyselfConfig>(registrar, "find_myself",
                                            "drives until a robot that is lost has found itself in its map");
  add_driving<Search, SearchConfig>(registrar, "search", "explores until so many landmarks of a category are known");
  add_driving<Inspect, InspectConfig>(registrar, "inspect",
                                      "goes to a landmark and circles it until its degree does not rise any more",
                                      &InspectConfig::landmark);
  add_driving<GoTo, GoToConfig>(registrar, "goto", "goes to a landmark or a place by the mission's planner",
                                &GoToConfig::landmark);
  add_driving<Tour, TourConfig>(registrar, "tour", "visits places, in the given or the shortest order",
                                &TourConfig::places);
  add_driving<Patrol, PatrolConfig>(registrar, "patrol", "visits places again and again, or all known landmarks",
                                    &PatrolConfig::places);
  add_driving<ReturnHome, ReturnHomeConfig>(registrar, "return_home", "goes back to where the mission began",
                                            &ReturnHomeConfig::to);
  add_driving<Dock, DockConfig>(registrar, "dock", "stops at a distance beside a landmark, on a given side of it",
                                &DockConfig::landmark);
  add_driving<DriveTo, DriveConfig>(registrar, "drive", "drives straight from point to point");
  // Takes orders while the robot is stopped, too; what it carries out waits.
  add<AwaitOrders, AwaitOrdersConfig>(registrar, "await_orders",
                                      "waits for orders that people give while the mission runs, and carries each out");
  add<Wait, WaitConfig>(registrar, "wait", "stands still for a time");
  add<NameLandmark, NameConfig>(registrar, "name", "gives a landmark a name, by which steps and questions find it",
                                &NameConfig::landmark);
  add<Save, SaveConfig>(registrar, "save", "saves the map so far into the output folder");
  add<CaptureTemplate, CaptureTemplateConfig>(registrar, "capture_template",
                                              "writes a template of what is mapped at a place into the output folder",
                                              &CaptureTemplateConfig::at);
  add<PlanQuery, PlanQueryConfig>(registrar, "plan_query",
                                  "asks the mission's planner and writes its answer into the output folder",
                                  &PlanQueryConfig::from, &PlanQueryConfig::to, &PlanQueryConfig::via);
  add<Log, LogConfig>(registrar, "log", "publishes a line for people");
}

}  // namespace

CAIRN_MODULE(register_module)
