#include "maps/geometry/near_groups.hpp"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <boost/property_map/property_map.hpp>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>

namespace cairn {
namespace {

// Two things in one square of a lattice of half the distance are always near each other.
struct Square {
  std::size_t sort = 0;
  std::int64_t y = 0;
  std::int64_t x = 0;
  auto operator<=>(const Square&) const = default;  // NOLINT(modernize-use-nullptr)
};

struct Resident {
  Square square;
  std::size_t index = 0;
  auto operator<=>(const Resident&) const = default;  // NOLINT(modernize-use-nullptr)
};

using Residents = std::span<const Resident>;

std::int64_t lattice_index(double at_m, double side_m) {
  constexpr double kFar = 1e15;
  return static_cast<std::int64_t>(std::clamp(std::floor(at_m / side_m), -kFar, kFar));
}

// Each square with the things in it.
std::vector<Residents> squares_of(const std::vector<Resident>& residents) {
  std::vector<Residents> squares;
  for (auto begin = residents.begin(); begin != residents.end();) {
    const auto end = std::find_if(begin, residents.end(), [&](const Resident& r) { return r.square != begin->square; });
    squares.emplace_back(begin, end);
    begin = end;
  }
  return squares;
}

bool any_near(std::span<const ThingAt> things, Residents a, Residents b, double within_m) {
  constexpr std::size_t kMaxCompared = 64;  // of each square: more are a crowd anyway
  for (const Resident& one : a.first(std::min(a.size(), kMaxCompared)))
    for (const Resident& other : b.first(std::min(b.size(), kMaxCompared)))
      if ((things[one.index].at_m - things[other.index].at_m).norm() <= within_m) return true;
  return false;
}

}  // namespace

std::vector<std::vector<std::size_t>> near_groups(std::span<const ThingAt> things, double within_m) {
  std::vector<Resident> residents(things.size());
  const double side_m = 0.5 * within_m;
  for (std::size_t i = 0; i < things.size(); ++i)
    residents[i] = {
        {things[i].sort, lattice_index(things[i].at_m.y(), side_m), lattice_index(things[i].at_m.x(), side_m)}, i};
  std::ranges::sort(residents);
  const std::vector<Residents> squares = squares_of(residents);
  std::vector<std::size_t> rank(things.size(), 0);
  std::vector<std::size_t> parent(things.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});  // each alone
  boost::disjoint_sets joined(boost::make_iterator_property_map(rank.begin(), boost::identity_property_map()),
                              boost::make_iterator_property_map(parent.begin(), boost::identity_property_map()));
  const auto square_of = [](Residents one) { return one.front().square; };
  for (const Residents here : squares) {
    for (const Resident& other : here.subspan(1)) joined.union_set(here.front().index, other.index);
    const Square at = here.front().square;
    for (std::int64_t up = 0; up <= 2; ++up) {
      const Square first{at.sort, at.y + up, up == 0 ? at.x + 1 : at.x - 2};
      const Square last{at.sort, at.y + up, at.x + 2};
      for (auto there = std::ranges::lower_bound(squares, first, {}, square_of);
           there != squares.end() && square_of(*there) <= last; ++there)
        if (any_near(things, here, *there, within_m)) joined.union_set(here.front().index, there->front().index);
    }
  }
  std::map<std::size_t, std::vector<std::size_t>> by_representative;
  for (std::size_t i = 0; i < things.size(); ++i) by_representative[joined.find_set(i)].push_back(i);
  std::vector<std::vector<std::size_t>> groups;
  for (auto& [representative, group] : by_representative)
    if (group.size() > 1) groups.push_back(std::move(group));
  std::ranges::sort(groups);
  return groups;
}

}  // namespace cairn
