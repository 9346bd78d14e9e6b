// A mission while it runs: what its stream says, drawn as it comes.
import { ask_json, element, post, say, token } from './api.js';
import { Chart } from './charts.js';
import { begin, categories_of, draw_landmarks, draw_lines, draw_plan, draw_ranges, draw_robot, draw_routes, draw_sign, fit, fit_again, redraw, view } from './canvas.js';
import { draw_clusters, offer_levels } from './clusters.js';
import { list_landmarks } from './map.js';
import { add_lines, event_of, show_facts, show_lines, show_node, show_parts, show_tree } from './panels.js';
import { bytes_of, Tiles } from './tiles.js';

const kMaxPath = 20000, kRetry_ms = 1000;
const run = { tiles: new Tiles(), landmarks: new Map(), routes: [], clusters: [], path: [], ranges: [], plan: null };
const charts = new Map();  // title -> Chart
let may_steer = false, has_ended = false, target = null;
let settings = {};  // of the view

function chart_of(title, unit) {
  if (!charts.has(title)) { charts.set(title, new Chart(title, unit)); show_parts('charts-part'); }
  return charts.get(title);
}

// Once a second of the mission's time, the most that a curve needs.
function take_figures(line) {
  if (line.time_s === undefined || line.time_s < (run.next_figure_s ?? 0)) return;
  run.next_figure_s = line.time_s + 1;
  if (line.pose && line.truth)
    chart_of('Error of the pose', 'm').add('error', line.time_s, Math.hypot(line.pose.x_m - line.truth[0], line.pose.y_m - line.truth[1]));
  for (const one of run.shown.slice(0, 6)) chart_of('Degrees of landmarks', '0 to 1').add(one.label, line.time_s, one.degree);
  for (const chart of charts.values()) chart.draw(line.time_s, line.time_s);
}

// Of the wall clock, the stages in which most of it is spent.
function take_times(line) {
  const before = run.times;
  run.times = { tick: line.tick, own_s: new Map(line.times.map(([stage, module, , own_s]) => [module ? `${stage} (${module})` : stage, own_s])) };
  if (!before || line.tick === before.tick) return;
  for (const [name, own_s] of [...run.times.own_s].sort((a, b) => b[1] - a[1]).slice(0, 5))
    chart_of('Time of a tick', 'ms').add(name, line.time_s, 1000 * (own_s - (before.own_s.get(name) ?? 0)) / (line.tick - before.tick));
}

function take_landmarks(changed = [], retired = []) {
  if (!changed.length && !retired.length) return;
  for (const landmark of changed) run.landmarks.set(landmark.id, landmark);
  for (const id of retired) run.landmarks.delete(id);
  run.shown = [...run.landmarks.values()].sort((a, b) => a.id - b.id);
  run.categories = categories_of(run.shown);
  list_landmarks(run.shown, (one) => aim([one.x, one.y], one.label, `L${one.id}`));
}

function take_pose(pose) {
  run.pose = pose;
  const last = run.path[run.path.length - 1];
  if (!last || Math.hypot(last[0] - pose.x_m, last[1] - pose.y_m) > 0.03) run.path.push([pose.x_m, pose.y_m]);
  if (run.path.length > kMaxPath) run.path = run.path.filter((_, i) => i % 2 === 0);
}

// The one that takes the place of a button which cannot be pressed any more keeps the keyboard's focus.
function enable(button, is_enabled, instead) {
  const had_focus = !is_enabled && document.activeElement === button;
  button.disabled = !is_enabled;
  if (had_focus) instead.focus();
}

function take_status(status) {
  run.status = status;
  show_facts([
    ['time', `${status.time_s.toFixed(1)} s`],
    ['state', status.state],
    ['step', `${status.step} of ${status.steps}: ${status.step_name}`],
    ['doing', status.doing || '-'],
    ['time left', status.eta_s === null ? 'not known' : `about ${status.eta_s.toFixed(0)} s`],
    ['explored', `${(100 * status.explored_ratio).toFixed(0)} %`],
    ['driven', `${status.distance_m.toFixed(1)} m`],
    ['landmarks', String(status.landmarks)],
    ['pose', status.pose.trust]]);
  const sentence = `${status.mission}: ${status.state}${status.outcome ? `, ${status.outcome}` : ''}`;
  if (sentence !== run.sentence) say(sentence);  // once: the answer to an order stays until the state is another
  run.sentence = sentence;
  const pause = element('pause'), resume = element('resume');
  if (status.state === 'running') pause.disabled = false;
  if (status.state === 'paused') resume.disabled = false;
  enable(pause, status.state === 'running', resume);
  enable(resume, status.state === 'paused', pause);
}

function begin_run(line) {
  if (line.ok !== true) { say(`The run cannot be watched: ${line.error}`); return; }
  Object.assign(run, { tiles: new Tiles(), landmarks: new Map(), routes: [], clusters: [], path: [], shown: [], categories: [], next_figure_s: 0, times: null, sentence: '' });
  run.radius_m = line.robot_radius_m;
  document.title = element('name').textContent = line.mission;
  element('log').replaceChildren();
  show_tree(line.tree);
  say(`${line.mission}: starting`);
}

function take(line) {
  if ('ok' in line) return begin_run(line);
  if (line.status) take_status(line.status);
  if (line.ended) { end(); return; }
  if (line.afresh) { run.tiles.clear(); run.landmarks.clear(); run.clusters = []; }
  if (line.grid) { run.grid = line.grid; fit_again(); }
  for (const [tx, ty, text] of line.tiles ?? []) run.tiles.take(tx, ty, bytes_of(text));
  take_landmarks(line.landmarks, line.afresh ? [0] : line.retired);
  if (line.routes) run.routes = line.routes;
  if (line.clusters) { run.clusters = line.clusters; offer_levels(run.clusters); }
  if (line.driven) run.path = line.driven;
  if (line.pose) take_pose(line.pose);
  if (line.ranges) run.ranges = line.ranges;
  if (line.times) take_times(line);
  take_figures(line);
  run.truth = line.truth;
  if ('plan' in line) run.plan = line.plan;
  for (const [path, state, reason] of line.nodes ?? []) show_node(path, state, reason);
  if (line.past) show_lines(line.past.map(event_of));
  if (line.log) add_lines(line.log, line.log_left_out);
  if (line.time_s !== undefined) element('clock').textContent = `${line.time_s.toFixed(1)} s${line.paused ? ', paused' : ''}`;
  redraw();
}

function draw() {
  if (!run.grid) return;
  run.tiles.draw(run.grid);
  if (element('show-ranges').checked) draw_ranges(run.ranges);
  if (element('show-routes').checked) draw_routes(run.routes);
  if (element('show-path').checked) draw_lines([run.path], '#009e73', 1.5);
  draw_clusters(run.clusters, run.shown);
  if (element('show-landmarks').checked) draw_landmarks(run.shown, run.categories);
  draw_plan(run.plan?.points ?? []);
  if (run.truth && element('show-truth').checked) draw_robot(run.truth, run.radius_m, '#e69f00');
  if (run.pose) draw_robot([run.pose.x_m, run.pose.y_m, run.pose.theta_rad], run.radius_m, '#cc79a7', run.pose.covariance);
  if (target) draw_sign('✚', target.text, ...target.at);
}

function show_all() {
  if (!run.grid) return;
  const { cell_m, origin_m, box } = run.grid;
  fit([origin_m[0] + box.x * cell_m, origin_m[1] + box.y * cell_m], [box.width * cell_m, box.height * cell_m]);
}

// Where the robot shall go: marked on the map, and typed for the button.
function aim(at, text, place) {
  if (!may_steer || has_ended) return;
  target = { at, text };
  element('goto-place').value = place;
  redraw();
}

const metres_in = (text) => /^\s*(-?[\d.]+)\s*,\s*(-?[\d.]+)\s*$/.exec(text)?.slice(1).map(Number);

function aim_at_typed() {
  const text = element('goto-place').value.trim(), at = metres_in(text);
  const landmark = run.shown?.find((one) => text === one.label || text === `L${one.id}`);
  target = at ? { at, text } : landmark ? { at: [landmark.x, landmark.y], text: landmark.label } : null;
  redraw();
}

async function steer(command, body) {
  try {
    const answer = await post(`/api/run/${command}`, body);
    if (answer.ok === false) say(answer.error);
    else if (answer.taken === false) say(`Not taken: ${answer.reason}`);
    else if (answer.taken) { say(`Taken: ${answer.reason}`); target = null; element('goto-place').value = ''; redraw(); }
    else take_status(answer);
  } catch (error) { say(error.message); }
}

function stop_steering() {
  const had_focus = element('steering').contains(document.activeElement);
  for (const one of document.querySelectorAll('#steering button, #steering input')) one.disabled = true;
  if (had_focus) element('status').focus();
}

// What to do next depends on whether the view is still there: that of `run --view` ends with the run.
async function end() {
  has_ended = true;
  stop_steering();
  const how = `${run.status?.mission ?? 'The run'} has ended${run.status?.outcome ? `: ${run.status.outcome}` : ''}.`;
  say(`${how} To browse it: ${settings.command}`);
  await new Promise((done) => setTimeout(done, kRetry_ms));
  const now = await ask_json('/api/view').catch(() => null);
  if (now) say(`${how} Reload this page to browse it.`);
}

// The mission has been killed, or the view has gone, or the way to it is cut.
async function look_after_loss() {
  let now = null;
  try {
    now = await ask_json('/api/view');
  } catch (error) {
    say(error instanceof TypeError ? `The view does not answer any more. If the run is over, browse it by: ${settings.command}` :
        `The connection is lost: ${error.message}. Trying again.`);
  }
  if (now && now.kind !== 'live') {
    has_ended = true;
    stop_steering();
    say(now.kind === 'run' ? 'The run is over. Reload this page to browse it.' :
        `The run is over and has left no report: it was killed. What it has saved: ${settings.command}`);
    return;
  }
  if (now) say('The connection is lost. Trying again.');
  setTimeout(connect, kRetry_ms);
}

function connect() {
  const socket = new WebSocket(`ws://${location.host}/live`, ['cairn.view.1', `token.${token}`]);
  socket.onmessage = (event) => take(JSON.parse(event.data));
  socket.onclose = () => { if (!has_ended) look_after_loss(); };
}

function offer_steering() {
  may_steer = true;
  show_parts('steering');
  for (const command of ['pause', 'resume', 'cancel']) element(command).onclick = () => steer(command, '{}');
  element('goto-place').oninput = aim_at_typed;
  element('goto-form').onsubmit = (event) => {
    event.preventDefault();
    const text = element('goto-place').value.trim();
    steer('order', { goto: metres_in(text) ?? text });
  };
  element('stop').onclick = () => steer('order', { stop: null });
}

export function show_live(view_settings) {
  settings = view_settings;
  document.title = element('name').textContent = settings.name;
  show_parts('clock', 'facts-part', 'tree-part', 'log-part', 'ranges-label', 'truth-label');
  element('show-path').checked = true;
  if (settings.control) offer_steering();
  element('plan-part').hidden = true;
  begin({ draw, show_all, click: (x, y) => aim([x, y], '', `${x.toFixed(2)},${y.toFixed(2)}`) });
  view.scale = 60;
  connect();
}
