#include "maps/base/deflate.hpp"
#include "maps/store/schema.hpp"
#include "maps/store/tables/codec.hpp"
#include "maps/store/tables/reading.hpp"
#include "maps/store/tables/tables.hpp"

namespace cairn::store {
namespace {

constexpr int kMaxCellFromAnchor = KeptSubmap::kMaxSide;

void write_nodes(Database& database, const KeptSubmaps& submaps) {
  Statement insert(database, "INSERT INTO submap_nodes VALUES (?, ?, ?, ?, ?)");
  for (const KeptNode& node : submaps.nodes) insert.bind(node.number).bind(node.stamp_s).bind(node.T_map_node).run();
}

void write_edges(Database& database, const KeptSubmaps& submaps) {
  Statement insert(database, "INSERT INTO submap_edges VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  std::int64_t number = 0;
  for (const KeptEdge& edge : submaps.edges) {
    insert.bind(++number).bind(edge.from).bind(edge.to).bind(edge.T_from_to);
    for (int row = 0; row < 3; ++row)
      for (int column = row; column < 3; ++column) insert.bind(edge.information(row, column));
    insert.bind(edge.is_closure).bind(edge.is_believed).run();
  }
}

bool has_node(const KeptSubmaps& submaps, std::int64_t number) {
  return std::ranges::binary_search(submaps.nodes, number, {}, &KeptNode::number);
}

KeptSubmap submap_in(const Statement& row) {
  KeptSubmap submap;
  submap.anchor = row.integer_within(0, 0, KeptSubmaps::kMaxNumber);
  submap.finished = row.integer_within(1, 0, 1) != 0;
  submap.cell_m = row.real(2);
  if (!(submap.cell_m > 0.0) || submap.cell_m > KeptSubmap::kMaxCell_m) throw StoreError("cell_m must be in (0, 10]");
  submap.min_x = static_cast<int>(row.integer_within(3, -kMaxCellFromAnchor, kMaxCellFromAnchor));
  submap.min_y = static_cast<int>(row.integer_within(4, -kMaxCellFromAnchor, kMaxCellFromAnchor));
  submap.width = static_cast<int>(row.integer_within(5, 0, KeptSubmap::kMaxSide));
  submap.height = static_cast<int>(row.integer_within(6, 0, KeptSubmap::kMaxSide));
  const std::string packed = row.blob(7);
  if (crc32_of(packed) != row.integer(8))
    throw StoreError(numbered("submap", submap.anchor) + " is damaged: its bytes do not match its checksum");
  const auto cells = static_cast<std::size_t>(submap.width) * static_cast<std::size_t>(submap.height);
  const std::string raw = unpacked_bytes(packed, cells);
  submap.echoes.assign(raw.begin(), raw.end());
  return submap;
}

KeptEdge edge_in(const Statement& row) {
  KeptEdge edge;
  edge.from = row.integer_within(1, 0, KeptSubmaps::kMaxNumber);
  edge.to = row.integer_within(2, 0, KeptSubmaps::kMaxNumber);
  edge.T_from_to = row.pose(3);
  int at = 6;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) edge.information(i, j) = edge.information(j, i) = row.real(at++);
  edge.is_closure = row.integer_within(12, 0, 1) != 0;
  edge.is_believed = row.integer_within(13, 0, 1) != 0;
  return edge;
}

void read_nodes(Reading& reading, KeptSubmaps& submaps) {
  reading.rows("submap_nodes", "SELECT * FROM submap_nodes ORDER BY number", [&](Statement& row) {
    if (submaps.nodes.size() >= KeptSubmaps::kMaxNodes) throw StoreError("there are too many nodes");
    submaps.nodes.push_back({row.integer_within(0, 0, KeptSubmaps::kMaxNumber), row.real(1), row.pose(2)});
  });
}

void read_edges(Reading& reading, KeptSubmaps& submaps) {
  reading.rows("submap_edges", "SELECT * FROM submap_edges ORDER BY number", [&](Statement& row) {
    const KeptEdge edge = edge_in(row);
    if (!has_node(submaps, edge.from) || !has_node(submaps, edge.to)) throw StoreError("a node of the edge is missing");
    if (submaps.edges.size() >= KeptSubmaps::kMaxEdges) throw StoreError("there are too many edges");
    submaps.edges.push_back(edge);
  });
}

}  // namespace

void write_submaps(Database& database, const KeptSubmaps& submaps) {
  write_nodes(database, submaps);
  Statement insert(database, "INSERT INTO submaps VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)");
  for (const KeptSubmap& submap : submaps.submaps) {
    const std::string packed = deflated(std::string(submap.echoes.begin(), submap.echoes.end()));
    insert.bind(submap.anchor).bind(submap.finished).bind(submap.cell_m);
    insert.bind(submap.min_x).bind(submap.min_y).bind(submap.width).bind(submap.height);
    insert.bind_blob(packed).bind(crc32_of(packed)).run();
  }
  write_edges(database, submaps);
}

void read_submaps(Reading& reading, KeptSubmaps& submaps) {
  Statement table(reading.database, "SELECT 1 FROM sqlite_schema WHERE type = 'table' AND name = 'submap_nodes'");
  if (!table.step()) return;  // of version 1
  read_nodes(reading, submaps);
  reading.rows("submaps", "SELECT * FROM submaps ORDER BY anchor", [&](Statement& row) {
    if (submaps.submaps.size() >= KeptSubmaps::kMax) throw StoreError("there are too many submaps");
    KeptSubmap submap = submap_in(row);
    if (!has_node(submaps, submap.anchor)) throw StoreError("its anchor is missing among the nodes");
    submaps.submaps.push_back(std::move(submap));
  });
  read_edges(reading, submaps);
}

}  // namespace cairn::store
