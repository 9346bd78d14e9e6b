// Road networks of the collection Transportation Networks for Research: NAME_net.tntp and NAME_node.tntp.
//
//   net:   <KEY> VALUE lines up to <END OF METADATA>, `~` comments, then
//          INIT_NODE TERM_NODE CAPACITY LENGTH ... ;     a directed link
//   node:  a heading, then ID X Y ;
//
// Node 17 becomes landmark L17, links become routes 1, 2, ... in their order, which cost their LENGTH. Nodes below
// <FIRST THRU NODE> get the category `zone`. Coordinates and lengths are taken as metres, whatever they are.
#pragma once

#include <string>
#include <string_view>

#include "maps/exchange/graphs/exchanged_graph.hpp"

namespace cairn {

struct TntpTexts {
  std::string_view net;
  std::string net_name;  // for errors
  std::string_view node;
  std::string node_name;
};

// Throws ExchangeError with file:line:column on lines that are none of the above, ids that are there twice, links to
// nodes that are not there, negative lengths, and a <NUMBER OF LINKS> that is not theirs.
[[nodiscard]] ImportedGraph parse_tntp(const TntpTexts& texts);

}  // namespace cairn
