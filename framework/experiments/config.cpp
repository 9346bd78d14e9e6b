#include "framework/experiments/config.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/experiments/factors.hpp"

namespace cairn {
namespace {

const std::vector<std::pair<std::string, ExperimentKind>>& kinds() {
  static const std::vector<std::pair<std::string, ExperimentKind>> kKinds{{"missions", ExperimentKind::missions},
                                                                          {"maps", ExperimentKind::maps},
                                                                          {"places", ExperimentKind::places},
                                                                          {"orbit", ExperimentKind::orbit},
                                                                          {"recognition", ExperimentKind::recognition},
                                                                          {"curves", ExperimentKind::curves},
                                                                          {"trials", ExperimentKind::trials},
                                                                          {"buildings", ExperimentKind::buildings},
                                                                          {"homes", ExperimentKind::homes}};
  return kKinds;
}

void check_places(const ExperimentConfig& config, const ConfigValue& root) {
  if (config.places.empty()) throw ConfigError(root.place, "an experiment of places must list some under places");
  for (std::size_t i = 0; i < config.places.size(); ++i) {
    const PlaceConfig& place = config.places[i];
    const ConfigValue& value = root.find("places")->items[i];
    if (std::ranges::find(config.categories, place.looks_at) == config.categories.end())
      throw ConfigError(value.find("looks_at")->place, "\"" + place.looks_at + "\" is not among the categories" +
                                                           did_you_mean(place.looks_at, config.categories));
    if (!place.expected.empty() && place.expected.size() != config.categories.size())
      throw ConfigError(value.find("expected")->place,
                        "expected must give one degree for each of the " + std::to_string(config.categories.size()) +
                            " categories, found " + std::to_string(place.expected.size()));
  }
}

// Ranges that fit together. value: the map `worlds`.
void check_worlds(const RandomWorldConfig& worlds, const ConfigValue& value) {
  const auto place_of = [&](const char* key, const char* other) {
    const ConfigValue* given = value.find(key) != nullptr ? value.find(key) : value.find(other);
    return given != nullptr ? given->place : value.place;
  };
  if (worlds.min_landmarks > worlds.max_landmarks)
    throw ConfigError(place_of("min_landmarks", "max_landmarks"),
                      fmt::format("min_landmarks must be at most max_landmarks, found {} and {}", worlds.min_landmarks,
                                  worlds.max_landmarks));
  if (worlds.min_movers > worlds.max_movers)
    throw ConfigError(
        place_of("min_movers", "max_movers"),
        fmt::format("min_movers must be at most max_movers, found {} and {}", worlds.min_movers, worlds.max_movers));
  for (const auto& [name, axis] : {std::pair{"x", 0}, {"y", 1}}) {
    if (worlds.smallest_room_m[axis] > worlds.largest_room_m[axis])
      throw ConfigError(place_of("smallest_room_m", "largest_room_m"),
                        fmt::format("{} of smallest_room_m must be at most that of largest_room_m, found {:g} and {:g}",
                                    name, worlds.smallest_room_m[axis], worlds.largest_room_m[axis]));
    if (worlds.start_m[axis] >= worlds.smallest_room_m[axis])
      throw ConfigError(place_of("start_m", "smallest_room_m"),
                        fmt::format("start_m must lie within the smallest room: its {} is {:g}, that of "
                                    "smallest_room_m {:g}",
                                    name, worlds.start_m[axis], worlds.smallest_room_m[axis]));
  }
}

// value: the map `trials`.
void check_trials(const ExperimentConfig& config, const ConfigValue& value) {
  if (config.trials.robots.empty())
    throw ConfigError(value.find("robots")->place, "robots must list at least one robot file");
  if (config.trials.min_goals > config.trials.max_goals) {
    const ConfigValue* given = value.find("min_goals") != nullptr ? value.find("min_goals") : value.find("max_goals");
    throw ConfigError(given->place, fmt::format("min_goals must be at most max_goals, found {} and {}",
                                                config.trials.min_goals, config.trials.max_goals));
  }
}

// Ranges that fit together. value: the map `homes`.
void check_homes(const HomesConfig& homes, const ConfigValue& value) {
  const auto ordered = [&](const char* low, const char* high, double a, double b) {
    if (a <= b) return;
    const ConfigValue* given = value.find(low) != nullptr ? value.find(low) : value.find(high);
    throw ConfigError(given->place, fmt::format("{} must be at most {}, found {:g} and {:g}", low, high, a, b));
  };
  ordered("min_rooms", "max_rooms", homes.min_rooms, homes.max_rooms);
  ordered("min_area_m2", "max_area_m2", homes.min_area_m2, homes.max_area_m2);
  ordered("min_door_m", "max_door_m", homes.min_door_m, homes.max_door_m);
}

// What an experiment is about: the missions listed, or drawn ones.
void check_missions(const ExperimentConfig& config, const ConfigValue& root) {
  const ConfigValue* missions = root.find("missions");
  const ConfigValue* trials = root.find("trials");
  const bool of_buildings = config.experiment == ExperimentKind::buildings;
  if (const ConfigValue* buildings = root.find("buildings"); buildings != nullptr && !of_buildings)
    throw ConfigError(buildings->place, "buildings goes with experiment: buildings");
  if (of_buildings) {
    if (missions != nullptr) throw ConfigError(missions->place, "an experiment of buildings runs no missions");
    if (config.buildings.sides_m.empty())
      throw ConfigError(root.find("buildings")->place, "sides_m must list at least one side");
  } else if (config.experiment == ExperimentKind::trials) {
    if (missions != nullptr)
      throw ConfigError(missions->place, "an experiment of trials draws its missions and lists none");
    if (trials == nullptr) throw ConfigError(root.place, "an experiment of trials must say under trials what it draws");
    check_trials(config, *trials);
  } else {
    if (trials != nullptr) throw ConfigError(trials->place, "trials goes with experiment: trials");
    if (missions == nullptr) throw ConfigError(root.place, "experiment lacks the key \"missions\": mission files");
    if (config.missions.empty()) throw ConfigError(missions->place, "missions must list at least one file");
  }
}

// The variants' names, after the objections to them and to the missions' file names.
std::vector<std::string> checked_names(const ExperimentConfig& config, const ConfigValue& root) {
  std::vector<std::string> names;
  for (const ExperimentVariant& variant : config.variants) {
    if (variant.name.empty() || variant.name.front() == '.')
      throw ConfigError(root.find("variants")->place,
                        "a variant's name is also a folder's, and \"" + variant.name + "\" cannot be one");
    if (std::ranges::find(names, variant.name) != names.end())
      throw ConfigError(root.find("variants")->place, "two variants are called \"" + variant.name + "\"");
    names.push_back(variant.name);
  }
  std::vector<std::string> stems;
  for (const std::filesystem::path& mission : config.missions) {
    if (std::ranges::find(stems, mission.stem().string()) != stems.end())
      throw ConfigError(root.find("missions")->place, "two missions have the file name \"" + mission.stem().string() +
                                                          "\"; tables and folders are named by it");
    stems.push_back(mission.stem());
  }
  return names;
}

// Each a module with its settings, as in a mission, and a name.
std::vector<ComparedDetector> detectors_of(const ConfigValue& list) {
  if (list.kind != ConfigValue::Kind::list)
    throw ConfigError(list.place,
                      "detectors must be a list of {name: ..., plugin: ..., its settings}, found " + list.kind_name());
  std::vector<ComparedDetector> detectors;
  for (const ConfigValue& item : list.items) {
    ComparedDetector detector{"", config_detail::to_plugin(item, "detectors")};
    const ConfigValue* name = item.find("name");
    if (name == nullptr) throw ConfigError(item.place, "detectors lacks the key \"name\": what it is called in tables");
    detector.name = config_detail::to_text(*name, "name");
    if (detector.name.empty()) throw ConfigError(name->place, "a detector's name must not be empty");
    if (std::ranges::find(detectors, detector.name, &ComparedDetector::name) != detectors.end())
      throw ConfigError(name->place, "two detectors are called " + in_quotes(detector.name));
    std::erase_if(detector.choice.config.entries, [](const ConfigValue::Entry& entry) { return entry.key == "name"; });
    detectors.push_back(std::move(detector));
  }
  return detectors;
}

}  // namespace

bool in_random_worlds(ExperimentKind kind) {
  return kind == ExperimentKind::recognition || kind == ExperimentKind::curves;
}

std::string_view name_of(ExperimentKind kind) {
  return std::ranges::find(kinds(), kind, &std::pair<std::string, ExperimentKind>::second)->first;
}

void SeedRange::describe(Fields<SeedRange>& fields) {
  fields.integer("from", &SeedRange::from, {0.0, 9.0e15}, "first seed");
  fields.integer("count", &SeedRange::count, {1.0, 100000.0}, "how many seeds");
}

void ExperimentVariant::describe(Fields<ExperimentVariant>& fields) {
  fields.file_name("name", &ExperimentVariant::name, "what it is called in tables").required = true;
  fields.texts("set", &ExperimentVariant::overrides,
               "settings to override, each `key=value`: of the missions; `robot.key=value` of the robot file; of "
               "`recognition` and `curves` also `worlds.key=value` and `specular_ratio=value`");
  fields.file("robot", &ExperimentVariant::robot, "robot file in place of the missions' own");
  fields.file("world", &ExperimentVariant::world, "world file in place of the missions' own");
  fields.number("specular_ratio", &ExperimentVariant::specular_ratio, {0.0, 1.0}, "",
                "of `recognition` and `curves`: share of walls and things with a smooth surface");
}

void FactorConfig::describe(Fields<FactorConfig>& fields) {
  fields.file_name("name", &FactorConfig::name, "what it is called in tables, charts and folders").required = true;
  fields.text("label", &FactorConfig::label, "its axis in the chart, with the unit; left out, the name");
  fields.texts("set", &FactorConfig::set, "as a variant's set, with {} where the value goes").required = true;
  fields.texts("values", &FactorConfig::values, "its values, a variant each").required = true;
}

void PlaceConfig::describe(Fields<PlaceConfig>& fields) {
  fields.text("name", &PlaceConfig::name, "what it is called in tables").required = true;
  fields
      .text("looks_at", &PlaceConfig::looks_at,
            "category of the landmark that is looked at from there; the world has one of it")
      .required = true;
  fields.numbers("expected", &PlaceConfig::expected, {0.0, 1.0}, "",
                 "degrees published elsewhere, in the order of `categories`, to be printed beside");
}

void OrbitConfig::describe(Fields<OrbitConfig>& fields) {
  fields.text("around", &OrbitConfig::around, "category of the landmark, of which the world has one").required = true;
  fields.angle("bin_deg", &OrbitConfig::bin_rad, {1.0, 180.0},
               "one point of the charts in each such part of the orbit");
}

namespace {

// What only some kinds of experiment have.
void describe_kinds(Fields<ExperimentConfig>& fields) {
  using C = ExperimentConfig;
  fields.texts("categories", &C::categories,
               "of `places` and `orbit`: the categories, in the order of the table's columns");
  fields.list("places", &C::places,
              "of `places`: one at the end of each of the mission's steps; its degrees are those of the last matching "
              "before that looked at its landmark");
  fields.group("orbit", &C::orbit, "of `orbit`: the orbit");
  fields.group(
      "worlds", &C::worlds,
      "of `recognition`, `curves` and `trials`: the world of each seed, which takes the place of the missions' own");
  fields.group("trials", &C::trials, "of `trials`: the missions that are drawn, how they are judged, and limits");
  fields.group("buildings", &C::buildings, "of `buildings`: the buildings and the questions");
  fields.group("homes", &C::homes,
               "of `homes`: the home of each seed, which takes the place of the missions' own world and start");
  fields.raw("detectors", &C::detectors_as_given, "list of detectors",
             "of `curves`: each `{name: in tables, plugin: MODULE, its settings}`, run afresh on the finished grid. A "
             "setting left out is as the mission's own detector has it; but tau_match is 0");
  fields.flag("ring_profile", &C::ring_profile,
              "of `recognition`: also where the landmarks' outlines lie in the finished maps, as a table and a chart");
  fields.number("looks_within_m", &C::looks_within_m, {0.01, 10.0}, "m",
                "a matching looks at a landmark when the middle of its region is this near to the landmark's");
  fields.integer("expected_matchings", &C::expected_matchings, {0.0, 1e9},
                 "of `places`: number of matchings published elsewhere");
}

}  // namespace

void ExperimentConfig::describe(Fields<ExperimentConfig>& fields) {
  using C = ExperimentConfig;
  fields
      .choice(
          "experiment", &C::experiment, kinds(),
          "what is measured: `missions`, whether the landmarks were found; `maps`, how good the map is against "
          "the true world, and how well it predicts readings that were held out of it; `places`, how well "
          "each category fits at given places of the drive; `orbit`, how well each category and each template "
          "fits along an orbit round a landmark; `recognition`, which landmarks are found in random worlds; `curves`, "
          "precision "
          "and recall of several detectors on the grids of the same runs, at every threshold; `trials`, what comes of "
          "random missions in random worlds with random faults; `buildings`, what questions to the maps of small and "
          "large buildings cost; `homes`, which rooms of random homes are entered and how much of them is known, "
          "whatever the mission does there")
      .required = true;
  fields.files("missions", &C::missions,
               "mission files; needed but for `trials`, which draws its own, and `buildings`");
  fields.list("variants", &C::variants, "each mission is run in each of them; without any, as it stands");
  fields.list("vary", &C::vary, "of `recognition`: factors of a study, one varied at a time; a table and a chart each");
  fields.text("baseline", &C::baseline, "name of the variant that the others are compared with, seed by seed");
  fields.group("seeds", &C::seeds, "which seeds");
  fields.integer("hold_out_every", &C::hold_out_every, {0.0, 1e6}, "as the missions' setting of this name");
  fields.number("tolerance_m", &C::tolerance_m, {0.0, 100.0}, "m", "a landmark further from the truth counts as false");
  fields.number(
      "max_contact_mps", &C::max_contact_mps, {0.0, 10.0}, "m/s",
      "limit of `missions` and `trials`: no contact, seen or not, is faster by the truth; adds a table of contacts");
  fields.number(
      "at_least_ratio", &C::at_least_ratio, {0.0, 1.0}, "",
      "share of good runs (of `trials`: of reached goals among the reachable ones that no fault took away; of "
      "`homes`: of the rooms entered and of the area known, each) "
      "that makes the experiment a success");
  fields.texts("set", &C::overrides, "settings of the missions to override, each `key=value`");
  describe_kinds(fields);
}

ExperimentConfig load_experiment(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  ConfigValue root = read_config_file(file);
  for (const std::string& assignment : overrides) apply_override(root, assignment);
  auto config = load_config<ExperimentConfig>(root, "experiment");
  check_missions(config, root);
  if (!config.vary.empty() && config.experiment != ExperimentKind::recognition)
    throw ConfigError(root.find("vary")->place, "vary goes with experiment: recognition");
  add_factor_variants(config, root);
  if (config.variants.empty()) config.variants.emplace_back().name = "as_is";
  const std::vector<std::string> names = checked_names(config, root);
  for (std::size_t i = 0; i < config.variants.size(); ++i) {
    ExperimentVariant& variant = config.variants[i];
    sort_overrides(variant, root);
    const ConfigValue* const worlds = root.find("worlds");
    if (variant.worlds) check_worlds(*variant.worlds, worlds == nullptr ? root : *worlds);
    if (!variant.robot.empty()) variant.overrides.push_back("robot=" + variant.robot.string());
    if (!variant.world.empty() && (in_random_worlds(config.experiment) || config.experiment == ExperimentKind::trials ||
                                   config.experiment == ExperimentKind::homes))
      throw ConfigError(root.find("variants")->items[i].find("world")->place,
                        "variant \"" + variant.name + "\" names a world, but each run of " +
                            std::string(name_of(config.experiment)) + " has its own");
    if (!variant.world.empty()) variant.overrides.push_back("world=" + variant.world.string());
  }
  if (!config.baseline.empty() && std::find(names.begin(), names.end(), config.baseline) == names.end())
    throw ConfigError(root.find("baseline")->place,
                      "no variant is called \"" + config.baseline + "\"" + did_you_mean(config.baseline, names));
  const bool of_places = config.experiment == ExperimentKind::places;
  const bool of_orbit = config.experiment == ExperimentKind::orbit;
  if ((of_places || of_orbit) && config.categories.empty())
    throw ConfigError(root.place, "an experiment of places or of an orbit must list its categories");
  if (of_places) check_places(config, root);
  if (of_orbit && !config.orbit)
    throw ConfigError(root.place, "an experiment of an orbit must say under orbit what it goes round");
  if (const ConfigValue* worlds = root.find("worlds")) check_worlds(config.worlds, *worlds);
  if (const ConfigValue* homes = root.find("homes")) check_homes(config.homes, *homes);
  if (config.detectors_as_given.kind != ConfigValue::Kind::null)
    config.detectors = detectors_of(config.detectors_as_given);
  if (config.experiment == ExperimentKind::curves && config.detectors.empty())
    throw ConfigError(root.place, "an experiment of curves must list the detectors to compare under detectors");
  return config;
}

}  // namespace cairn
