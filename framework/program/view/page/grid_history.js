// The grid of a finished run as it was at any time of it.
import { redraw } from './canvas.js';
import { bytes_of, Tiles } from './tiles.js';

async function inflated(base64) {
  const stream = new Blob([bytes_of(base64)]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// deltas: what had changed at each time, [{time_s, tiles: [[x, y, packed]]}].
export class GridHistory {
  #tiles = new Tiles();
  #places = new Map();  // "x,y" -> {x, y, changes: [[time_s, packed]], shown: one of them}
  #wanted_s = null;
  #is_busy = false;

  constructor(deltas) {
    for (const { time_s, tiles } of deltas)
      for (const [x, y, packed] of tiles) {
        const key = `${x},${y}`;
        if (!this.#places.has(key)) this.#places.set(key, { x, y, changes: [] });
        this.#places.get(key).changes.push([time_s, packed]);
      }
  }

  get is_empty() { return !this.#places.size; }

  draw(frame) { this.#tiles.draw(frame); }

  // Draws again when it has come.
  async show(time_s) {
    this.#wanted_s = time_s;
    if (this.#is_busy) return;
    this.#is_busy = true;
    for (let shown_s = null; shown_s !== this.#wanted_s;) {
      shown_s = this.#wanted_s;
      await this.#paint(shown_s);
      redraw();
    }
    this.#is_busy = false;
  }

  async #paint(at_s) {
    await Promise.all([...this.#places.values()].map(async (place) => {
      const change = place.changes.findLast(([time_s]) => time_s <= at_s);
      if (change === place.shown) return;
      place.shown = change;
      if (change) this.#tiles.take(place.x, place.y, await inflated(change[1]));
      else this.#tiles.drop(place.x, place.y);
    }));
  }
}
