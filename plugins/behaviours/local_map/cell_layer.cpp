#include "plugins/behaviours/local_map/cell_layer.hpp"

namespace cairn::behaviours {

std::vector<CellGroup> grouped(const std::vector<Cell>& cells, int reach) {
  CellBox box;
  for (const Cell c : cells) box = united(box, {c, c + Cell{1, 1}});
  CellLayer<char> waiting(box, 0, 0);
  for (const Cell c : cells) waiting[c] = 1;

  std::vector<CellGroup> groups;
  for (const Cell first : cells) {
    if (!waiting.at(first)) continue;
    CellGroup group{first};
    waiting[first] = 0;
    for (std::size_t i = 0; i < group.size(); ++i) {
      for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
          const Cell next = group[i] + Cell{dx, dy};
          if (!waiting.at(next)) continue;
          waiting[next] = 0;
          group.push_back(next);
        }
      }
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace cairn::behaviours
