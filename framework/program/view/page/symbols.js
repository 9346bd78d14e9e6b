// How each category of landmarks looks: a shape and a colour, the same wherever it is drawn.

// Okabe and Ito's colours: also told apart by who sees no red or green.
export const kColours = ['#d55e00', '#0072b2', '#009e73', '#cc79a7', '#e69f00', '#56b4e9'];

const kOwn = { circle: { shape: 'circle', colour: kColours[0] }, square: { shape: 'square', colour: kColours[1] }, triangle: { shape: 'triangle', colour: kColours[2] } };

// count corners on a circle, the first at the top; inner: of a star, the radius between its points.
function polygon(count, radius, inner = null) {
  const corners = inner === null ? count : 2 * count;
  return Array.from({ length: corners }, (_, i) => {
    const r = inner !== null && i % 2 ? inner : radius, angle = 2 * Math.PI * i / corners;
    return [r * Math.sin(angle), -r * Math.cos(angle)];
  });
}

const kCorners = {
  square: [[-1, -1], [1, -1], [1, 1], [-1, 1]], triangle: [[0, -1.2], [1.1, 0.8], [-1.1, 0.8]],
  diamond: polygon(4, 1.35), pentagon: polygon(5, 1.2), star: polygon(5, 1.5, 0.6), hourglass: [[-1, -1.1], [1, -1.1], [-1, 1.1], [1, 1.1]],
};
const kOthers = ['diamond', 'pentagon', 'star', 'hourglass'].flatMap((shape) => kColours.map((colour) => ({ shape, colour })));

const known = new Map(Object.entries(kOwn));

// By the name, so that it is mostly the same on every page; the next free one where two names fall together. Beyond
// 24 categories besides circle, square and triangle, some look alike.
export function symbol_of(category) {
  if (!known.has(category)) {
    let at = 0;
    for (const letter of category) at = (31 * at + letter.codePointAt(0)) % 9973;
    const used = new Set(known.values());
    const free = kOthers.findIndex((_, i) => !used.has(kOthers[(at + i) % kOthers.length]));
    known.set(category, kOthers[(at + Math.max(free, 0)) % kOthers.length]);
  }
  return known.get(category);
}

export function add_shape(context, shape, x, y, r) {
  if (shape === 'circle') { context.moveTo(x + r, y); context.arc(x, y, r, 0, 7); return; }
  kCorners[shape].forEach(([cx, cy], i) => context[i ? 'lineTo' : 'moveTo'](x + cx * r, y + cy * r));
  context.closePath();
}
