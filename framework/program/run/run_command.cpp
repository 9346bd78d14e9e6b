#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "framework/mission/resume.hpp"
#include "framework/mission/runner.hpp"
#include "framework/modules/fence.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/interrupt.hpp"
#include "framework/program/common/making_watch.hpp"
#include "framework/program/common/modules.hpp"
#include "framework/program/common/output_files.hpp"
#include "framework/program/common/print.hpp"
#include "framework/program/common/printable_stream.hpp"
#include "framework/program/common/refusal.hpp"
#include "framework/program/mission/control_server.hpp"
#include "framework/program/mission/watch_text.hpp"
#include "framework/program/run/localise.hpp"
#include "framework/program/run/pictures.hpp"
#include "framework/program/run/progress_line.hpp"
#include "framework/program/run/recordings.hpp"
#include "framework/program/run/viewer.hpp"
#include "framework/reporting/report.hpp"
#include "framework/reporting/watching/watch_source.hpp"
#include "framework/safety/fatal_ends.hpp"
#include "maps/base/text.hpp"
#include "maps/exchange/pose_graphs/stamped_poses.hpp"
#include "maps/landmarks/close_categories.hpp"
#include "maps/landmarks/route_count.hpp"

namespace cairn {
namespace {

void print_landmarks(std::ostream& out, const Mission& mission, const LandmarkGraph& graph) {
  if (graph.landmarks().empty()) return;
  out << "\n  landmark  category        x m     y m   angle deg  degree" << (mission.world ? "   error m" : "") << "\n";
  const TruthScore truth = mission.world ? score_against(*mission.world, graph, 0.5) : TruthScore{};
  for (const auto& [id, landmark] : graph.landmarks()) {
    out << fmt::format("  {:<9} {:<12} {:7.2f} {:7.2f} {:11} {:7.2f}", fmt::format("L{}", id), landmark.category,
                       landmark.T_map_landmark.x_m, landmark.T_map_landmark.y_m,
                       std::lround(degrees(landmark.T_map_landmark.theta_rad)), landmark.degree);
    for (const LandmarkTruth& matched : truth.matched)
      if (matched.landmark == id) out << fmt::format(" {:9.3f}", matched.error_m);
    const std::string close = close_text(landmark);
    if (landmark.marker) out << "  " << text_of(*landmark.marker);
    out << (landmark.name.empty() ? "" : "  " + landmark.name) << (close.empty() ? "" : "  close: " + close) << "\n";
  }
}

void print_times(std::ostream& out, const std::vector<StageTime>& times) {
  out << "\n  stage             module                  calls  median us     p99 us   worst us\n";
  for (const StageTime& t : times)
    out << fmt::format("  {:<17} {:<20} {:>8} {:>10.2f} {:>10.2f} {:>10.2f}\n", t.stage, t.module, t.count, t.median_us,
                       t.p99_us, t.worst_us);
}

void print_summary(std::ostream& out, const Mission& mission, const MissionResult& result, const MissionRunner& runner,
                   const RunReport& report, const RunPictures& pictures, const std::filesystem::path& folder,
                   double wall_s) {
  print_landmarks(out, mission, runner.graph());
  out << fmt::format("\n  outcome     {}{}\n", name_of(result.outcome),
                     result.reason.empty() ? "" : ": " + result.reason);
  out << fmt::format("  driven      {:.1f} m in {:.0f} s, {} collisions\n", result.distance_m, result.time_s,
                     result.collisions);
  if (const auto error = report.pose_errors().figures())
    out << fmt::format("  pose error  median {:.3f} m, 95 % {:.3f} m, worst {:.3f} m; {} corrections, {} refused\n",
                       error->median_m, error->p95_m, error->worst_m, error->corrections, error->refused);
  if (const auto& graph = result.pose_graph)
    out << fmt::format("  pose graph  {}, {}, {} of {} believed; map moved {}\n", counted(graph->submaps, "submap"),
                       counted(graph->nodes, "node"), graph->closures_believed, counted(graph->closures, "closure"),
                       counted(result.map_moves, "time"));
  if (const MarkerFigures& markers = report.markers(); markers.sightings() > 0)
    out << fmt::format("  tags        {}, {}; corners {:.2f} pixels off\n", counted(markers.markers(), "tag"),
                       counted(markers.sightings(), "sighting"), markers.reprojection_error_px());
  if (const std::string warning = report.markers().warning(); !warning.empty())
    out << "  warning     " << warning << "\n";
  if (result.localisation) out << "  trust       " << trust_text(*result.localisation) << "\n";
  out << fmt::format("  readings    {}, {}, {}, {}\n", result.readings, counted(result.matchings, "matching"),
                     counted(runner.graph().landmarks().size(), "landmark"), counted_routes(runner.graph()));
  const double speed = (result.time_s - result.resumed_s.value_or(0.0)) / std::max(wall_s, 1e-9);
  out << fmt::format("  took        {:.1f} s, {:.{}f} x real time\n", wall_s, speed, speed < 10.0 ? 1 : 0);
  if (!mission.config.record.empty()) out << "  recording   " << (folder / mission.config.record).string() << "\n";
  if (!mission.config.record_mcap.empty())
    out << "  recording   " << (folder / mission.config.record_mcap).string() << "\n";
  if (!result.map_file.empty()) out << "  map         " << (folder / result.map_file).string() << "\n";
  if (std::filesystem::exists(folder / "report.json"))
    out << "  report      " << (folder / "report.json").string() << "\n";
  for (const std::string& picture : pictures.files) out << "  picture     " << (folder / picture).string() << "\n";
  for (const std::string& sentence : pictures.missing) out << "  no picture  " << sentence << "\n";
}

// The map to go on from, and its seed when the command line names none.
std::optional<SavedMap> map_to_resume(const RunCommand& command, std::optional<std::int64_t>& seed) {
  if (command.resume.empty()) return std::nullopt;
  SavedMap map = load_map_to_work_with(command.resume);
  if (!seed) seed = refused_about<StoreError>(command.resume.string(), [&] { return seed_of(map); });
  return map;
}

// This run records the orders that it takes, over those of an earlier one.
std::vector<RecordedOrder> orders_to_give(const RunCommand& command) {
  if (command.orders.empty()) return {};
  std::error_code error;
  if (std::filesystem::equivalent(command.orders, command.out / kOrdersFile, error))
    throw std::runtime_error(command.orders.string() +
                             ": this run would write over it; choose another folder by --out");
  return read_orders(command.orders);
}

// The mission was cancelled while its modules were made, as when a signal comes while a log is read.
class CancelledEarly : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

int report_cancelled(const CommonOptions& common, const std::string& reason) {
  (common.json ? std::cerr : std::cout) << "\n  outcome     cancelled: cancelled by the user before the mission began: "
                                        << reason << "\n"
                                        << std::flush;
  if (common.json) print_json({{"outcome", name_of(MissionOutcome::cancelled)}, {"reason", reason}});
  return kExitNotSolved;
}

void publish_cancelled(const Mission& mission, RunControl& control, const std::string& reason) {
  RunStatus status;
  status.mission = mission.config.mission;
  status.state = RunState::ended;
  status.outcome = name_of(MissionOutcome::cancelled);
  status.reason = reason;
  control.publish(status);
}

MissionRunner runner_of(const Mission& mission, const ModuleLibrary& library, const RunOptions& options,
                        const RunCommand& command, const CommonOptions& common) {
  const double max_s = max_making_s(mission.config.watchdog_s);
  const MakingWatch watch({max_s, *options.cancel}, [&](const std::string& sentence, bool by_user) {
    if (by_user) publish_cancelled(mission, *options.control, sentence);
    if (!by_user) std::cerr << "cairn: " << sentence << "\n" << std::flush;
    const int status = by_user ? report_cancelled(common, sentence) : kExitBadInput;
    std::cout.flush();
    std::_Exit(status);
  });
  try {
    const std::filesystem::path& map = options.localise_in ? command.localise_in : command.resume;
    return refused_about<StoreError>(map.string(), [&] {
      if (options.resume != nullptr && !command.other_world) check_same_world(*options.resume, mission);
      if (options.localise_in && !command.other_world) check_same_world(*options.localise_in->map, mission);
      return MissionRunner(mission, library, options);
    });
  } catch (const ConfigError& error) {
    if (!*options.cancel) throw;
    publish_cancelled(mission, *options.control, error.sentence());
    throw CancelledEarly(error.sentence());
  }
}

// An autosave that this run does not go on from is all that is left of a run that was cut short.
void keep_earlier_run(const RunCommand& command, const MissionConfig& config, std::ostream& people) {
  const std::filesystem::path file = command.out / autosave_file_of(config);
  std::error_code error;
  if (config.autosave.every_s <= 0.0 || std::filesystem::equivalent(file, command.resume, error)) return;
  const auto kept = keep_earlier_autosave(file, command.resume);
  if (!kept) return;
  people << "an earlier run here did not end: its map is kept as " << kept->file.string() << " (--resume continues it)";
  if (kept->removed > 0) people << "; of " << kept->removed + 1 << " autosaves, this one's mission had come furthest";
  people << "\n";
}

// Without it the mission runs all the same, and signals still reach it.
std::unique_ptr<ControlServer> control_server(const std::filesystem::path& folder, RunControl& control,
                                              const Mission& mission, WatchSource& source) {
  try {
    Watching watching{&source, WatchText::first_line(mission.config.mission, mission.steps, mission.robot.radius_m)};
    return std::make_unique<ControlServer>(folder, control, std::move(watching));
  } catch (const std::exception& error) {
    std::cerr << "`cairn mission` cannot reach this run: " << error.what() << "\n";
    return nullptr;
  }
}

// What cannot be written is reported, and the rest of the run's outcome is not lost for it.
bool try_to_write(const std::filesystem::path& file, const std::string& text) {
  try {
    write_file(file, text);
    return true;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return false;
  }
}

// What the run leaves behind, after its last event: files, pictures, and the summary for people or as JSON.
class RunResults {
 public:
  RunResults(const RunCommand& command, const CommonOptions& common, const Mission& mission)
      : command_(command), common_(common), mission_(mission) {}

  // Whether the report was written.
  bool write(const RunReport& report, const MissionResult& result, const MissionRunner& runner) {
    const auto write_report = [&] {
      const std::string text = report.report_json(mission_, result, runner.graph(), pictures_.files);
      return try_to_write(command_.out / "report.json", text);
    };
    // First of all, since drawing may take long, or end the program; then once more with the names of the pictures.
    const bool is_written = write_report();
    try_to_write(command_.out / "track.json", report.track().json());
    try_to_write(command_.out / "timing.json", timing_json(runner.times()) + "\n");
    if (!result.poses.empty()) try_to_write(command_.out / "poses.tum", tum_of(result.poses));
    pictures_ = draw_run(command_.out, mission_, runner, result, report);
    return pictures_.files.empty() ? is_written : write_report();
  }

  void print(const RunReport& report, const MissionResult& result, const MissionRunner& runner) const {
    const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    std::ostream& people = common_.json ? std::cerr : std::cout;
    print_times(people, runner.times());
    print_summary(people, mission_, result, runner, report, pictures_, command_.out, wall_s);
    if (common_.json)
      std::cout << report.summary_json(mission_, result, runner, command_.out, pictures_.files, wall_s) << "\n";
  }

 private:
  const RunCommand& command_;
  const CommonOptions& common_;
  const Mission& mission_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  RunPictures pictures_;
};

void let_see(WatchSource& watched, const MissionRunner& runner, const RunReport& report) {
  watched.look_by({[&runner] { return runner.status(); }, [&runner] { return runner.node_reports(); },
                   [&runner]() -> const std::vector<Pose2>& { return runner.driven_path(); },
                   [&report] { return report.events().sentences(); }, [&runner] { return runner.times(); },
                   [&runner] { return runner.clusters(); }});
}

MissionResult run_with_listeners(const RunCommand& command, const Mission& mission, MissionRunner& runner,
                                 RunReport& report, McapRecording* mcap, WatchSource& watched, std::ostream& people) {
  std::optional<RunRecording> recording;
  if (!mission.config.record.empty()) recording.emplace(command.out / mission.config.record, runner.T_map_start());
  std::ostream terminal(terminal_of(people));
  const bool live = isatty(&people == &std::cerr ? STDERR_FILENO : STDOUT_FILENO) != 0;
  MissionResult result;
  {
    ProgressLine progress(terminal, live, [&] { return runner.status(); });
    runner.subscribe(report);
    if (recording) runner.subscribe(*recording);
    if (mcap != nullptr) runner.subscribe(*mcap);
    runner.subscribe(progress);
    runner.subscribe(watched);
    result = runner.run();
    watched.end(runner.grid(), runner.graph());
  }
  for (const std::string& fault : runner.listener_faults()) std::cerr << "a listener failed: " << fault << "\n";
  if (recording) finish(*recording);
  return result;
}

// A thread that was left behind still runs: nothing that it may use can be torn down.
[[noreturn]] void end_at_once(int status, std::unique_ptr<ControlServer>& server) {
  server.reset();
  std::cout.flush();
  std::cerr.flush();
  std::_Exit(status);
}

int run_mission(const RunCommand& command, const CommonOptions& common) {
  ControlFlags& flags = flags_of_signals();
  std::optional<std::int64_t> seed = command.seed;
  const std::optional<SavedMap> resume = map_to_resume(command, seed);
  const std::optional<Pose2> pose = pose_given(command);
  const std::optional<MapToLocaliseIn> known = map_to_localise_in(command);
  Mission mission = load_mission(command.mission, command.overrides, seed);
  if (known && !known->T_map_start) begin_with_finding_itself(mission);
  const std::vector<RecordedOrder> orders = orders_to_give(command);
  RunResults results(command, common, mission);
  const ModuleLibrary library = module_library(common);
  for (const std::string& fault : library.faults()) std::cerr << "not loaded: " << fault << "\n";
  handle_fatal_ends();  // again: before what the modules have loaded
  make_folder(command.out);
  hold_folder(command.out);
  std::ostream& people = common.json ? std::cerr : std::cout;
  people << fmt::format("mission {}, seed {}\n", mission.config.mission, mission.config.seed) << std::flush;
  RunControl control(flags, mission.config.mission);
  WatchSource watched;
  std::unique_ptr<ControlServer> server = control_server(command.out, control, mission, watched);
  std::optional<Viewer> viewer;
  if (command.view && server) viewer.emplace(command.out, command.control, common.json);
  RunOptions options{command.out, command.pace, &flags.cancel, true, resume ? &*resume : nullptr, &control, orders};
  options.on_wait = [](const std::string& sentence) { std::cerr << sentence << "\n" << std::flush; };
  if (known) options.localise_in = LocaliseIn{&known->map, known->T_map_start};
  if (resume) options.T_map_resumed = pose;
  MissionRunner runner = runner_of(mission, library, options, command, common);
  choose_recordings(mission.config, command, runner.has_drive() && !mission.world);
  if (!known) keep_earlier_run(command, mission.config, people);
  RunReport report(mission.config.history);
  let_see(watched, runner, report);
  std::optional<McapRecording> mcap;
  if (!mission.config.record_mcap.empty()) mcap.emplace(command.out / mission.config.record_mcap);
  const MissionResult result =
      run_with_listeners(command, mission, runner, report, mcap ? &*mcap : nullptr, watched, people);
  const bool is_reported = results.write(report, result, runner);
  if (mcap) finish(*mcap, command, result, runner.grid());
  results.print(report, result, runner);
  const int status = result.outcome == MissionOutcome::done && is_reported ? kExitDone : kExitNotSolved;
  if (runner.gave_up()) end_at_once(status, server);
  return status;
}

}  // namespace

int run(const RunCommand& command, const CommonOptions& common) {
  try {
    return run_mission(command, common);
  } catch (const CancelledEarly& cancelled) {
    return report_cancelled(common, cancelled.what());
  }
}

}  // namespace cairn
