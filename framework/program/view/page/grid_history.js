// The grid of a finished run as it was at any time of it.
import { redraw } from './canvas.js';
import { bytes_of, kTileBytes, Tiles } from './tiles.js';

async function inflated(base64) {
  const stream = new Blob([bytes_of(base64)]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// moments: what had changed at each, [{time_s, tiles: [[x, y]], ol}].
export class GridHistory {
  #moments;
  #tiles = new Tiles();
  #places = new Map();  // "x,y" -> {x, y, changes: [[moment, place in it]], shown: moment or -1}
  #wanted_s = -1;
  #is_busy = false;

  constructor(moments) {
    this.#moments = moments;
    moments.forEach(({ tiles }, moment) => tiles.forEach(([x, y], place) => {
      const key = `${x},${y}`;
      if (!this.#places.has(key)) this.#places.set(key, { x, y, changes: [], shown: -1 });
      this.#places.get(key).changes.push([moment, place]);
    }));
  }

  get is_empty() { return !this.#moments.length; }

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

  async #paint(time_s) {
    const wanted = new Map();  // moment -> [[where, place in it]]
    for (const where of this.#places.values()) {
      const [moment, place] = where.changes.findLast(([one]) => this.#moments[one].time_s <= time_s) ?? [-1, 0];
      if (moment === where.shown) continue;
      where.shown = moment;
      if (moment < 0) { this.#tiles.drop(where.x, where.y); continue; }
      if (!wanted.has(moment)) wanted.set(moment, []);
      wanted.get(moment).push([where, place]);
    }
    for (const [moment, tiles] of wanted) {
      const ol = await inflated(this.#moments[moment].ol);
      for (const [{ x, y }, place] of tiles) this.#tiles.take(x, y, ol.subarray(place * kTileBytes, (place + 1) * kTileBytes));
    }
  }
}
