// Names that steer a terminal, in every file and answer whose text a command prints.
#include <gmock/gmock.h>
#include <sqlite3.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "maps/base/printable.hpp"
#include "maps/store/map_store.hpp"
#include "tests/scenario/hostile/hostile_files.hpp"

namespace cairn::testing_program {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Clear the screen, set the title, an 8-bit control sequence, a bell, and text that runs backwards.
const std::string kHostile =
    "x\x1B[2J\x1B]0;owned\x07\xC2\x9B"
    "31m\x7F\xE2\x80\xAEtxt";
const std::string kInJson = R"(x\u001b[2J\u001b]0;owned\u0007\u009b31m\u007f\u202etxt)";
const std::string kInYaml = R"("x\x1b[2J\x1b]0;owned\a\x9b31m\x7f\u202etxt")";

class TerminalText : public HostileFiles {
 protected:
  TerminalText() : HostileFiles("terminal_text") {}

  // Runs it, with and without --json, and looks at all that it prints.
  static Finished printed(const std::vector<std::string>& arguments) {
    std::vector<std::string> with_json = arguments;
    with_json.emplace_back("--json");
    Finished finished;
    for (const std::vector<std::string>& all : {with_json, arguments}) {
      finished = run_cairn(all);
      for (const std::string& text : {finished.out, finished.err}) {
        const std::size_t found = first_unprintable(text, "\n\t");
        EXPECT_EQ(found, std::string::npos) << all.at(0) << " " << all.at(1) << ": " << printable(text, "\n");
      }
    }
    return finished;
  }
  static void refused(const std::vector<std::string>& arguments, const std::string& place) {
    const Finished finished = printed(arguments);
    EXPECT_EQ(finished.exit_status, 2) << printable(finished.err, "\n");
    EXPECT_THAT(finished.err, HasSubstr(place));
  }

  [[nodiscard]] std::string map_after(const std::string& sql) const {
    SavedMap map;
    map.grid.include({{0, 0}, {40, 40}});
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x) map.grid.set_log_odds({x, y}, -900);
    Landmark landmark;
    landmark.category = "square";
    landmark.name = "dock";
    landmark.T_map_landmark = {1.0, 1.0, 0.0};
    map.graph.add(landmark);
    landmark.name = "gate";
    landmark.T_map_landmark = {1.5, 1.0, 0.0};
    map.graph.add(landmark);
    map.graph.add_route({0, 1, 2, 0.5, {}, false, false, 0});
    map.properties["mission"] = "office";
    save_map(file("a.cairn"), map);
    sqlite3* database = nullptr;
    EXPECT_EQ(sqlite3_open(file("a.cairn").c_str(), &database), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
    sqlite3_close(database);
    return file("a.cairn");
  }
};

TEST_F(TerminalText, OfASavedMapIsRefusedWithItsTableAndColumn) {
  for (const char* column : {"name", "category"}) {
    const std::string map =
        map_after("UPDATE landmarks SET " + std::string(column) + " = '" + kHostile + "' WHERE id = 1");
    const Finished check = printed({"map", "check", map});
    EXPECT_EQ(check.exit_status, 2);
    EXPECT_THAT(check.err, HasSubstr("table landmarks: row 1: column " + std::string(column) +
                                     " holds the control character \\x1b"));
    printed({"map", "repair", map, "-o", file("repaired.cairn")});
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"map", "info", map},
             {"map", "render", map, "-o", file("a.png")},
             {"map", "lint", map},
             {"map", "name", map, "dock", "hall"},
             {"map", "close", map, "R1"},
             {"map", "diff", map, map},
             {"map", "merge", map, map, "--transform", "0,0,0", "-o", file("b.cairn")},
             {"map", "crop", map, "--box", "0,0,1,1", "-o", file("b.cairn")},
             {"map", "export", map, "-o", file("b.geojson")},
             {"plan", map, "--from", "L1", "--to", "L2"},
             {"template", "capture", map, "--at", "L1", "--category", "x", "-o", file("x.yaml")},
             {"run", mission("m.yaml", "[wait: 1]"), "--out", file("out"), "--resume", map}}) {
      EXPECT_NE(printed(arguments).exit_status, 0) << arguments.at(1);
    }
  }
  for (const char* sql : {"UPDATE meta SET value = HOSTILE", "UPDATE meta SET key = HOSTILE",
                          "UPDATE next_ids SET kind = HOSTILE WHERE kind = 'route'",
                          "UPDATE checksums SET table_name = HOSTILE WHERE table_name = 'meta'"}) {
    std::string with_name = sql;
    with_name.replace(with_name.find("HOSTILE"), 7, "'" + kHostile + "'");
    EXPECT_EQ(printed({"map", "check", map_after(with_name)}).exit_status, 2) << sql;
  }
}

TEST_F(TerminalText, OfAGraphFileIsRefusedWithItsPlace) {
  const std::string geojson = R"({"type": "FeatureCollection", "features": [)"
                              "\n"
                              R"({"type": "Feature", "properties": {"id": 1, "name": ")" +
                              kInJson + R"("}, "geometry": {"type": "Point", "coordinates": [1, 2]}}]})";
  refused({"map", "import", written("a.geojson", geojson), "-o", file("b.cairn")}, "a.geojson:2:");
  const std::string graphml =
      "<graphml><key id=\"n\" for=\"node\" attr.name=\"name\" attr.type=\"string\"/>\n"
      "<graph edgedefault=\"directed\">\n<node id=\"1\"><data key=\"n\">x&#27;[2J</data></node></graph></graphml>";
  refused({"map", "import", written("a.graphml", graphml), "-o", file("b.cairn")}, "a.graphml:3:");
  refused({"map", "import", written("a.graph", "node 1 0 0 " + kHostile + "\n"), "-o", file("b.cairn")},
          "a.graph:1:13:");
  const std::string rmf =
      "building_name: b\nlevels:\n  L1:\n    vertices:\n      - [0, 0, {name: " + kInYaml + "}]\n    lanes: []\n";
  refused({"map", "import", written("nav.yaml", rmf), "-o", file("b.cairn")}, "nav.yaml:5:");
  refused({"map", "import", written("m.yaml", "image: " + kInYaml + "\nresolution: 0.05\norigin: [0, 0, 0]\n"), "-o",
           file("b.cairn")},
          "m.yaml:1:");
  refused({"map", "import", written("m.yaml", "image: " + kHostile + "\n"), "-o", file("b.cairn")}, "m.yaml:1:9:");
}

TEST_F(TerminalText, OfAMissionAndWhatItNamesIsRefusedWithItsPlace) {
  const auto run = [&](const std::string& mission_file) {
    refused({"mission", "check", mission_file}, "hostile.yaml:");
    refused({"mission", "show", mission_file}, "hostile.yaml:");
    refused({"run", mission_file, "--out", file("out")}, "hostile.yaml:");
  };
  for (const std::string& name : {kInYaml, kHostile}) {
    run(mission("hostile.yaml", "[{wait: 1, name: " + name + "}]"));
    run(mission("hostile.yaml", "[{" + name + ": 1}]"));
    run(mission("hostile.yaml", "[wait: 1]", "record: " + name + "\n"));
    run(mission("hostile.yaml", "[wait: 1]", name + ": 1\n"));
    run(mission("hostile.yaml", "[wait: 1]", "planner: {plugin: " + name + "}\n"));
    run(mission("hostile.yaml", "[wait: 1]", "detector: {plugin: template_matcher, templates: " + name + "}\n"));
  }
  refused({"run", mission("m.yaml", "[wait: 1]"), "--out", file("out"), "--set", "map." + kHostile + "=1"}, "--set");
  refused({"run", mission("m.yaml", "[wait: 1]"), "--out", file("out"), "--set", "mission=" + kInYaml}, "--set");
  const std::string templates = file("templates");
  static_cast<void>(written("templates/hostile.yaml", "category: " + kInYaml + "\ncircle: {diameter_m: 0.5}\n"));
  refused({"template", "list", templates}, "hostile.yaml:1:");
  refused({"experiment", written("e.yaml", "experiment: " + kInYaml + "\n"), "--out", file("e")}, "e.yaml:1:");
}

TEST_F(TerminalText, OfFilesNamesIsPrintedEscaped) {
  const std::string name = kHostile.substr(0, 40);
  refused({"run", file(name)}, "\\x1b[2J");
  refused({"map", "info", file(name)}, "\\x1b[2J");
  refused({"map", "export", file(name), "-o", file("a.geojson")}, "\\x1b[2J");
  refused({"plan", file(name), "--from", "0,0", "--to", "1,1"}, "\\x1b[2J");
  refused({"plugins", "info", name}, "\\x1b[2J");
  printed({"plugins", "check", file(name)});
  refused({kHostile, "x"}, "\\x1b[2J");
  printed({"map", "--" + kHostile});
  static_cast<void>(written("modules/" + name + ".so", "no module"));
  const Finished modules = printed({"plugins", "--plugins", file("modules")});
  EXPECT_THAT(modules.out + modules.err, HasSubstr("\\x1b[2J"));
  static_cast<void>(written("t/" + name + ".yaml", "category: a b\ncircle: {diameter_m: 0.5}\n"));
  refused({"template", "list", file("t")}, "\\x1b[2J");
}

TEST_F(TerminalText, OfQuestionsIsPrintedEscaped) {
  const std::string map = map_after("");
  const std::string queries = written(
      "q.jsonl", R"({"id": ")" + kInJson + R"(", "from": ")" + kInJson + R"(", "to": "L1"})" + "\n" + kHostile + "\n");
  printed({"plan", map, "--queries", queries});
  printed({"plan", map, "--from", kHostile, "--to", "nearest " + kHostile});
}

TEST_F(TerminalText, OfALogIsPrintedEscaped) {
  const std::string log = written("a.log", kHostile + " 1 2 3\nODOM 0 0 0 0 0 0 0 x 0\nSONAR 1 1 " + kHostile + "\n");
  const Finished run =
      printed({"run", mission("m.yaml", "[wait: 1]", "", "{plugin: carmen_log, file: a.log}"), "--out", file("out")});
  EXPECT_EQ(run.exit_status, 2);
  EXPECT_THAT(run.err, HasSubstr("a.log:3:"));
  printed({"run", mission("m.yaml", "[wait: 1]", "", "{plugin: carmen_log, file: a.log, on_bad_line: skip}"), "--out",
           file("out")});
}

TEST_F(TerminalText, OfAReportIsPrintedEscapedAndInOneLine) {
  fs::create_directories(folder_ / "out");
  static_cast<void>(written("out/report.json", R"({"mission": ")" + kInJson +
                                                   R"(\nmission all is well", "outcome": ")" + kInJson +
                                                   R"(", "reason": "a\rb", "map": "c"})"));
  const Finished status = printed({"mission", "status", file("out")});
  EXPECT_EQ(status.exit_status, 0);
  EXPECT_THAT(status.out, HasSubstr("\\x1b[2J"));
  EXPECT_THAT(status.out, testing::Not(HasSubstr("\nmission all is well")));
}

TEST_F(TerminalText, OfWhateverListensOnTheControlSocketIsPrintedEscaped) {
  fs::create_directories(folder_ / "out");
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  (folder_ / "out/control.sock").string().copy(name.sun_path, sizeof name.sun_path - 1);
  const int listening = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  ASSERT_EQ(::bind(listening, reinterpret_cast<const sockaddr*>(&name), sizeof name), 0);
  ASSERT_EQ(::listen(listening, 8), 0);
  const std::string good = R"({"ok": true, "mission": ")" + kInJson + R"(", "state": ")" + kInJson +
                           R"(", "step_name": ")" + kInJson + R"(", "steps": 2, "doing": ")" + kInJson +
                           R"(", "eta_s": 1, "eta_at_most_s": 2, "eta_without": [")" + kInJson + R"("]})";
  const std::string bad = R"({"ok": false, "error": ")" + kInJson + R"("})";
  for (const std::string& answer : {good, bad, kHostile}) {
    std::thread server([&] {
      for (int i = 0; i < 4; ++i) {  // two commands, each with and without --json
        const int caller = ::accept(listening, nullptr, nullptr);
        const std::string line = answer + "\n";
        static_cast<void>(::send(caller, line.data(), line.size(), MSG_NOSIGNAL));
        ::close(caller);
      }
    });
    printed({"mission", "status", file("out")});
    printed({"mission", "pause", file("out")});
    server.join();
  }
  ::close(listening);
}

}  // namespace
}  // namespace cairn::testing_program
