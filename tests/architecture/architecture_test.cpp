// The house rules as a test: arrows between rooms, who may touch which library, the length of files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Include {
  std::string file;    // relative to the project
  std::string header;  // as written
  bool angled = false;
};

struct Source {
  std::string file;
  std::vector<std::string> lines;
};

const std::vector<Source>& sources() {
  static const std::vector<Source> all = [] {
    std::vector<Source> found;
    for (const char* room : {"maps", "framework", "plugins", "planners", "python", "tests"})
      for (const auto& entry : fs::recursive_directory_iterator(fs::path(CAIRN_SOURCE_DIR) / room)) {
        const auto extension = entry.path().extension();
        if (extension != ".hpp" && extension != ".cpp") continue;
        Source source{fs::relative(entry.path(), CAIRN_SOURCE_DIR).generic_string(), {}};
        std::ifstream in(entry.path());
        for (std::string line; std::getline(in, line);) source.lines.push_back(line);
        found.push_back(std::move(source));
      }
    return found;
  }();
  return all;
}

std::vector<Include> includes() {
  static const std::regex pattern(R"re(^\s*#\s*include\s*(["<])([^">]+)[">])re");
  std::vector<Include> found;
  for (const Source& source : sources())
    for (const std::string& line : source.lines) {
      std::smatch match;
      if (std::regex_search(line, match, pattern)) found.push_back({source.file, match[2], match[1] == "<"});
    }
  return found;
}

std::string room_of(const std::string& path) {
  return path.substr(0, path.find('/'));
}

// "plugins/muriel", "plugins/baselines/bayes_map".
std::string module_of(const std::string& path) {
  std::size_t end = path.find('/', path.find('/') + 1);
  const bool is_in_group = path.starts_with("plugins/baselines/") || path.find("/common/") != std::string::npos;
  if (is_in_group) end = path.find('/', end + 1);
  return path.substr(0, end);
}

bool starts_with_any(const std::string& text, const std::vector<std::string>& beginnings) {
  for (const std::string& beginning : beginnings)
    if (text.starts_with(beginning)) return true;
  return false;
}

// What the Python package and modules in Python have in common.
bool is_shared_with_python(const Include& include) {
  return include.file.starts_with("plugins/python_module/") && include.header.starts_with("python/shared/");
}

TEST(Architecture, ArrowsBetweenRoomsPointDownOnly) {
  const std::map<std::string, std::vector<std::string>> allowed = {
      {"maps", {"maps"}},
      {"framework", {"framework", "maps"}},
      {"plugins", {"framework", "maps", "plugins"}},
      {"planners", {"framework", "maps", "planners"}},
      {"python", {"framework", "maps", "python"}},
  };
  for (const Include& include : includes()) {
    const std::string from = room_of(include.file);
    const std::string to = room_of(include.header);
    if (!allowed.contains(from) || !allowed.contains(to) || is_shared_with_python(include)) continue;
    EXPECT_THAT(allowed.at(from), testing::Contains(to)) << include.file << " includes " << include.header;
  }
}

// Lowest first: each room uses those before it only.
const std::vector<std::string> kMapsRooms = {"base",           "geometry",  "pose_graph", "grid",      "submaps",
                                             "relocalisation", "landmarks", "clustering", "hierarchy", "exchange",
                                             "store",          "edit",      "pictures"};
const std::vector<std::string> kFrameworkRooms = {"config",    "contracts",      "files",       "live",     "modules",
                                                  "templates", "behaviour_tree", "landmarks",   "planning", "safety",
                                                  "mission",   "reporting",      "experiments", "program"};

const std::vector<std::string> kBehaviourRooms = {"places",  "local_map", "lookouts", "following",
                                                  "driving", "exploring", "docking",  "errands"};

// The room inside `outer` that a path is in, as its rank; rooms.size() when it is none.
std::size_t rank_in(const std::string& outer, const std::vector<std::string>& rooms, const std::string& path) {
  if (!path.starts_with(outer + "/")) return rooms.size();
  const std::string room = path.substr(outer.size() + 1, path.find('/', outer.size() + 1) - outer.size() - 1);
  return static_cast<std::size_t>(std::find(rooms.begin(), rooms.end(), room) - rooms.begin());
}

TEST(Architecture, ArrowsInsideMapsTheFrameworkAndTheBehavioursPointDownOnly) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> outers = {
      {"maps", kMapsRooms}, {"framework", kFrameworkRooms}, {"plugins/behaviours", kBehaviourRooms}};
  for (const auto& [outer, rooms] : outers)
    for (const Source& source : sources()) {
      if (!source.file.starts_with(outer + "/") || source.file == outer + "/module.cpp") continue;
      EXPECT_LT(rank_in(outer, rooms, source.file), rooms.size()) << source.file << " is in no known room";
    }
  for (const auto& [outer, rooms] : outers)
    for (const Include& include : includes()) {
      const std::size_t from = rank_in(outer, rooms, include.file);
      const std::size_t to = rank_in(outer, rooms, include.header);
      if (from == rooms.size() || !include.header.starts_with(outer + "/")) continue;
      EXPECT_LE(to, from) << include.file << " includes " << include.header;
    }
}

TEST(Architecture, SafetyCanBeAuditedAlone) {
  for (const Include& include : includes())
    if (include.file.starts_with("framework/safety/") && include.header.find('/') != std::string::npos) {
      EXPECT_TRUE(starts_with_any(include.header, {"framework/safety/", "framework/config/", "framework/contracts/",
                                                   "framework/modules/", "maps/geometry/"}))
          << include.file << " includes " << include.header;
    }
}

TEST(Architecture, OnlyTheProgramAndThePythonPackageKnowTheLaboratory) {
  for (const Include& include : includes())
    if (include.header.starts_with("framework/experiments/")) {
      EXPECT_TRUE(starts_with_any(include.file, {"framework/experiments/", "framework/program/", "python/", "tests/"}))
          << include.file << " includes " << include.header;
    }
}

TEST(Architecture, ModulesKnowContractsFilesAndMapsButNeverEachOtherNorTheHost) {
  for (const Include& include : includes()) {
    const std::string room = room_of(include.file);
    if (room != "plugins" && room != "planners") continue;
    const std::string target = room_of(include.header);
    if (target == "framework") {
      EXPECT_TRUE(starts_with_any(include.header,
                                  {"framework/contracts/", "framework/config/", "framework/files/", "framework/live/"}))
          << include.file << " includes " << include.header;
    }
    if (target == "plugins" || target == "planners") {
      EXPECT_TRUE(module_of(include.header) == module_of(include.file) || include.header.starts_with(room + "/common/"))
          << include.file << " includes " << include.header;
    }
  }
}

// So the author of one kind compiles the contract of that kind only.
TEST(Architecture, WhatAllKindsOfModulesShareIncludesNoContract) {
  const std::vector<std::string> shared = {"framework/contracts/registrar.hpp",
                                           "framework/contracts/module_context.hpp",
                                           "framework/contracts/plugin_kind.hpp"};
  for (const Include& include : includes()) {
    if (!starts_with_any(include.file, shared) || !include.header.starts_with("framework/contracts/")) continue;
    EXPECT_TRUE(starts_with_any(include.header, shared)) << include.file << " includes " << include.header;
  }
}

constexpr const char* kTruthHeader = "framework/contracts/ground_truth.hpp";

// Files of the project that a file includes, and those that they include.
std::set<std::string> reachable_from(const std::string& file) {
  static const std::multimap<std::string, std::string> direct = [] {
    std::multimap<std::string, std::string> found;
    for (const Include& include : includes())
      if (!include.angled) found.emplace(include.file, include.header);
    return found;
  }();
  std::set<std::string> reached;
  std::vector<std::string> open{file};
  while (!open.empty()) {
    const std::string here = open.back();
    open.pop_back();
    const auto [begin, end] = direct.equal_range(here);
    for (auto at = begin; at != end; ++at)
      if (reached.insert(at->second).second) open.push_back(at->second);
  }
  return reached;
}

TEST(Architecture, NothingThatALocalizerMapperDetectorPlannerOrBehaviourGetsMentionsTheTruth) {
  static const std::regex truth(R"((ground.?|_|\b)truth|true_T_|\bContact\b)", std::regex::icase);
  for (const char* kind : {"localizer", "loop_closer", "mapper", "detector", "marker_detector", "planner",
                           "path_planner", "route_planner", "controller", "behaviour", "world_view"}) {
    std::set<std::string> headers = reachable_from(std::string("framework/contracts/") + kind + ".hpp");
    headers.insert(std::string("framework/contracts/") + kind + ".hpp");
    EXPECT_THAT(headers, testing::Not(testing::Contains(kTruthHeader)));
    for (const Source& source : sources()) {
      if (!headers.contains(source.file) || !source.file.starts_with("framework/")) continue;
      for (const std::string& line : source.lines) {
        EXPECT_FALSE(std::regex_search(line, truth)) << source.file << " (" << kind << "): " << line;
      }
    }
  }
}

TEST(Architecture, OnlyModulesThatAreSensorsReachTheTruth) {
  std::set<std::string> sensors{"plugins/common/logs"};
  for (const Source& source : sources())
    for (const std::string& line : source.lines)
      if (source.file.starts_with("plugins/") && line.find("add<cairn::Sensor") != std::string::npos)
        sensors.insert(module_of(source.file));
  EXPECT_THAT(sensors, testing::Contains("plugins/simulated_robot"));
  for (const Source& source : sources()) {
    const std::string room = room_of(source.file);
    if ((room != "plugins" && room != "planners") || sensors.contains(module_of(source.file))) continue;
    EXPECT_THAT(reachable_from(source.file), testing::Not(testing::Contains(kTruthHeader))) << source.file;
  }
}

TEST(Architecture, ThePythonPackageIsMadeOfTheLibrariesNotOfTheProgram) {
  for (const Include& include : includes())
    if (include.file.starts_with("python/")) {
      EXPECT_FALSE(include.header.starts_with("framework/program/")) << include.file << " includes " << include.header;
    }
}

TEST(Architecture, WhatThePackageSharesWithModulesKnowsMapsOnly) {
  for (const Include& include : includes())
    if (include.file.starts_with("python/shared/") && !include.angled) {
      EXPECT_TRUE(starts_with_any(include.header, {"maps/", "python/shared/"}))
          << include.file << " includes " << include.header;
    }
}

TEST(Architecture, TheProgramLinksNoModule) {
  for (const Include& include : includes())
    if (include.file.starts_with("framework/")) {
      EXPECT_FALSE(starts_with_any(include.header, {"plugins/", "planners/"}))
          << include.file << " includes " << include.header;
    }
}

TEST(Architecture, EachLibraryIsTouchedOnlyWhereItBelongs) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> owners = {
      {"ompl/", {"planners/ompl/"}},
      {"boost/graph/",
       {"maps/landmarks/graph_parts.cpp", "maps/clustering/cluster_quality.cpp",
        "planners/common/any_angle/cell_mesh.cpp", "planners/landmark_search/"}},
      {"opencv2/",
       {"maps/grid/", "maps/landmarks/", "maps/exchange/grids/", "maps/pictures/",
        "plugins/baselines/opencv_detectors/", "plugins/common/pictures/", "plugins/simulated_robot/camera/",
        "plugins/template_matcher/"}},
      {"apriltag/",
       {"plugins/april_tags/tag_finder.cpp", "plugins/common/camera/tag_codes.cpp", "plugins/simulated_robot/camera/"}},
      {"xxhash.h", {"maps/base/fingerprint.cpp"}},
      {"metis.h", {"maps/clustering/grouping.cpp"}},
      {"boost/dll/", {"framework/modules/plugin_loader.cpp"}},
      {"boost/process/", {"maps/pictures/drawing/chart.cpp"}},
      {"boost/asio/", {"framework/program/view/", "plugins/rosbridge_robot/web_socket.cpp"}},
      {"boost/beast/", {"framework/program/view/", "plugins/rosbridge_robot/web_socket.cpp"}},
      {"gelf.h", {"framework/modules/plugin_loader.cpp"}},
      {"hwy/", {"plugins/muriel/beam_kernels.cpp", "plugins/template_matcher/match_kernels.cpp"}},
      {"yaml-cpp/", {"framework/config/"}},
      {"sqlite3.h", {"maps/store/"}},
      {"CLI/", {"framework/program/main.cpp", "framework/program/common/", "framework/program/map/file_options.cpp"}},
      {"zlib.h",
       {"maps/base/deflate.cpp", "maps/base/source_text.cpp", "maps/exchange/recordings/", "maps/store/",
        "plugins/common/logs/"}},
      {"zstd.h", {"maps/exchange/recordings/"}},
      {"lz4frame.h", {"maps/exchange/recordings/"}},
      {"nlohmann/",
       {"framework/behaviour_tree/", "framework/experiments/", "framework/live/", "framework/mission/",
        "framework/planning/", "framework/program/", "framework/reporting/", "maps/base/json_text.cpp",
        "maps/exchange/", "plugins/json_log/", "plugins/rosbridge_robot/"}},
      {"pybind11/", {"python/bindings/", "python/shared/", "plugins/python_module/"}},
      {"pugixml.hpp", {"maps/exchange/graphs/graphml_read.cpp"}},
  };
  for (const Include& include : includes())
    for (const auto& [library, places] : owners)
      if (include.angled && include.header.starts_with(library) && !include.file.starts_with("tests/")) {
        EXPECT_TRUE(starts_with_any(include.file, places)) << include.file << " includes <" << include.header << ">";
      }
}

TEST(Architecture, PublicHeadersUseTheStandardLibraryAndEigenOnly) {
  for (const Include& include : includes()) {
    const bool is_public = include.file.ends_with(".hpp") && starts_with_any(include.file, {"maps/", "framework/"}) &&
                           !include.file.starts_with("framework/program/");
    if (!is_public || !include.angled) continue;
    EXPECT_TRUE(include.header.starts_with("Eigen/") ||
                (include.header.find('/') == std::string::npos && include.header.find('.') == std::string::npos))
        << include.file << " includes <" << include.header << ">";
  }
}

TEST(Architecture, FilesStayUnderThreeHundredCodeLines) {
  for (const Source& source : sources()) {
    int code = 0;
    for (const std::string& line : source.lines) {
      const std::size_t first = line.find_first_not_of(" \t");
      if (first != std::string::npos && !line.substr(first).starts_with("//")) ++code;
    }
    EXPECT_LE(code, source.file.starts_with("tests/") ? 450 : 300) << source.file;
  }
}

}  // namespace
