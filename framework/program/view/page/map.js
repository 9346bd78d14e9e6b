// A saved map: its grid by levels, landmarks, routes and clusters; plans by two clicks.
import { ask, ask_json, element, post, say } from './api.js';
import { begin, categories_of, draw_landmarks, draw_lines, draw_picture, draw_routes, draw_sign, fit, new_picture, paint_cells, redraw, view } from './canvas.js';
import { draw_clusters, offer_levels } from './clusters.js';

const kTile = 512, kRetry_ms = 5000;
export let map, landmarks = [], routes = [];
let clusters = [], categories = [], marked = null;
let path = [], ends = [];
const levels = new Map();  // level -> tiles, 'loading' or 'failed'

function tiles_of(bytes, width, height) {
  const tiles = [];
  for (let y = 0; y < height; y += kTile)
    for (let x = 0; x < width; x += kTile) {
      const picture = new_picture(Math.min(kTile, width - x), Math.min(kTile, height - y));
      paint_cells(picture, (column, row) => bytes[(y + row) * width + x + column]);
      tiles.push({ x, y, picture });
    }
  return tiles;
}

async function load_level(level) {
  if (levels.has(level)) return;
  levels.set(level, 'loading');
  try {
    const bytes = new Uint8Array(await (await ask(`/api/grid?level=${level}`)).arrayBuffer());
    levels.set(level, tiles_of(bytes, Math.ceil(map.box.width / level), Math.ceil(map.box.height / level)));
    redraw();
  } catch (error) {
    say(`The grid cannot be loaded: ${error.message}`);
    levels.set(level, 'failed');
    setTimeout(() => { levels.delete(level); redraw(); }, kRetry_ms);
  }
}

// The coarsest level whose pixels are no larger than the screen's; until it is there, the nearest that is.
function grid_level() {
  const cells_a_pixel = 1 / (view.scale * map.cell_m);
  const wanted = [...map.levels].reverse().find((level) => level <= cells_a_pixel) ?? map.levels[0];
  load_level(wanted);
  const distance = (level) => Math.abs(Math.log(level / wanted));
  return map.levels.filter((level) => Array.isArray(levels.get(level))).sort((a, b) => distance(a) - distance(b))[0];
}

function draw_grid() {
  if (!map.levels.length) return;
  const level = grid_level();
  if (level === undefined) return;
  const side = level * map.cell_m;
  const left = map.origin_m[0] + map.box.x * map.cell_m, low = map.origin_m[1] + map.box.y * map.cell_m;
  for (const { x, y, picture } of levels.get(level)) draw_picture(picture, left + x * side, low + y * side, side);
}

// shown: the landmarks that are drawn; draw_cells: the grid, where it is another than the saved one.
export function draw_map(shown = landmarks, draw_cells = draw_grid) {
  draw_cells();
  if (element('show-routes').checked) draw_routes(routes);
  if (marked) draw_lines([marked.points], '#e69f00', 5);
  draw_clusters(clusters, landmarks);
  if (element('show-landmarks').checked) draw_landmarks(shown, categories);
}

function draw() {
  draw_map();
  if (element('show-path').checked) draw_lines([map.driven_path], '#009e73', 1.5);
  draw_plan();
}

export function draw_plan() {
  draw_lines([path], '#fff', 7); draw_lines([path], '#000', 4);
  ends.forEach(([x, y], i) => draw_sign(...(i ? ['◎', 'to'] : ['●', 'from']), x, y, true));
}

export function show_all() {
  const box = map.box;
  let low = [map.origin_m[0] + box.x * map.cell_m, map.origin_m[1] + box.y * map.cell_m];
  let size = [box.width * map.cell_m, box.height * map.cell_m];
  if (!map.levels.length && landmarks.length) {
    const xs = landmarks.map((one) => one.x), ys = landmarks.map((one) => one.y);
    low = [xs.reduce((a, b) => Math.min(a, b)) - 1, ys.reduce((a, b) => Math.min(a, b)) - 1];
    size = [xs.reduce((a, b) => Math.max(a, b)) - low[0] + 1, ys.reduce((a, b) => Math.max(a, b)) - low[1] + 1];
  }
  fit(low, size);
}

async function plan() {
  say('Planning.');
  path = [];
  try {
    const { command, answer } = await post('/api/plan', { from: element('from').value, to: element('to').value });
    path = (answer.path ?? []).map((pose) => Array.isArray(pose) ? pose : [pose.x, pose.y]);
    element('command').textContent = command;
    element('command').hidden = false;
    say(answer.outcome === 'solved' ? `Solved: ${answer.length_m.toFixed(2)} m.` : `No path: ${answer.outcome.replaceAll('_', ' ')}.`);
  } catch (error) { say(error.message); }
  redraw();
}

export function choose(x, y, text = `${x.toFixed(3)},${y.toFixed(3)}`) {
  if (ends.length === 2) clear();
  ends.push([x, y]);
  document.dispatchEvent(new CustomEvent('chosen', { detail: { text } }));
  element(ends.length === 1 ? 'from' : 'to').value = text;
  if (ends.length === 2) plan(); else { say(`From ${text}. Choose where to.`); redraw(); }
}

function clear() {
  ends = []; path = [];
  element('from').value = element('to').value = '';
  element('command').hidden = true;
  redraw();
}

const items = new Map();  // id -> {item, button, text, evidence, landmark}

function item_of(id, choose_landmark) {
  if (!items.has(id)) {
    const item = document.createElement('li'), button = document.createElement('button');
    const text = document.createElement('span'), evidence = document.createElement('small');
    button.append(text, evidence);
    item.append(button);
    const one = { item, button, text, evidence };
    button.onclick = () => choose_landmark(one.landmark);
    items.set(id, one);
  }
  return items.get(id);
}

// By rising id. Items stay the same elements, so that the keyboard's focus stays where it is.
export function list_landmarks(list, choose_landmark) {
  const listed = element('landmarks'), ids = new Set(list.map((landmark) => landmark.id));
  for (const [id, { item, button }] of items) {
    if (ids.has(id)) continue;
    const next = item.nextElementSibling ?? item.previousElementSibling;
    if (document.activeElement === button) next?.firstElementChild.focus();
    item.remove();
    items.delete(id);
  }
  list.forEach((landmark, i) => {
    const one = item_of(landmark.id, choose_landmark);
    one.landmark = landmark;
    one.text.textContent = `${landmark.label}: ${landmark.category || 'place'}, degree ${landmark.degree.toFixed(2)}`;
    one.evidence.textContent = (landmark.evidence ?? []).map(([category, matchings, mean]) =>
      `${category}: mean degree ${mean.toFixed(2)} in ${matchings} ${matchings === 1 ? 'matching' : 'matchings'}`).join(', ');
    if (listed.children[i] !== one.item) listed.insertBefore(one.item, listed.children[i] ?? null);
  });
}

export function mark_route(label) {
  marked = routes.find((route) => `R${route.id}` === label) ?? null;
  redraw();
}

// All but the grid, which nothing changes.
export async function load_lists() {
  [landmarks, routes, clusters] = await Promise.all(['/api/landmarks', '/api/routes', '/api/clusters'].map(ask_json));
  categories = categories_of(landmarks);
  if (marked) mark_route(`R${marked.id}`);
  list_landmarks(landmarks, (one) => choose(one.x, one.y, `L${one.id}`));
}

// Without drawing it. Throws when there is no map.
export async function load_map() {
  map = await ask_json('/api/map');
  await load_lists();
  offer_levels(clusters);
  element('clear').onclick = clear;
  element('plan').onsubmit = (event) => { event.preventDefault(); ends = []; plan(); };
}

export async function show_map() {
  await load_map();
  document.title = element('name').textContent = map.name;
  begin({ draw, show_all, click: choose });
  show_all();
  say(map.levels.length ? `${landmarks.length} landmarks, ${routes.length} routes.` : 'The map holds no grid.');
}
