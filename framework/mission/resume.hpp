// Going on with a mission from the map that it has saved.
#pragma once

#include <optional>
#include <string>

#include "framework/behaviour_tree/state.hpp"
#include "framework/mission/mission.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {

// The seed that the map was made with. Throws StoreError when it does not say.
[[nodiscard]] std::int64_t seed_of(const SavedMap& map);

// Throws StoreError with what does not fit, without the map's name: the map was not saved by a mission, or by
// another one, with another robot or seed, or with other steps.
void check_resumable(const SavedMap& map, const Mission& mission);

// Throws StoreError, without the map's name, when the map was made in another world. Maps without a word on it pass.
void check_same_world(const SavedMap& map, const Mission& mission);

// Where in the tree of the step under way the mission was, and of which tree.
inline constexpr const char* kTreeStateProperty = "tree_state";
struct SavedTree {
  std::string fingerprint;
  TreeState state;
};
// Of the step as `cairn mission show` prints it.
[[nodiscard]] std::string tree_fingerprint(const TreeNode& step);
void add_tree(SavedMap& map, const SavedTree& tree);
// Nothing in maps that do not say. Throws StoreError, without the map's name, when what they say is damaged.
[[nodiscard]] std::optional<SavedTree> saved_tree(const SavedMap& map);

// How long the mission had been paused: the world goes on meanwhile, its clock does not. Nothing is written of 0 s, and
// maps that do not say are of 0 s. Throws StoreError, without the map's name, when what they say is damaged.
void add_pauses(SavedMap& map, double paused_s);
[[nodiscard]] double paused_before(const SavedMap& map);

// Throws StoreError when the mission's map module makes grids of other cells than the saved one has.
void check_same_cells(const OccupancyGrid& saved, const OccupancyGrid& of_mission);

}  // namespace cairn
