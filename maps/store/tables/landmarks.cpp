#include <map>

#include "maps/base/json_text.hpp"
#include "maps/store/tables/reading.hpp"
#include "maps/store/tables/tables.hpp"

namespace cairn::store {

std::string annotations_in(const Statement& row, int column) {
  std::string text = row.plain_text(column);
  if (!text.empty() && !exchange::is_json_object(text)) throw StoreError("column annotations holds no JSON object");
  return text;
}

namespace {

using Histories = std::map<LandmarkId, Landmark>;  // templates and evidence alone

// A row of landmarks with its history, which is taken from the others.
Landmark landmark_in(Statement& row, Histories& histories) {
  Landmark landmark;
  landmark.id = row.integer_within(0, 1, kMaxId);
  if (auto history = histories.extract(landmark.id)) {
    landmark.templates = std::move(history.mapped().templates);
    landmark.evidence = std::move(history.mapped().evidence);
  }
  landmark.level = static_cast<int>(row.integer_within(1, -kMaxLevel, kMaxLevel));
  landmark.name = row.plain_text(2);
  landmark.category = row.plain_text(3);
  landmark.T_map_landmark = row.pose(4);
  landmark.degree = row.real(7);
  landmark.sightings = static_cast<int>(row.integer_within(8, 0, kMaxInt));
  landmark.access = row.optional_pose(9);
  return landmark;
}

constexpr std::int64_t kMaxMarkerNumber = 1'000'000;

// Of landmarks and retired ones, which are in no table of their own.
using Markers = std::map<LandmarkId, MarkerId>;

Markers read_markers(Reading& reading) {
  Markers markers;
  Statement table(reading.database, "SELECT 1 FROM sqlite_schema WHERE type = 'table' AND name = 'landmark_markers'");
  if (!table.step()) return markers;  // of version 1
  reading.rows("landmark_markers", "SELECT * FROM landmark_markers ORDER BY landmark", [&](Statement& row) {
    const std::optional<MarkerFamily> family = marker_family_of(row.plain_text(1));
    if (!family) throw StoreError("family is none that is known: \"" + row.plain_text(1) + "\"");
    markers[row.integer_within(0, 1, kMaxId)] = {*family, static_cast<int>(row.integer_within(2, 0, kMaxMarkerNumber))};
  });
  return markers;
}

void take_marker(Markers& markers, Landmark& landmark) {
  if (const auto marker = markers.extract(landmark.id)) landmark.marker = marker.mapped();
}

// table: landmarks or candidates.
void read_landmarks(Reading& reading, const std::string& table, LandmarkGraph& graph, Histories& histories,
                    Markers& markers) {
  reading.rows(table, "SELECT * FROM " + table + " ORDER BY id", [&](Statement& row) {
    Landmark landmark = landmark_in(row, histories);
    take_marker(markers, landmark);
    landmark.annotations = annotations_in(row, 12);
    graph.add(std::move(landmark));
  });
}

void read_retired_landmarks(Reading& reading, LandmarkGraph& graph, Histories& histories, Markers& markers) {
  reading.rows("retired_landmarks", "SELECT * FROM retired_landmarks ORDER BY id", [&](Statement& row) {
    Landmark landmark = landmark_in(row, histories);
    take_marker(markers, landmark);
    landmark.annotations = annotations_in(row, 13);
    graph.add_retired({std::move(landmark), row.plain_text(12)});
  });
}

// prefix: of the tables, "landmark" or "candidate".
Histories read_histories(Reading& reading, const std::string& prefix) {
  Histories histories;
  const std::string templates = prefix + "_templates";
  reading.rows(templates, "SELECT * FROM " + templates + " ORDER BY landmark, rank", [&](Statement& row) {
    histories[row.integer(0)].templates.push_back({row.plain_text(2), row.real(3), row.real(4)});
  });
  const std::string evidence = prefix + "_evidence";
  reading.rows(evidence, "SELECT * FROM " + evidence + " ORDER BY landmark, category", [&](Statement& row) {
    const int matchings = static_cast<int>(row.integer_within(2, 0, kMaxInt));
    histories[row.integer(0)].evidence.push_back({row.plain_text(1), matchings, row.real(3), row.real(4), row.real(5)});
  });
  return histories;
}

void check_all_taken(Reading& reading, const std::string& prefix, const Histories& histories) {
  reading.in_table(prefix + "_templates", [&] {
    if (!histories.empty()) throw StoreError("there is no " + numbered("landmark", histories.begin()->first));
  });
}

MissionProgress progress_in(const Statement& row) {
  MissionProgress progress;
  progress.time_s = row.real(1);
  progress.step = static_cast<int>(row.integer_within(2, 0, kMaxInt));
  progress.step_name = row.plain_text(3);
  progress.T_map_robot = row.pose(4);
  progress.true_T_map_robot = row.optional_pose(7);
  progress.distance_m = row.real(10);
  progress.readings = row.integer_within(11, 0, kMaxId);
  progress.matchings = row.integer_within(12, 0, kMaxId);
  progress.collisions = row.integer_within(13, 0, kMaxId);
  return progress;
}

}  // namespace

void read_all_landmarks(Reading& reading, LandmarkGraph& graph) {
  Histories histories = read_histories(reading, "landmark");
  Markers markers = read_markers(reading);
  read_landmarks(reading, "landmarks", graph, histories, markers);
  read_retired_landmarks(reading, graph, histories, markers);
  check_all_taken(reading, "landmark", histories);
  reading.in_table("landmark_markers", [&] {
    if (!markers.empty()) throw StoreError("there is no " + numbered("landmark", markers.begin()->first));
  });
}

void read_progress(Reading& reading, SavedMap& map) {
  reading.rows("progress", "SELECT * FROM progress ORDER BY number", [&](Statement& row) {
    if (map.progress) throw StoreError("has more than one row");
    map.progress = progress_in(row);
  });
  Histories histories = read_histories(reading, "candidate");
  LandmarkGraph candidates;
  Markers none;  // a candidate is never a marker
  read_landmarks(reading, "candidates", candidates, histories, none);
  check_all_taken(reading, "candidate", histories);
  if (map.progress)
    map.progress->candidates = std::move(candidates);
  else
    reading.in_table("candidates", [&] {
      if (!candidates.landmarks().empty()) throw StoreError("has rows, but table progress has none");
    });
}

}  // namespace cairn::store
