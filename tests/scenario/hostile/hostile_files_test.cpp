// Planted links in an output folder, and a log that unpacks to gigabytes.
#include "tests/scenario/hostile/hostile_files.hpp"

#include <gmock/gmock.h>
#include <zlib.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "maps/store/map_store.hpp"

namespace cairn::testing_program {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class PlantedFiles : public HostileFiles {
 protected:
  PlantedFiles() : HostileFiles("planted") {}
};

TEST_F(PlantedFiles, LinksInTheOutputFolderAreReplacedAndNotFollowed) {
  const std::string victim = written("victim", "precious");
  fs::create_directories(folder_ / "out");
  const std::vector<std::string> names{"report.json", "track.json",     "timing.json",  "held.cairn",
                                       "map.png",     "pose_error.png", "timeline.png", "a.log"};
  for (const std::string& name : names) {
    fs::create_symlink(victim, folder_ / "out" / name);
    fs::create_symlink(victim, folder_ / "out" / ("." + name + ".saving"));
  }
  const Finished run =
      run_cairn({"run", mission("m.yaml", "[wait: 2]", "record: a.log\n"), "--out", file("out"), "--json"});
  EXPECT_EQ(run.exit_status, 0) << run.err;
  EXPECT_EQ(text_of_file(victim), "precious");
  const json report = json::parse(text_of_file(folder_ / "out/report.json"));
  EXPECT_EQ(report["outcome"], "done");
  for (const std::string& name : names) {
    if (name == "pose_error.png" && fs::is_symlink(folder_ / "out" / name)) continue;  // gnuplot may not be installed
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder_ / "out" / name))) << name;
  }
  EXPECT_NO_THROW((void)load_map(folder_ / "out/held.cairn"));
}

TEST_F(PlantedFiles, ALinkInPlaceOfTheLockEndsTheRun) {
  const std::string victim = written("victim", "precious");
  fs::create_directories(folder_ / "out");
  fs::create_symlink(victim, folder_ / "out/.cairn.lock");
  const Finished run = run_cairn({"run", mission("m.yaml", "[wait: 2]"), "--out", file("out")});
  EXPECT_EQ(run.exit_status, 2);
  EXPECT_THAT(run.err, HasSubstr("out/.cairn.lock: the lock of the output folder is a symbolic link"));
  EXPECT_EQ(text_of_file(victim), "precious");
}

// In place of gnuplot stands a program that looks for the report while it is to draw.
TEST_F(PlantedFiles, TheReportIsThereBeforeThePicturesAreDrawn) {
  const std::string gnuplot = written("bin/gnuplot", "#!/bin/sh\ntest -s '" + file("out/report.json") +
                                                         "' && echo seen > '" + file("seen") + "'\nexit 1\n");
  fs::permissions(gnuplot, fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (file("bin") + ":" + path).c_str(), 1);
  const Finished run = run_cairn({"run", mission("m.yaml", "[wait: 2]"), "--out", file("out"), "--json"});
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(run.exit_status, 0) << run.err;
  EXPECT_EQ(text_of_file(file("seen")), "seen\n");
  const json pictures = json::parse(text_of_file(folder_ / "out/report.json"))["pictures"];
  EXPECT_THAT(pictures.get<std::vector<std::string>>(), testing::Contains("map.png")) << "of those that were drawn";
}

std::string gzip_of(const std::string& text) {
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

class Bomb : public HostileFiles {
 protected:
  Bomb() : HostileFiles("bomb") {
    // 6 GB, which take some ten seconds or more to unpack.
    const std::string part = gzip_of(std::string(std::size_t{64} << 20U, '\0'));
    std::string all;
    for (int i = 0; i < 96; ++i) all += part;
    static_cast<void>(written("bomb.log.gz", all));
  }
  void expect_soon_cancelled(const std::string& plugin, int signal) {
    const std::string with = "{plugin: " + plugin + ", file: bomb.log.gz}";
    Conversation run({"run", mission("m.yaml", "[wait: 1]", "", with), "--out", file("out")});
    EXPECT_THAT(run.hear(), HasSubstr("mission held"));
    const Finished status = run_cairn({"mission", "status", file("out"), "--json"});
    EXPECT_EQ(json::parse(status.out)["state"], "starting") << "the log is being read: " << status.err;
    const auto begin = std::chrono::steady_clock::now();
    run.send(signal);
    EXPECT_EQ(run.exit_status(), 1) << plugin;
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3)) << plugin;
    EXPECT_FALSE(fs::exists(folder_ / "out/control.sock"));
  }
};

TEST_F(Bomb, ReadingItEndsSoonAfterASignal) {
  expect_soon_cancelled("carmen_log", SIGTERM);
  expect_soon_cancelled("player_log", SIGINT);
}

TEST_F(Bomb, ReadingItEndsSoonAfterACancelFromOutside) {
  const std::string with = "{plugin: carmen_log, file: bomb.log.gz}";
  Conversation run({"run", mission("m.yaml", "[wait: 1]", "", with), "--out", file("out")});
  EXPECT_THAT(run.hear(), HasSubstr("mission held"));
  const Finished cancel = run_cairn({"mission", "cancel", file("out"), "--json"});
  EXPECT_EQ(cancel.exit_status, 0) << cancel.err;
  EXPECT_EQ(json::parse(cancel.out)["outcome"], "cancelled");
  EXPECT_EQ(run.exit_status(), 1);
}

}  // namespace
}  // namespace cairn::testing_program
