// How far two divisions of the same things agree.
#pragma once

#include <vector>

namespace cairn {

// Labels of the same things, in the same order; at least one.
// 2 I(a; b) / (H(a) + H(b)): 1 when they are the same, 0 when one says nothing of the other. A division into single
// things scores high for nothing.
[[nodiscard]] double normalised_mutual_information(const std::vector<int>& a, const std::vector<int>& b);
// Hubert and Arabie's: 1 when they are the same, 0 on average for labels dealt at random, single things included.
[[nodiscard]] double adjusted_rand_index(const std::vector<int>& a, const std::vector<int>& b);

}  // namespace cairn
