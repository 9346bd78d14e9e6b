#include "maps/grid/travel_regions.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>

namespace cairn {
namespace {

float length_of_step_m(int step, double cell_m) {
  const Cell by = DiscLattice::kSteps[step];
  return static_cast<float>(by.x != 0 && by.y != 0 ? cell_m * std::numbers::sqrt2 : cell_m);
}

}  // namespace

TravelRegions::TravelRegions(const DiscLattice& lattice, std::span<const Cell> places) : box_(lattice.box()) {
  if (box_.empty()) return;
  const auto cells = static_cast<std::size_t>(box_.width()) * static_cast<std::size_t>(box_.height());
  cost_m_.assign(cells, std::numeric_limits<float>::infinity());
  owner_.assign(cells, kNobody);
  came_from_.assign(cells, -1);
  settle(lattice, places);
  find_borders(lattice);
  std::ranges::sort(borders_, {},
                    [](const Border& border) { return std::tuple(border.length_m, border.first, border.second); });
}

std::size_t TravelRegions::index_of(Cell cell) const {
  return static_cast<std::size_t>(cell.y - box_.min.y) * static_cast<std::size_t>(box_.width()) +
         static_cast<std::size_t>(cell.x - box_.min.x);
}

Cell TravelRegions::cell_of(std::size_t index) const {
  const auto at = static_cast<int>(index);
  return {box_.min.x + at % box_.width(), box_.min.y + at / box_.width()};
}

void TravelRegions::settle(const DiscLattice& lattice, std::span<const Cell> places) {
  using Waiting = std::pair<float, std::size_t>;  // cost and cell
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> frontier;
  for (std::size_t place = 0; place < places.size(); ++place) {
    const Cell at = places[place];
    if (!lattice.fits(at)) continue;
    std::int32_t& owner = owner_[index_of(at)];
    if (owner != kNobody) {
      borders_.push_back({static_cast<std::size_t>(owner), place, 0.0, at, at});
      continue;
    }
    owner = static_cast<std::int32_t>(place);
    cost_m_[index_of(at)] = 0.0F;
    frontier.emplace(0.0F, index_of(at));
  }
  while (!frontier.empty()) {
    const auto [here_m, from_index] = frontier.top();
    frontier.pop();
    if (here_m > cost_m_[from_index]) continue;
    const Cell from = cell_of(from_index);
    for (int step = 0; step < 8; ++step) {
      if (!lattice.may_step(from, step)) continue;
      const std::size_t to = index_of(from + DiscLattice::kSteps[step]);
      const float cost_m = here_m + length_of_step_m(step, lattice.cell_m());
      if (cost_m >= cost_m_[to]) continue;
      cost_m_[to] = cost_m;
      owner_[to] = owner_[from_index];
      came_from_[to] = static_cast<std::int8_t>(7 - step);
      frontier.emplace(cost_m, to);
    }
  }
}

void TravelRegions::find_borders(const DiscLattice& lattice) {
  std::map<std::pair<std::int32_t, std::int32_t>, Border> shortest;
  for (std::size_t index = 0; index < owner_.size(); ++index) {
    if (owner_[index] == kNobody) continue;
    const Cell from = cell_of(index);
    for (int step = 4; step < 8; ++step) {
      if (!lattice.may_step(from, step)) continue;
      Cell in_first = from;
      Cell in_second = from + DiscLattice::kSteps[step];
      const std::int32_t here = owner_[index];
      const std::int32_t there = owner_[index_of(in_second)];
      if (here == there) continue;
      if (here > there) std::swap(in_first, in_second);
      const double length_m =
          double{cost_m_[index_of(in_first)]} + length_of_step_m(step, lattice.cell_m()) + cost_m_[index_of(in_second)];
      const auto [known, is_new] = shortest.try_emplace(std::minmax(here, there));
      if (!is_new && known->second.length_m <= length_m) continue;
      known->second = {static_cast<std::size_t>(std::min(here, there)), static_cast<std::size_t>(std::max(here, there)),
                       length_m, in_first, in_second};
    }
  }
  for (const auto& [pair, border] : shortest) borders_.push_back(border);
}

void TravelRegions::append_way_home(std::vector<Cell>& path, Cell cell) const {
  path.push_back(cell);
  for (std::int8_t step = came_from_[index_of(cell)]; step >= 0; step = came_from_[index_of(path.back())])
    path.push_back(path.back() + DiscLattice::kSteps[static_cast<std::uint8_t>(step)]);
}

std::vector<Cell> TravelRegions::path_across(const Border& border) const {
  std::vector<Cell> path;
  append_way_home(path, border.in_first);
  std::ranges::reverse(path);
  if (border.in_second != border.in_first) append_way_home(path, border.in_second);
  return path;
}

}  // namespace cairn
