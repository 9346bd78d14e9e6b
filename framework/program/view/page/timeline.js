// A finished run: where the robot was, what it did and what had been said at any time of it.
import { ask_json, element, say } from './api.js';
import { Chart } from './charts.js';
import { begin, draw_lines, draw_plan, draw_ranges, draw_robot, draw_sign, redraw } from './canvas.js';
import { GridHistory } from './grid_history.js';
import * as saved from './map.js';
import { clear_nodes, event_of, show_facts, show_lines, show_node, show_parts, show_tree } from './panels.js';

let report, track = { poses: [], plans: [], landmarks: [], ranges: [] }, grid = new GridHistory([]);
const kReadingsShown_s = 1;
const charts = [];
let events = [], runs = [], at_s = 0, end_s = 0, player = null;

// The last whose time has come; -1: none.
function last_before(list, time_of, time_s) {
  let low = 0, high = list.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (time_of(list[middle]) <= time_s) low = middle + 1; else high = middle;
  }
  return low - 1;
}

// "3/1/2" below "3/1" below "3"; the report names only what was ticked.
function tree_of(nodes) {
  const all = new Map(nodes.map((node) => [node.path, { ...node, settings: '', children: [] }]));
  const roots = [];
  for (const [path, node] of all) (all.get(path.slice(0, path.lastIndexOf('/')))?.children ?? roots).push(node);
  return roots;
}

function show_nodes() {
  clear_nodes();
  for (const run of runs) if (run.begin_s <= at_s) show_node(run.path, at_s < run.end_s ? 'running' : run.outcome, '');
}

function pose_at(time_s) {
  const i = last_before(track.poses, (pose) => pose[0], time_s);
  if (i < 0) return track.poses[0];
  const before = track.poses[i], after = track.poses[i + 1] ?? before;
  const part = after[0] > before[0] ? (time_s - before[0]) / (after[0] - before[0]) : 0;
  const turn = Math.atan2(Math.sin(after[3] - before[3]), Math.cos(after[3] - before[3]));
  return [time_s, before[1] + part * (after[1] - before[1]), before[2] + part * (after[2] - before[2]), before[3] + part * turn, before.slice(4)];
}

// As the live view draws them; a range without an echo is negative.
function ranges_at(time_s) {
  const ranges = track.ranges ?? [];
  const [then_s, ...readings] = ranges[last_before(ranges, (one) => one[0], time_s)] ?? [-Infinity];
  if (time_s - then_s > kReadingsShown_s + (ranges.length > 1 ? ranges[1][0] - ranges[0][0] : 0)) return [];
  return readings.map(([x, y, theta, half, range]) => [x, y, theta, half, Math.abs(range), range < 0 ? 'no_echo' : 'echo']);
}

// Landmarks that the run found are there from then on; others it had from the beginning.
function landmarks_at(time_s) {
  const found = new Map(track.landmarks.filter((one) => one.change === 'found').map((one) => [one.id, one.time_s]));
  return saved.landmarks.filter((one) => (found.get(one.id) ?? 0) <= time_s);
}

function draw() {
  const is_past = at_s < end_s && !grid.is_empty;
  if (saved.map) saved.draw_map(landmarks_at(at_s), is_past ? () => grid.draw(saved.map) : undefined);
  const i = last_before(track.poses, (pose) => pose[0], at_s);
  const path = track.poses.slice(0, i + 1).map(([, x, y]) => [x, y]);
  if (element('show-path').checked) draw_lines([path], '#009e73', 2);
  if (element('show-ranges').checked) draw_ranges(ranges_at(at_s));
  const plan = track.plans[last_before(track.plans, (one) => one.time_s, at_s)];
  draw_plan(plan?.points ?? []);
  if (element('show-misses').checked)
    for (const miss of (report.near_misses ?? []).filter((one) => (one.time_s ?? 0) <= at_s)) draw_sign('✕', `${miss.category} ${miss.degree.toFixed(2)}`, miss.x_m, miss.y_m);
  const pose = pose_at(at_s);
  if (pose) draw_robot(pose.slice(1), track.robot_radius_m ?? 0, '#cc79a7', pose[4]?.length ? pose[4] : undefined);
  saved.draw_plan();
}

function show_time(time_s) {
  at_s = Math.min(Math.max(time_s, 0), end_s);
  element('slider').value = at_s;
  element('slider').setAttribute('aria-valuetext', `${at_s.toFixed(1)} seconds`);
  element('clock').textContent = `${at_s.toFixed(1)} of ${end_s.toFixed(1)} s`;
  show_nodes();
  grid.show(at_s);
  for (const chart of charts) chart.draw(end_s, at_s);
  show_lines(events.slice(0, last_before(events, (event) => event[0], at_s) + 1));
  redraw();
}

function play() {
  if (player) { clearInterval(player); player = null; element('play').textContent = 'Play'; return; }
  if (at_s >= end_s) show_time(0);
  element('play').textContent = 'Stop';
  player = setInterval(() => {
    show_time(at_s + 0.1 * Number(element('speed').value));
    if (at_s >= end_s) play();
  }, 100);
}

// Where it was paused, stopped by what its sensors saw, or bumped.
function draw_marks() {
  const marks = element('marks');
  const add = (begin_s, until_s, kind, title) => {
    const mark = document.createElement('span');
    mark.className = kind; mark.title = title;
    mark.style.left = `${100 * begin_s / end_s}%`;
    mark.style.width = `max(2px, ${100 * (until_s - begin_s) / end_s}%)`;
    marks.append(mark);
  };
  for (const run of report.steps ?? []) add(run.begin_s, run.end_s, 'step', `${run.step}: ${run.outcome}`);
  for (const stop of report.stops ?? []) add(stop.begin_s, stop.end_s, 'stop', 'stopped by the collision monitor');
  for (const hold of report.holds ?? []) add(hold.begin_s, hold.end_s, 'stop', 'held by the robot itself');
  for (const pause of report.pauses ?? []) add(pause.time_s, pause.time_s, 'pause', `paused for ${pause.for_s} s`);
  for (const touch of report.contacts ?? []) add(touch.time_s, touch.time_s, 'contact', 'touched something');
}

function add_charts() {
  if (report.pose_errors?.length) {
    const chart = new Chart('Error of the pose', 'm');
    for (const { time_s, error_m } of report.pose_errors) chart.add('error', time_s, error_m);
    charts.push(chart);
  }
  if (report.degrees?.length) {
    const chart = new Chart('Degrees of matching', '0 to 1');
    for (const { time_s, ...degrees } of report.degrees)
      for (const [category, degree] of Object.entries(degrees)) chart.add(category, time_s, degree);
    charts.push(chart);
  }
  if (charts.length) show_parts('charts-part');
}

// What was most like a landmark and was none.
function list_misses() {
  const misses = report.near_misses ?? [];
  if (!misses.length) return;
  element('misses').replaceChildren(...misses.map((miss) => {
    const item = document.createElement('li');
    item.textContent = `${miss.category} ${miss.degree.toFixed(2)} at (${miss.x_m.toFixed(2)}, ${miss.y_m.toFixed(2)})${miss.needs ? `, needs ${miss.needs.toFixed(2)}` : ''}`;
    return item;
  }));
  show_parts('misses-part', 'misses-label');
}

// Wall clock, the longest first; it differs from run to run.
async function show_times() {
  const times = await ask_json('/api/timing').catch(() => []);
  if (!times.length) return;
  const row_of = ({ stage, module, count, median_us, worst_us, total_s }) => {
    const row = document.createElement('tr');
    for (const text of [module ? `${stage} (${module})` : stage, count, (median_us / 1000).toFixed(2), (worst_us / 1000).toFixed(1), total_s.toFixed(2)]) {
      const cell = document.createElement('td');
      cell.textContent = text;
      row.append(cell);
    }
    return row;
  };
  element('times').replaceChildren(...times.sort((a, b) => b.total_s - a.total_s).map(row_of));
  show_parts('times-part');
}

export async function show_run(settings) {
  report = await ask_json('/api/report');
  track = await ask_json('/api/track').catch(() => track);
  grid = new GridHistory(track.grid ?? []);
  let why = '';
  await saved.load_map().catch((error) => { why = ` No map: ${error.message}`; });
  events = (report.events ?? []).map(event_of);
  runs = [...report.node_runs ?? []].sort((a, b) => a.end_s - b.end_s);
  end_s = Math.max(report.time_s, 0.1);
  document.title = element('name').textContent = `${report.mission} (${settings.name})`;
  if (track.ranges?.length) show_parts('ranges-label');
  show_parts('clock', 'timeline', 'tree-part', 'log-part', 'facts-part');
  element('show-path').checked = true;
  show_facts([['outcome', report.outcome], ['reason', report.reason || '-'], ['driven', `${report.distance_m.toFixed(1)} m`],
              ['time', `${report.time_s.toFixed(1)} s`], ['landmarks', String(report.landmarks.length)]]);
  show_tree(tree_of(report.nodes ?? []));
  draw_marks();
  add_charts();
  show_times();
  list_misses();
  const slider = element('slider');
  slider.max = end_s; slider.step = Math.max(end_s / 5000, 0.01);
  slider.oninput = () => show_time(Number(slider.value));
  element('play').onclick = play;
  begin({ draw, show_all: () => saved.map && saved.show_all(), click: saved.choose });
  if (saved.map) saved.show_all();
  show_time(end_s);
  say((track.poses.length ? `${report.outcome}. Drag the time to go back in the run.` :
      'The run has left no track of its poses; its log and its tree can be browsed.') + why);
}
