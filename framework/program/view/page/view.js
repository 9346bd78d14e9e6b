// The map of `cairn view`: metres of the map to pixels of the canvas, y up.
const element = (id) => document.getElementById(id);
const fragment = new URLSearchParams(location.hash.slice(1));
if (fragment.get('t')) {
  sessionStorage.setItem('cairn-token', fragment.get('t'));
  history.replaceState(null, '', location.pathname);
}
const headers = { 'X-Cairn-Token': sessionStorage.getItem('cairn-token') ?? '' };

const canvas = element('map');
const context = canvas.getContext('2d', { alpha: false });
const view = { x: 0, y: 0, scale: 40 };  // centre in metres, pixels a metre
let map, landmarks = [], routes = [], clusters = [];
let path = [], ends = [];
const levels = new Map();  // level -> {tiles} or 'loading'
const kTile = 512;
// Okabe and Ito's colours: also told apart by who sees no red or green.
const kColours = ['#d55e00', '#0072b2', '#009e73', '#cc79a7', '#e69f00', '#56b4e9'];
let categories = [];

const say = (text) => { element('status').textContent = text; };

async function ask(target, options = {}) {
  const answer = await fetch(target, { ...options, headers: { ...headers, ...options.headers } });
  if (answer.ok) return answer;
  const { error } = await answer.json().catch(() => ({ error: answer.statusText }));
  throw new Error(error);
}

const to_screen = (x, y) => [canvas.width / 2 + (x - view.x) * view.scale, canvas.height / 2 - (y - view.y) * view.scale];
const to_map = (px, py) => [view.x + (px - canvas.width / 2) / view.scale, view.y - (py - canvas.height / 2) / view.scale];

let asked = false;
function redraw() {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => { asked = false; draw(); });
}

// Known cells from white (free) to black (occupied), others grey.
function tiles_of(bytes, width, height) {
  const tiles = [];
  for (let y = 0; y < height; y += kTile)
    for (let x = 0; x < width; x += kTile) {
      const w = Math.min(kTile, width - x), h = Math.min(kTile, height - y);
      const image = new ImageData(w, h);
      const pixels = new Uint32Array(image.data.buffer);
      for (let row = 0; row < h; ++row)
        for (let column = 0; column < w; ++column) {
          const ol = bytes[(y + row) * width + x + column];
          const grey = ol === 127 ? 176 : 255 - ol;
          pixels[(h - 1 - row) * w + column] = 0xff000000 | grey << 16 | grey << 8 | grey;
        }
      const tile = document.createElement('canvas');
      tile.width = w; tile.height = h;
      tile.getContext('2d').putImageData(image, 0, 0);
      tiles.push({ x, y, w, h, tile });
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
  } catch (error) { say(`The grid cannot be loaded: ${error.message}`); }
}

// The coarsest level whose pixels are no larger than the screen's; until it is there, the nearest that is.
function grid_level() {
  const cells_a_pixel = 1 / (view.scale * map.cell_m);
  const wanted = [...map.levels].reverse().find((level) => level <= cells_a_pixel) ?? map.levels[0];
  load_level(wanted);
  if (Array.isArray(levels.get(wanted))) return wanted;
  return map.levels.find((level) => Array.isArray(levels.get(level)));
}

function draw_grid() {
  if (!map.levels.length) return;
  const level = grid_level();
  if (level === undefined) return;
  const side = level * map.cell_m;
  const left = map.origin_m[0] + map.box.x * map.cell_m, low = map.origin_m[1] + map.box.y * map.cell_m;
  context.imageSmoothingEnabled = false;
  for (const { x, y, w, h, tile } of levels.get(level)) {
    const [px, py] = to_screen(left + x * side, low + (y + h) * side);
    const width = w * side * view.scale, height = h * side * view.scale;
    if (px < canvas.width && py < canvas.height && px + width > 0 && py + height > 0)
      context.drawImage(tile, px, py, width, height);
  }
}

function trace(points) {
  points.forEach(([x, y], i) => context[i ? 'lineTo' : 'moveTo'](...to_screen(x, y)));
}

function draw_lines(lines, colour, width, dash = []) {
  context.beginPath();
  lines.forEach(trace);
  context.strokeStyle = colour; context.lineWidth = width * devicePixelRatio; context.setLineDash(dash);
  context.stroke();
  context.setLineDash([]);
}

// Category by shape and colour, degree by size.
function add_shape(kind, x, y, r) {
  if (kind % 3 === 0) { context.moveTo(x + r, y); context.arc(x, y, r, 0, 7); return; }
  const corners = kind % 3 === 1 ? [[-1, -1], [1, -1], [1, 1], [-1, 1]] : [[0, -1.2], [1.1, 0.8], [-1.1, 0.8]];
  corners.forEach(([cx, cy], i) => context[i ? 'lineTo' : 'moveTo'](x + cx * r, y + cy * r));
  context.closePath();
}

function draw_landmarks() {
  categories.forEach((category, kind) => {
    context.beginPath();
    for (const landmark of landmarks)
      if (landmark.category === category)
        add_shape(kind, ...to_screen(landmark.x, landmark.y), (4 + 5 * landmark.degree) * devicePixelRatio);
    context.fillStyle = kColours[kind % kColours.length]; context.fill();
    context.strokeStyle = '#000'; context.lineWidth = devicePixelRatio; context.stroke();
  });
  if (landmarks.length * 400 > view.scale * view.scale * 40 && landmarks.length > 200) return;
  for (const landmark of landmarks) draw_label(landmark.label, landmark.x, landmark.y);
}

function draw_label(text, x, y) {
  const [px, py] = to_screen(x, y);
  context.font = `${13 * devicePixelRatio}px system-ui, sans-serif`;
  context.lineWidth = 3 * devicePixelRatio; context.strokeStyle = '#fff'; context.fillStyle = '#000';
  context.strokeText(text, px + 11 * devicePixelRatio, py + 5 * devicePixelRatio);
  context.fillText(text, px + 11 * devicePixelRatio, py + 5 * devicePixelRatio);
}

function draw_clusters() {
  const level = Number(element('level').value);
  const at = new Map(landmarks.map((landmark) => [landmark.id, landmark]));
  for (const cluster of clusters.filter((one) => one.level === level)) {
    const anchor = at.get(cluster.anchor);
    if (!anchor) continue;
    draw_lines(cluster.landmarks.map((id) => [[anchor.x, anchor.y], [at.get(id).x, at.get(id).y]]), '#cc79a7', 3, [6, 4]);
    draw_label(cluster.label, anchor.x, anchor.y);
  }
}

function draw_scale_bar() {
  const metres = [0.1, 0.5, 1, 2, 5, 10, 20, 50, 100, 500].find((m) => m * view.scale > 60 * devicePixelRatio) ?? 1000;
  const x = 12 * devicePixelRatio, y = canvas.height - 14 * devicePixelRatio;
  context.fillStyle = '#fff'; context.fillRect(x - 4, y - 22 * devicePixelRatio, metres * view.scale + 8, 30 * devicePixelRatio);
  context.fillStyle = '#000'; context.fillRect(x, y, metres * view.scale, 3 * devicePixelRatio);
  context.font = `${12 * devicePixelRatio}px system-ui, sans-serif`;
  context.fillText(`${metres} m`, x, y - 6 * devicePixelRatio);
}

function draw() {
  if (!map) return;
  context.fillStyle = '#b0b0b0'; context.fillRect(0, 0, canvas.width, canvas.height);
  draw_grid();
  if (element('show-routes').checked) {
    draw_lines(routes.filter((r) => !r.closed && r.driven).map((r) => r.points), '#0072b2', 2);
    draw_lines(routes.filter((r) => !r.closed && !r.driven).map((r) => r.points), '#56b4e9', 1.5, [8, 4]);
    draw_lines(routes.filter((r) => r.closed).map((r) => r.points), '#d55e00', 2, [2, 4]);
  }
  if (element('show-path').checked) draw_lines([map.driven_path], '#009e73', 1.5);
  draw_clusters();
  if (element('show-landmarks').checked) draw_landmarks();
  draw_lines([path], '#fff', 7); draw_lines([path], '#000', 4);
  ends.forEach(([x, y], i) => draw_label(i ? '◎ to' : '● from', x, y));
  draw_scale_bar();
}

function show_all() {
  const box = map.box;
  let low = [map.origin_m[0] + box.x * map.cell_m, map.origin_m[1] + box.y * map.cell_m];
  let size = [box.width * map.cell_m, box.height * map.cell_m];
  if (!map.levels.length && landmarks.length) {
    const xs = landmarks.map((one) => one.x), ys = landmarks.map((one) => one.y);
    low = [xs.reduce((a, b) => Math.min(a, b)) - 1, ys.reduce((a, b) => Math.min(a, b)) - 1];
    size = [xs.reduce((a, b) => Math.max(a, b)) - low[0] + 1, ys.reduce((a, b) => Math.max(a, b)) - low[1] + 1];
  }
  [view.x, view.y] = [low[0] + size[0] / 2, low[1] + size[1] / 2];
  view.scale = Math.min(canvas.width / Math.max(size[0], 1), canvas.height / Math.max(size[1], 1)) * 0.95;
  redraw();
}

function zoom(factor, px = canvas.width / 2, py = canvas.height / 2) {
  const [x, y] = to_map(px, py);
  view.scale = Math.min(Math.max(view.scale * factor, 0.05), 4000);
  view.x = x - (px - canvas.width / 2) / view.scale;
  view.y = y + (py - canvas.height / 2) / view.scale;
  redraw();
}

async function plan() {
  say('Planning.');
  path = [];
  try {
    const body = JSON.stringify({ from: element('from').value, to: element('to').value });
    const reply = await ask('/api/plan', { method: 'POST', body, headers: { 'Content-Type': 'application/json' } });
    const { command, answer } = await reply.json();
    path = (answer.path ?? []).map((pose) => Array.isArray(pose) ? pose : [pose.x, pose.y]);
    element('command').textContent = command;
    element('command').hidden = false;
    say(answer.outcome === 'solved' ? `Solved: ${answer.length_m.toFixed(2)} m.` : `No path: ${answer.outcome.replaceAll('_', ' ')}.`);
  } catch (error) { say(error.message); }
  redraw();
}

function choose(x, y, text = `${x.toFixed(3)},${y.toFixed(3)}`) {
  if (ends.length === 2) clear();
  ends.push([x, y]);
  element(ends.length === 1 ? 'from' : 'to').value = text;
  if (ends.length === 2) plan(); else { say(`From ${text}. Choose where to.`); redraw(); }
}

function clear() {
  ends = []; path = [];
  element('from').value = element('to').value = '';
  element('command').hidden = true;
  redraw();
}

function listen_to_pointers() {
  const pointers = new Map();
  let moved = 0;
  const at = (event) => [event.offsetX * devicePixelRatio, event.offsetY * devicePixelRatio];
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    if (!pointers.size) moved = 0;
    pointers.set(event.pointerId, at(event));
  });
  canvas.addEventListener('pointermove', (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const now = at(event);
    const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
    moved += Math.hypot(now[0] - before[0], now[1] - before[1]);
    if (other) {
      const distance = (p) => Math.max(Math.hypot(p[0] - other[0], p[1] - other[1]), 1);
      zoom(distance(now) / distance(before), ...other);
    } else if (moved > 5 * devicePixelRatio) {
      view.x -= (now[0] - before[0]) / view.scale;
      view.y += (now[1] - before[1]) / view.scale;
    }
    pointers.set(event.pointerId, now);
    redraw();
  });
  canvas.addEventListener('pointerup', (event) => {
    if (pointers.size === 1 && moved <= 5 * devicePixelRatio) choose(...to_map(...at(event)));
    pointers.delete(event.pointerId);
  });
  canvas.addEventListener('pointercancel', (event) => pointers.delete(event.pointerId));
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    zoom(Math.exp(-event.deltaY / 400), ...at(event));
  }, { passive: false });
}

function listen() {
  listen_to_pointers();
  canvas.addEventListener('keydown', (event) => {
    const step = 60 * devicePixelRatio / view.scale;
    const keys = {
      ArrowLeft: () => { view.x -= step; }, ArrowRight: () => { view.x += step; },
      ArrowUp: () => { view.y += step; }, ArrowDown: () => { view.y -= step; },
      '+': () => zoom(1.25), '=': () => zoom(1.25), '-': () => zoom(0.8), 0: show_all,
    };
    if (!keys[event.key] || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    keys[event.key]();
    redraw();
  });
  element('in').onclick = () => zoom(1.25);
  element('out').onclick = () => zoom(0.8);
  element('all').onclick = show_all;
  element('clear').onclick = clear;
  element('plan').onsubmit = (event) => { event.preventDefault(); ends = []; plan(); };
  for (const id of ['show-routes', 'show-landmarks', 'show-path', 'level']) element(id).onchange = redraw;
  new ResizeObserver(() => {
    canvas.width = canvas.clientWidth * devicePixelRatio;
    canvas.height = canvas.clientHeight * devicePixelRatio;
    redraw();
  }).observe(canvas);
}

function list_landmarks() {
  for (const landmark of landmarks) {
    const button = document.createElement('button');
    button.textContent = `${landmark.label}: ${landmark.category || 'place'}, degree ${landmark.degree.toFixed(2)}`;
    button.onclick = () => choose(landmark.x, landmark.y, `L${landmark.id}`);
    const item = document.createElement('li');
    item.append(button);
    element('landmarks').append(item);
  }
}

async function start() {
  const json = async (target) => (await ask(target)).json();
  [map, landmarks, routes, clusters] =
      await Promise.all(['/api/map', '/api/landmarks', '/api/routes', '/api/clusters'].map(json));
  categories = [...new Set(landmarks.map((landmark) => landmark.category))].sort();
  for (const level of [...new Set(clusters.map((cluster) => cluster.level))].sort()) {
    const option = document.createElement('option');
    option.value = option.textContent = level;
    element('level').append(option);
  }
  document.title = element('name').textContent = map.name;
  canvas.width = canvas.clientWidth * devicePixelRatio;
  canvas.height = canvas.clientHeight * devicePixelRatio;
  listen();
  list_landmarks();
  show_all();
  say(map.levels.length ? `${landmarks.length} landmarks, ${routes.length} routes.` : 'The map holds no grid.');
}

start().catch((error) => say(`The map cannot be shown: ${error.message}`));
