#include "tests/bench/clusters/agreement.hpp"

#include <cmath>
#include <map>
#include <utility>

namespace cairn {
namespace {

struct Counts {
  std::map<int, double> a, b;
  std::map<std::pair<int, int>, double> both;
  double all = 0.0;

  Counts(const std::vector<int>& labels_a, const std::vector<int>& labels_b)
      : all(static_cast<double>(labels_a.size())) {
    for (std::size_t i = 0; i < labels_a.size(); ++i) {
      ++a[labels_a[i]];
      ++b[labels_b[i]];
      ++both[{labels_a[i], labels_b[i]}];
    }
  }
};

template <class Parts>
double entropy(const Parts& parts, double all) {
  double sum = 0.0;
  for (const auto& [label, count] : parts) sum -= count / all * std::log(count / all);
  return sum;
}

template <class Parts>
double pairs_in(const Parts& parts) {
  double sum = 0.0;
  for (const auto& [label, count] : parts) sum += count * (count - 1.0) / 2.0;
  return sum;
}

}  // namespace

double normalised_mutual_information(const std::vector<int>& a, const std::vector<int>& b) {
  const Counts counts(a, b);
  const double of_a = entropy(counts.a, counts.all);
  const double of_b = entropy(counts.b, counts.all);
  return of_a + of_b > 0.0 ? 2.0 * (of_a + of_b - entropy(counts.both, counts.all)) / (of_a + of_b) : 1.0;
}

double adjusted_rand_index(const std::vector<int>& a, const std::vector<int>& b) {
  const Counts counts(a, b);
  const double in_a = pairs_in(counts.a);
  const double in_b = pairs_in(counts.b);
  const double expected = in_a * in_b / (counts.all * (counts.all - 1.0) / 2.0);
  const double most = (in_a + in_b) / 2.0;
  return most == expected ? 1.0 : (pairs_in(counts.both) - expected) / (most - expected);
}

}  // namespace cairn
