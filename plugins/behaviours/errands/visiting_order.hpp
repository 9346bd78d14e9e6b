// In which order to visit places so that the whole route is short: an open tour, from a start through all of them.
#pragma once

#include <cstddef>
#include <vector>

namespace cairn::behaviours {

inline constexpr std::size_t kMaxExactPlaces = 11;

// cost[i][j]: from i to j, 0 is the start, the places are 1 to n; finite, 0 on the diagonal. The order of all places,
// each once. The best one up to kMaxExactPlaces of them (Held, Karp: A dynamic programming approach to sequencing
// problems, 1962; O(n^2 2^n)); beyond that by cheapest insertion and 2-opt (O(n^3)), which is often, not always, best.
// Equal costs: the lower number first.
[[nodiscard]] std::vector<std::size_t> shortest_order(const std::vector<std::vector<double>>& cost);
// Length of the route from the start through all places of an order.
[[nodiscard]] double cost_of(const std::vector<std::size_t>& order, const std::vector<std::vector<double>>& cost);

}  // namespace cairn::behaviours
