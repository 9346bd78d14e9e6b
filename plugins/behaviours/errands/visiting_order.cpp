#include "plugins/behaviours/errands/visiting_order.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace cairn::behaviours {
namespace {

using Costs = std::vector<std::vector<double>>;

constexpr double kBetter = 1e-9;

// best[set][last]: of the route from the start through the places of the set, ending at one of them (both from 0).
std::vector<std::size_t> best_order(const Costs& cost) {
  const std::size_t n = cost.size() - 1;
  const std::size_t sets = std::size_t{1} << n;
  Costs best(sets, std::vector<double>(n, std::numeric_limits<double>::infinity()));
  std::vector<std::vector<std::size_t>> before(sets, std::vector<std::size_t>(n, n));
  for (std::size_t i = 0; i < n; ++i) best[std::size_t{1} << i][i] = cost[0][i + 1];
  for (std::size_t set = 1; set < sets; ++set) {
    for (std::size_t last = 0; last < n; ++last) {
      if ((set >> last & 1U) == 0) continue;
      for (std::size_t next = 0; next < n; ++next) {
        if ((set >> next & 1U) != 0) continue;
        const std::size_t larger = set | std::size_t{1} << next;
        const double whole = best[set][last] + cost[last + 1][next + 1];
        if (whole >= best[larger][next] - kBetter) continue;
        best[larger][next] = whole;
        before[larger][next] = last;
      }
    }
  }
  std::size_t set = sets - 1;
  std::size_t last = static_cast<std::size_t>(std::ranges::min_element(best[set]) - best[set].begin());
  std::vector<std::size_t> order;
  while (set != 0) {
    order.push_back(last + 1);
    const std::size_t previous = before[set][last];
    set &= ~(std::size_t{1} << last);
    last = previous;
  }
  std::ranges::reverse(order);
  return order;
}

std::vector<std::size_t> by_insertion(const Costs& cost) {
  std::vector<std::size_t> order;
  for (std::size_t place = 1; place < cost.size(); ++place) {
    double least = std::numeric_limits<double>::infinity();
    std::size_t where = 0;
    for (std::size_t at = 0; at <= order.size(); ++at) {
      const std::size_t from = at == 0 ? 0 : order[at - 1];
      double more = cost[from][place];
      if (at < order.size()) more += cost[place][order[at]] - cost[from][order[at]];
      if (more >= least - kBetter) continue;
      least = more;
      where = at;
    }
    order.insert(order.begin() + static_cast<std::ptrdiff_t>(where), place);
  }
  return order;
}

// Turns stretches round as long as that makes the route shorter.
void improve(std::vector<std::size_t>& order, const Costs& cost) {
  for (bool improved = true; improved;) {
    improved = false;
    for (std::size_t i = 0; i + 1 < order.size(); ++i) {
      for (std::size_t j = i + 1; j < order.size(); ++j) {
        const double before = cost_of(order, cost);
        const auto begin = order.begin() + static_cast<std::ptrdiff_t>(i);
        const auto end = order.begin() + static_cast<std::ptrdiff_t>(j) + 1;
        std::reverse(begin, end);
        if (cost_of(order, cost) < before - kBetter)
          improved = true;
        else
          std::reverse(begin, end);
      }
    }
  }
}

}  // namespace

double cost_of(const std::vector<std::size_t>& order, const std::vector<std::vector<double>>& cost) {
  double sum = 0.0;
  std::size_t from = 0;
  for (const std::size_t place : order) {
    sum += cost[from][place];
    from = place;
  }
  return sum;
}

std::vector<std::size_t> shortest_order(const std::vector<std::vector<double>>& cost) {
  if (cost.size() < 2) return {};
  if (cost.size() - 1 <= kMaxExactPlaces) return best_order(cost);
  std::vector<std::size_t> order = by_insertion(cost);
  improve(order, cost);
  return order;
}

}  // namespace cairn::behaviours
