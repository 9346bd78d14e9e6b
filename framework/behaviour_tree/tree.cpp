#include "framework/behaviour_tree/tree.hpp"

#include <algorithm>
#include <iterator>
#include <system_error>

#include "framework/behaviour_tree/parameters.hpp"
#include "framework/behaviour_tree/sub_mission_file.hpp"
#include "framework/config/named_category.hpp"
#include "maps/base/printable.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

constexpr std::size_t kMaxValues = 1'000'000;
constexpr const char* kName = "name";
constexpr const char* kChild = "do";

// A file as messages call it.
std::string called(const std::filesystem::path& file) {
  return file.filename().string();
}

// An item of a list of nodes: one key, the node's, with what stands behind it; and perhaps a name for people.
struct Item {
  std::string keyword;
  SourcePlace place;
  ConfigValue value;
  std::string name;
};

Item item_of(const ConfigValue& item) {
  if (item.kind == ConfigValue::Kind::scalar) {
    ConfigValue nothing;
    nothing.place = item.place;
    return {item.scalar, item.place, nothing, item.scalar};
  }
  // Alone and with settings, it is the behaviour of that name.
  const bool is_behaviour = item.entries.size() == 1 && item.entries.front().value.kind == ConfigValue::Kind::map;
  const ConfigValue* name = is_behaviour ? nullptr : item.find(kName);
  const std::size_t keys = item.entries.size() - (name != nullptr ? 1 : 0);
  if (item.kind != ConfigValue::Kind::map || keys != 1)
    throw ConfigError(
        item.place,
        "a step is one behaviour or node with its settings, such as `goto: {landmark: nearest square}`, not " +
            item.kind_name() + (item.kind == ConfigValue::Kind::map ? " with " + counted(keys, "key") : ""));
  const ConfigValue::Entry& entry =
      item.entries[item.entries.front().key == kName && keys < item.entries.size() ? 1 : 0];
  if (name == nullptr) return {entry.key, entry.key_place, entry.value, entry.key};
  if (config_detail::to_text(*name, kName).empty()) throw ConfigError(name->place, "name: a node's name is not empty");
  return {entry.key, entry.key_place, entry.value, name->scalar};
}

class TreeReader {
 public:
  explicit TreeReader(const std::filesystem::path& file) : chain_{{canonical(file), called(file)}} {}

  MissionTree read(const ConfigValue& steps) {
    MissionTree tree;
    attempt([&] {
      if (steps.kind == ConfigValue::Kind::null && steps.place.file.empty()) return;
      if (steps.kind != ConfigValue::Kind::list || steps.items.empty())
        throw ConfigError(
            steps.place,
            "steps: expected a list of at least one step, found " +
                (steps.items.empty() && steps.kind == ConfigValue::Kind::list ? "an empty list" : steps.kind_name()));
      tree.steps = nodes_of(with_parameters(steps, {"the mission itself", {}}, values_left_, errors_), "");
    });
    if (errors_.empty()) errors_ = unreachable_nodes(tree.steps);
    tree.errors = std::move(errors_);
    return tree;
  }

 private:
  struct File {
    std::filesystem::path path;
    std::string name;
  };

  static std::filesystem::path canonical(const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::path path = std::filesystem::weakly_canonical(file, error);
    return error ? file : path;
  }

  // What is wrong with one node is no reason not to look at the next.
  template <class Work>
  void attempt(Work work) {
    try {
      work();
    } catch (const ConfigError& error) {
      std::ranges::move(each_of(error), std::back_inserter(errors_));
    }
  }

  std::vector<TreeNode> nodes_of(const ConfigValue& list, const std::string& above) {
    std::vector<TreeNode> nodes;
    for (std::size_t i = 0; i < list.items.size(); ++i) {
      const std::string path = (above.empty() ? "" : above + "/") + std::to_string(i + 1);
      attempt([&] {
        try {
          nodes.push_back(node_of(list.items[i], path));
        } catch (const ConfigError& error) {
          throw with_place_of_use(error, list.items[i], list.items[i].place);
        }
      });
    }
    return nodes;
  }

  TreeNode node_of(const ConfigValue& value, const std::string& path) {
    const Item item = item_of(value);
    count(item.place, path);
    if (const std::size_t found = first_unprintable(item.name); found != std::string::npos)
      throw ConfigError(item.place,
                        "the name " + in_quotes(item.name) + " holds " + name_of_unprintable(item.name, found));
    TreeNode node;
    node.name = item.name;
    node.path = path;
    node.choice = {item.keyword, item.value};
    node.place = item.place;
    if (item.value.kind == ConfigValue::Kind::null) node.choice.config.kind = ConfigValue::Kind::map;
    // What is missing in a map is reported where the node stands; a short form is wrong where it was written.
    if (node.choice.config.kind == ConfigValue::Kind::map) node.choice.config.place = item.place;
    if (const NodeType* type = find_node_type(item.keyword)) {
      node.kind = type->kind;
      fill(node, type->shape, item.value);
    }
    return node;
  }

  void count(const SourcePlace& place, const std::string& path) {
    if (++nodes_ > kMaxTreeNodes)
      throw ConfigError(place, "the mission has more than " + std::to_string(kMaxTreeNodes) + " nodes");
    if (static_cast<std::size_t>(std::ranges::count(path, '/')) >= kMaxTreeDepth)
      throw ConfigError(place, "the nodes are nested deeper than " + std::to_string(kMaxTreeDepth) + " levels");
  }

  void fill(TreeNode& node, NodeShape shape, const ConfigValue& value) {
    if (shape == NodeShape::nodes) {
      node.children = some_nodes(value, node);
    } else if (shape == NodeShape::one_node) {
      node.children.push_back(child_of(value, node));
    } else if (is_condition(node.kind)) {
      node.condition = condition_of(node, value);
    } else if (node.kind == NodeKind::mission) {
      run_file(node, load_config<SubMissionSettings>(value, node.choice.name));
    } else if (node.kind == NodeKind::parallel) {
      fill_parallel(node, load_config<ParallelSettings>(value, node.choice.name));
    } else if (node.kind == NodeKind::timeout) {
      const auto settings = load_config<TimeoutSettings>(value, node.choice.name);
      node.after_s = settings.after_s;
      node.children.push_back(child_of(settings.child, node));
    } else {
      const auto settings = load_config<RoundsSettings>(value, node.choice.name);
      node.times = rounds_of(settings.times);
      node.children.push_back(child_of(settings.child, node));
    }
    forget_children(node, shape);
  }

  // Settings are shown without the children.
  static void forget_children(TreeNode& node, NodeShape shape) {
    ConfigValue& config = node.choice.config;
    if (shape == NodeShape::settings) return;
    if (shape != NodeShape::settings_node || config.kind == ConfigValue::Kind::list) {
      const SourcePlace place = config.place;
      config = {};
      config.kind = ConfigValue::Kind::map;
      config.place = place;
    }
    std::erase_if(config.entries, [](const ConfigValue::Entry& entry) { return entry.key == kChild; });
  }

  std::vector<TreeNode> some_nodes(const ConfigValue& value, const TreeNode& parent) {
    if (value.kind != ConfigValue::Kind::list || value.items.empty())
      throw ConfigError(value.kind == ConfigValue::Kind::null ? parent.place : value.place,
                        parent.choice.name + " needs a list of at least one node, found " +
                            (value.kind == ConfigValue::Kind::list ? "an empty list" : value.kind_name()));
    return nodes_of(value, parent.path);
  }

  TreeNode child_of(const ConfigValue& value, const TreeNode& parent) {
    const bool is_list = value.kind == ConfigValue::Kind::list;
    if (value.kind == ConfigValue::Kind::null || (is_list && value.items.empty()))
      throw ConfigError(value.kind == ConfigValue::Kind::null ? parent.place : value.place,
                        parent.choice.name + " needs one node, found " + (is_list ? "an empty list" : "nothing"));
    const std::string path = parent.path + "/1";
    if (!is_list) return node_of(value, path);
    if (value.items.size() == 1) return node_of(value.items.front(), path);
    count(value.place, path);
    TreeNode node;
    node.kind = NodeKind::sequence;
    node.name = node.choice.name = name_of(node.kind);
    node.choice.config.kind = ConfigValue::Kind::map;
    node.place = node.choice.config.place = value.place;
    node.path = path;
    node.children = nodes_of(value, path);
    return node;
  }

  void fill_parallel(TreeNode& node, const ParallelSettings& settings) {
    const std::size_t children = settings.child.items.size();
    node.children = some_nodes(settings.child, node);
    node.succeed_at = count_of(settings.succeed_when, "succeed_when", children, children);
    node.fail_at = count_of(settings.fail_when, "fail_when", children, 1);
  }

  static std::size_t count_of(const ConfigValue& value, const std::string& key, std::size_t children,
                              std::size_t usual) {
    if (value.kind == ConfigValue::Kind::null) return usual;
    if (value.kind == ConfigValue::Kind::scalar && value.scalar == "all") return children;
    if (value.kind == ConfigValue::Kind::scalar && value.scalar == "any") return 1;
    if (value.kind == ConfigValue::Kind::scalar && value.kind_name() == "text")
      throw ConfigError(value.place, key + " must be all, any or a number, found " + in_quotes(value.scalar) +
                                         did_you_mean(value.scalar, {"all", "any"}));
    const std::int64_t number = config_detail::to_integer(value, key, {1.0, 1e9});
    if (number > static_cast<std::int64_t>(children))
      throw ConfigError(value.place, key + ": " + std::to_string(number) + " of only " +
                                         (children == 1 ? "1 child" : std::to_string(children) + " children"));
    return static_cast<std::size_t>(number);
  }

  static int rounds_of(const ConfigValue& value) {
    const bool is_text = value.kind == ConfigValue::Kind::scalar && value.kind_name() == "text";
    if (is_text && value.scalar == "forever") return 0;
    if (is_text)
      throw ConfigError(value.place, "times must be forever or a number, found " + in_quotes(value.scalar) +
                                         did_you_mean(value.scalar, {"forever"}));
    return static_cast<int>(config_detail::to_integer(value, "times", {1.0, 1e9}));
  }

  static Condition condition_of(const TreeNode& node, const ConfigValue& value) {
    Condition condition;
    const std::string& what = node.choice.name;
    if (node.kind == NodeKind::landmark_known) {
      condition.landmark = load_config<LandmarkKnownSettings>(value, what).landmark;
    } else if (node.kind == NodeKind::explored) {
      condition.number = load_config<ExploredSettings>(value, what).at_least_ratio;
    } else if (node.kind == NodeKind::at_place) {
      const auto settings = load_config<AtPlaceSettings>(value, what);
      if (value.kind != ConfigValue::Kind::scalar)
        (void)config_detail::exactly_one_of(node.choice.config, {"landmark", "at_m"}, what);
      condition = {settings.landmark, settings.at_m, settings.within_m};
    } else if (node.kind == NodeKind::battery_above) {
      condition.number = load_config<BatterySettings>(value, what).ratio;
    } else {
      condition.number = load_config<TimeSettings>(value, what).time_s;
    }
    const bool needs_landmark =
        node.kind == NodeKind::landmark_known || (node.kind == NodeKind::at_place && !condition.at_m);
    if (needs_landmark && condition.landmark.empty())
      throw ConfigError(value.place, what + " needs a landmark or category, found an empty text");
    if (needs_landmark && names_nothing(condition.landmark))
      throw ConfigError(value.place, what + ": " + in_quotes(condition.landmark) + " names no category");
    return condition;
  }

  void run_file(TreeNode& node, const SubMissionSettings& settings) {
    const SourcePlace& place = node.place;
    if (node.name == node.choice.name) node.name = settings.file.stem().string();
    const File file{canonical(settings.file), called(settings.file)};
    refuse_recursion(file, place);
    const auto sub = read_sub_mission(settings.file, chain_.back().path, place);
    const Parameters parameters = bind_parameters(sub, file.name, settings.with, place);
    const ConfigValue steps = with_parameters(sub.steps, parameters, values_left_, errors_);
    chain_.push_back(file);
    attempt([&] { node.children = some_nodes(steps, node); });
    chain_.pop_back();
  }

  void refuse_recursion(const File& file, const SourcePlace& place) const {
    const auto at = std::ranges::find(chain_, file.path, &File::path);
    if (at == chain_.end()) return;
    std::string chain;
    for (auto i = at; i != chain_.end(); ++i) chain += i->name + " -> ";
    throw ConfigError(place, file.name + " would run itself: " + chain + file.name);
  }

  std::vector<File> chain_;  // of files, the mission's first
  std::size_t nodes_ = 0;
  std::size_t values_left_ = kMaxValues;
  std::vector<ConfigError> errors_;
};

void collect_behaviours(const std::vector<TreeNode>& nodes, std::vector<const TreeNode*>& found) {
  for (const TreeNode& node : nodes) {
    if (node.kind == NodeKind::behaviour) found.push_back(&node);
    collect_behaviours(node.children, found);
  }
}

}  // namespace

MissionTree read_mission_tree(const ConfigValue& steps, const std::filesystem::path& file) {
  return TreeReader(file).read(steps);
}

std::vector<const TreeNode*> behaviours_of(const std::vector<TreeNode>& steps) {
  std::vector<const TreeNode*> found;
  collect_behaviours(steps, found);
  return found;
}

std::size_t count_nodes(const std::vector<TreeNode>& steps) {
  std::size_t count = steps.size();
  for (const TreeNode& step : steps) count += count_nodes(step.children);
  return count;
}

}  // namespace cairn
