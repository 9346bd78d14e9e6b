// The readers of what comes from outside, each as one function of a file's bytes: what the fuzzers feed, and what the
// replay test runs over the kept inputs.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace cairn::fuzz {

using Input = std::span<const std::uint8_t>;

// A reader took the input and broke a promise. What it refuses by its own error is fine; any other exception is a find.
class BrokenPromise : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

inline void promise(bool kept, const std::string& what) {
  if (!kept) throw BrokenPromise("broken promise: " + what);
}

inline std::string_view text_of(Input input) {
  return {reinterpret_cast<const char*>(input.data()), input.size()};
}

struct Reader {
  std::string_view name;  // also of its folder of inputs, tests/fuzz/corpus/NAME
  void (*read)(Input);
};

// All of them.
[[nodiscard]] std::span<const Reader> readers();
// Throws std::invalid_argument when there is none of that name.
[[nodiscard]] const Reader& reader_called(std::string_view name);

// Files of settings.
void read_yaml(Input input);  // the text, then overrides, each behind a byte 0
void read_mission(Input input);
void read_world(Input input);
void read_template(Input input);  // the text, then a picture behind a byte 0
void read_robot(Input input);
void read_experiment(Input input);

// Grids and graphs of other tools.
void read_map_server(Input input);  // the text, then the picture behind a byte 0
void read_picture(Input input);
void read_moving_ai_map(Input input);
void read_moving_ai_scen(Input input);  // by the measurements' reader: the program has none
void read_graph_list(Input input);
void read_patrolling_graph(Input input);
void read_tntp(Input input);  // the links, then the nodes behind a byte 0
void read_graphml(Input input);
void read_nav2_routes(Input input);
void read_rmf(Input input);
// What a map keeps for other tools, when it is written for them again; parts, each behind a byte 0.
void read_annotations(Input input);

// Recorded logs.
void read_carmen_log(Input input);
void read_json_log(Input input);
void read_laser_log(Input input);  // of any kind, by its content
void read_lego_log(Input input);
void read_mcap_log(Input input);
void read_player_log(Input input);
void read_table_log(Input input);

// The program's own.
void read_saved_map(Input input);
void read_damaged_map(Input input);  // what can be saved of a saved map
void read_plan_queries(Input input);
void read_place(Input input);

}  // namespace cairn::fuzz
