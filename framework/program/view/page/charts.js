// Curves over a run's time, each with its latest values as text for those who do not see them.
import { element } from './api.js';
import { kColours } from './symbols.js';

const kWidth = 290, kHeight = 110, kLeft = 38, kLow = 16, kMaxSamples = 2000;

// With the colour by i: 18 curves that differ, neighbours in both.
const dash_of = (i) => (i + Math.floor(i / kColours.length)) % 3;
const nice_above = (value) => [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100].find((one) => one >= value) ?? value;

// unit: of the values; curves: name -> [[time_s, value], ...] by rising time.
export class Chart {
  constructor(title, unit) {
    this.unit = unit; this.curves = new Map();
    const figure = document.createElement('figure');
    this.caption = document.createElement('figcaption');
    this.canvas = document.createElement('canvas');
    this.canvas.setAttribute('role', 'img');
    this.title = title;
    figure.append(this.caption, this.canvas);
    element('charts').append(figure);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.draw(this.end_s, this.at_s));
  }

  add(name, time_s, value) {
    if (!this.curves.has(name)) this.curves.set(name, []);
    const points = this.curves.get(name);
    points.push([time_s, value]);
    if (points.length > kMaxSamples) this.curves.set(name, points.filter((_, i) => i % 2 === 0));
  }

  // at_s: where the time stands now.
  draw(end_s, at_s) {
    Object.assign(this, { end_s, at_s });
    const scale = devicePixelRatio, style = getComputedStyle(document.body);
    this.canvas.width = kWidth * scale; this.canvas.height = kHeight * scale;
    const context = this.canvas.getContext('2d');
    context.scale(scale, scale);
    let top = 0;
    for (const points of this.curves.values()) for (const [, value] of points) top = Math.max(top, value);
    top = nice_above(top);
    const x = (time_s) => kLeft + (kWidth - kLeft - 4) * time_s / Math.max(end_s, 0.1);
    const y = (value) => kHeight - kLow - (kHeight - kLow - 8) * value / top;
    context.fillStyle = style.color; context.strokeStyle = style.color;
    context.font = '11px system-ui, sans-serif';
    context.strokeRect(kLeft, y(top), kWidth - kLeft - 4, y(0) - y(top));
    context.fillText(`${top}`, 2, y(top) + 8); context.fillText('0', 2, y(0));
    context.fillText(`${end_s.toFixed(0)} s`, kWidth - 40, kHeight - 3);
    [...this.curves].forEach(([, points], i) => {
      context.beginPath();
      points.forEach(([time_s, value], k) => context[k ? 'lineTo' : 'moveTo'](x(time_s), y(value)));
      context.strokeStyle = kColours[i % kColours.length]; context.lineWidth = 1.5;
      context.setLineDash([[], [5, 3], [2, 2]][dash_of(i)]);
      context.stroke(); context.setLineDash([]);
    });
    context.beginPath(); context.moveTo(x(at_s), y(top)); context.lineTo(x(at_s), y(0));
    context.strokeStyle = style.color; context.lineWidth = 1; context.stroke();
    this.show_values(at_s);
  }

  show_values(at_s) {
    const texts = [...this.curves].map(([name, points], i) => {
      const last = points.findLast(([time_s]) => time_s <= at_s);
      const text = document.createElement('span');
      text.textContent = `${name} ${last ? last[1].toFixed(3) : '-'}`;
      text.style.borderBottom = `3px ${['solid', 'dashed', 'dotted'][dash_of(i)]} ${kColours[i % kColours.length]}`;
      return text;
    });
    this.caption.replaceChildren(`${this.title}, ${this.unit}: `, ...texts.flatMap((text) => [text, ' ']));
    this.canvas.setAttribute('aria-label', this.caption.textContent);
  }
}
