// The map's canvas: metres of the map to pixels, y up; and what is drawn on it.
import { element } from './api.js';
import { add_shape, symbol_of } from './symbols.js';

export const canvas = element('map');
export const context = canvas.getContext('2d', { alpha: false });
export const view = { x: 0, y: 0, scale: 40 };  // centre in metres, pixels a metre
const kManyLines = 2000, kMaxRoutes = 5000, kMaxShapes = 2000, kMaxLabels = 200;

// As the program's pictures, continuous on either side of what is unknown: by the byte of a cell.
const kUnknown = 127, kUnknownColour = [200, 204, 208], kOccupiedColour = [22, 27, 34];
const kCellColours = Uint32Array.from({ length: 256 }, (_, ol) => {
  const is_free = ol <= kUnknown, part = is_free ? ol / kUnknown : (ol - kUnknown) / (255 - kUnknown);
  const mixed = kUnknownColour.map((unknown, i) => Math.round(is_free ? 255 + (unknown - 255) * part : unknown + (kOccupiedColour[i] - unknown) * part));
  return 0xff000000 | mixed[2] << 16 | mixed[1] << 8 | mixed[0];
});

let draw_all = () => {};
let show_everything = () => {};
let asked = false;
let has_moved = false;  // by the user, since all was shown

export const to_screen = (x, y) => [canvas.width / 2 + (x - view.x) * view.scale, canvas.height / 2 - (y - view.y) * view.scale];
export const to_map = (px, py) => [view.x + (px - canvas.width / 2) / view.scale, view.y - (py - canvas.height / 2) / view.scale];

export function redraw() {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => {
    asked = false;
    context.fillStyle = `rgb(${kUnknownColour})`; context.fillRect(0, 0, canvas.width, canvas.height);
    draw_all();
    draw_scale_bar();
  });
}

// A picture of cells, white (free) to black (occupied), unknown ones grey; rows rise with y.
export function paint_cells(picture, cell_at) {
  const { width, height } = picture;
  const image = new ImageData(width, height);
  const pixels = new Uint32Array(image.data.buffer);
  for (let row = 0; row < height; ++row)
    for (let column = 0; column < width; ++column)
      pixels[(height - 1 - row) * width + column] = kCellColours[cell_at(column, row)];
  picture.getContext('2d').putImageData(image, 0, 0);
}

export function new_picture(width, height) {
  const picture = document.createElement('canvas');
  picture.width = width; picture.height = height;
  return picture;
}

// Its lowest left corner, and the side of a pixel, in metres.
export function draw_picture(picture, left, low, side) {
  context.imageSmoothingEnabled = false;
  const [px, py] = to_screen(left, low + picture.height * side);
  const width = picture.width * side * view.scale, height = picture.height * side * view.scale;
  if (px < canvas.width && py < canvas.height && px + width > 0 && py + height > 0)
    context.drawImage(picture, px, py, width, height);
}

// One path for all: many strokes take long. Dashes of many lines do too.
export function draw_lines(lines, colour, width, dash = []) {
  const left = canvas.width / 2 - view.x * view.scale, low = canvas.height / 2 + view.y * view.scale;
  context.beginPath();
  for (const points of lines)
    for (let i = 0; i < points.length; ++i) {
      const x = left + points[i][0] * view.scale, y = low - points[i][1] * view.scale;
      if (i) context.lineTo(x, y); else context.moveTo(x, y);
    }
  context.strokeStyle = colour; context.lineWidth = width * devicePixelRatio;
  context.setLineDash(lines.length < kManyLines ? dash : []);
  context.stroke();
  context.setLineDash([]);
}

// What is on the canvas, in metres, and a little beyond.
function box_in_view() {
  const beyond = 40 * devicePixelRatio;
  const [left, low] = to_map(-beyond, canvas.height + beyond), [right, high] = to_map(canvas.width + beyond, -beyond);
  return { left, low, right, high };
}

// Of a route's points; they never change.
function box_of(route) {
  if (!route.box) {
    const box = { left: Infinity, low: Infinity, right: -Infinity, high: -Infinity };
    for (const [x, y] of route.points) {
      box.left = Math.min(box.left, x); box.right = Math.max(box.right, x);
      box.low = Math.min(box.low, y); box.high = Math.max(box.high, y);
    }
    route.box = box;
  }
  return route.box;
}

// So many that they cover each other are left out, until the map is nearer.
export function draw_routes(all_routes) {
  const view_box = box_in_view();
  const routes = all_routes.filter((route) => {
    const box = box_of(route);
    return box.left < view_box.right && box.right > view_box.left && box.low < view_box.high && box.high > view_box.low;
  });
  if (routes.length > kMaxRoutes) return;
  draw_lines(routes.filter((r) => !r.closed && r.driven).map((r) => r.points), '#0072b2', 2);
  draw_lines(routes.filter((r) => !r.closed && !r.driven).map((r) => r.points), '#56b4e9', 1.5, [8, 4]);
  draw_lines(routes.filter((r) => r.closed).map((r) => r.points), '#d55e00', 2, [2, 4]);
}

export const categories_of = (landmarks) => [...new Set(landmarks.map((landmark) => landmark.category))].sort();

// Category by shape and colour, degree by size. Many are dots, without an outline and without their names.
export function draw_landmarks(all_landmarks, categories) {
  const { left, low, right, high } = box_in_view();
  const landmarks = all_landmarks.filter(({ x, y }) => x > left && x < right && y > low && y < high);
  const are_dots = landmarks.length > kMaxShapes, side = 3 * devicePixelRatio;
  for (const category of categories) {
    const { shape, colour } = symbol_of(category);
    context.beginPath();
    for (const landmark of landmarks) {
      if (landmark.category !== category) continue;
      const [x, y] = to_screen(landmark.x, landmark.y);
      if (are_dots) context.rect(Math.round(x), Math.round(y), side, side);
      else add_shape(context, shape, x, y, (4 + 5 * landmark.degree) * devicePixelRatio);
    }
    context.fillStyle = colour; context.fill();
    if (are_dots) continue;
    context.strokeStyle = '#000'; context.lineWidth = devicePixelRatio; context.stroke();
  }
  if (landmarks.length > kMaxLabels) return;
  for (const landmark of landmarks) draw_label(landmark.label, landmark.x, landmark.y);
}

// above: of what lies at its place, whose own label stands beside it.
export function draw_label(text, x, y, above = false) {
  const [px, ground] = to_screen(x, y);
  const py = ground - (above ? 16 * devicePixelRatio : 0);
  context.font = `${13 * devicePixelRatio}px system-ui, sans-serif`;
  context.lineWidth = 3 * devicePixelRatio; context.strokeStyle = '#fff'; context.fillStyle = '#000';
  context.strokeText(text, px + 11 * devicePixelRatio, py + 5 * devicePixelRatio);
  context.fillText(text, px + 11 * devicePixelRatio, py + 5 * devicePixelRatio);
}

// The sign is centred on its point.
export function draw_sign(sign, text, x, y, above = false) {
  const [px, py] = to_screen(x, y);
  context.font = `${17 * devicePixelRatio}px system-ui, sans-serif`;
  context.textAlign = 'center'; context.textBaseline = 'middle';
  context.lineWidth = 3 * devicePixelRatio; context.strokeStyle = '#fff'; context.fillStyle = '#000';
  context.strokeText(sign, px, py); context.fillText(sign, px, py);
  context.textAlign = 'start'; context.textBaseline = 'alphabetic';
  draw_label(text, x, y, above);
}

function draw_scale_bar() {
  const metres = [0.1, 0.5, 1, 2, 5, 10, 20, 50, 100, 500].find((m) => m * view.scale > 60 * devicePixelRatio) ?? 1000;
  const below = element('timeline').hidden ? 14 : 76;
  const x = 12 * devicePixelRatio, y = canvas.height - below * devicePixelRatio;
  context.fillStyle = '#fff'; context.fillRect(x - 4, y - 22 * devicePixelRatio, metres * view.scale + 8, 30 * devicePixelRatio);
  context.fillStyle = '#000'; context.fillRect(x, y, metres * view.scale, 3 * devicePixelRatio);
  context.font = `${12 * devicePixelRatio}px system-ui, sans-serif`;
  context.fillText(`${metres} m`, x, y - 6 * devicePixelRatio);
}

// Shows the box from its lowest corner, in metres, below the tools and above the timeline.
export function fit(low, size) {
  has_moved = false;
  const tools = element('tools'), timeline = element('timeline');
  const above = Math.min((tools.offsetTop + tools.offsetHeight) * devicePixelRatio, canvas.height / 3);
  const below = timeline.hidden ? 0 : (timeline.offsetHeight + 8) * devicePixelRatio;
  view.scale = 0.95 * Math.min(canvas.width / Math.max(size[0], 1), (canvas.height - above - below) / Math.max(size[1], 1));
  [view.x, view.y] = [low[0] + size[0] / 2, low[1] + size[1] / 2 + (above - below) / 2 / view.scale];
  redraw();
}

// After a change of what there is: unless the user has chosen another view.
export function fit_again() {
  if (!has_moved) show_everything();
  redraw();
}

function zoom(factor, px = canvas.width / 2, py = canvas.height / 2) {
  has_moved = true;
  const [x, y] = to_map(px, py);
  view.scale = Math.min(Math.max(view.scale * factor, 0.05), 4000);
  view.x = x - (px - canvas.width / 2) / view.scale;
  view.y = y + (py - canvas.height / 2) / view.scale;
  redraw();
}

function listen_to_pointers(click) {
  const pointers = new Map();
  let moved = 0;
  const at = (event) => [event.offsetX * devicePixelRatio, event.offsetY * devicePixelRatio];
  canvas.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
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
      has_moved = true;
      view.x -= (now[0] - before[0]) / view.scale;
      view.y += (now[1] - before[1]) / view.scale;
    }
    pointers.set(event.pointerId, now);
    redraw();
  });
  canvas.addEventListener('pointerup', (event) => {
    if (!pointers.delete(event.pointerId)) return;
    if (!pointers.size && moved <= 5 * devicePixelRatio) click(...to_map(...at(event)));
  });
  canvas.addEventListener('pointercancel', (event) => pointers.delete(event.pointerId));
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    zoom(Math.exp(-event.deltaY / 400), ...at(event));
  }, { passive: false });
}

// draw: all but the background; show_all: fits what there is; click: at a point of the map.
export function begin({ draw, show_all, click }) {
  draw_all = draw; show_everything = show_all;
  listen_to_pointers(click);
  canvas.addEventListener('keydown', (event) => {
    const step = 60 * devicePixelRatio / view.scale;
    const move = (x, y) => { has_moved = true; view.x += x; view.y += y; };
    const keys = {
      ArrowLeft: () => move(-step, 0), ArrowRight: () => move(step, 0),
      ArrowUp: () => move(0, step), ArrowDown: () => move(0, -step),
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
  for (const box of document.querySelectorAll('#tools input, #tools select')) box.addEventListener('change', redraw);
  canvas.width = canvas.clientWidth * devicePixelRatio;
  canvas.height = canvas.clientHeight * devicePixelRatio;
  new ResizeObserver(() => {
    canvas.width = canvas.clientWidth * devicePixelRatio;
    canvas.height = canvas.clientHeight * devicePixelRatio;
    fit_again();
  }).observe(canvas);
}

// With the ellipse in which it is, of 95 % probability: covariance [xx, xy, yy, tt].
export function draw_robot([x, y, theta], radius_m, colour, covariance) {
  if (covariance) {
    const [xx, xy, yy] = covariance;
    const mean = (xx + yy) / 2, spread = Math.hypot((xx - yy) / 2, xy);
    const axis = (variance) => Math.sqrt(Math.max(variance, 0) * 5.991) * view.scale;
    context.beginPath();
    context.ellipse(...to_screen(x, y), axis(mean + spread), axis(mean - spread), -Math.atan2(2 * xy, xx - yy) / 2, 0, 7);
    context.fillStyle = '#cc79a733'; context.fill();
    context.strokeStyle = '#cc79a7'; context.lineWidth = devicePixelRatio; context.stroke();
  }
  const [px, py] = to_screen(x, y);
  const r = Math.max(radius_m * view.scale, 5 * devicePixelRatio);
  context.beginPath();
  context.arc(px, py, r, 0, 7);
  context.moveTo(px, py); context.lineTo(px + r * Math.cos(theta), py - r * Math.sin(theta));
  context.fillStyle = colour + '88'; context.fill();
  context.strokeStyle = '#000'; context.lineWidth = 2 * devicePixelRatio; context.stroke();
}

// Cones of sonars and rays of lasers: [x, y, angle, half beam, range, state].
export function draw_ranges(ranges) {
  for (const [is_echo, colour] of [[false, '#56b4e9'], [true, '#e69f00']]) {
    context.beginPath();
    for (const [x, y, theta, half, range, state] of ranges) {
      if ((state === 'echo') !== is_echo || state === 'bad' || state === 'too_near') continue;
      const [px, py] = to_screen(x, y);
      const r = range * view.scale;
      context.moveTo(px, py);
      if (half > 0) { context.arc(px, py, r, -theta - half, -theta + half); context.closePath(); }
      else if (is_echo) context.lineTo(px + r * Math.cos(theta), py - r * Math.sin(theta));
    }
    context.strokeStyle = colour; context.lineWidth = devicePixelRatio;
    context.fillStyle = colour + (is_echo ? '44' : '18'); context.fill();
    context.stroke();
  }
}

export function draw_plan(points) {
  if (!points.length) return;
  draw_lines([points], '#fff', 6); draw_lines([points], '#000', 3);
  const [x, y] = points[points.length - 1];
  draw_sign('◎', 'goal', x, y);
}
