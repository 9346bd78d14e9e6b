// The grid in the pieces in which runs tell of it: 64 x 64 cells.
import { draw_picture, new_picture, paint_cells } from './canvas.js';

const kTile = 64;

export const bytes_of = (base64) => Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));

export class Tiles {
  #pictures = new Map();

  take(tx, ty, bytes) {
    const key = `${tx},${ty}`;
    if (!this.#pictures.has(key)) this.#pictures.set(key, { tx, ty, picture: new_picture(kTile, kTile) });
    paint_cells(this.#pictures.get(key).picture, (column, row) => bytes[row * kTile + column]);
  }

  drop(tx, ty) { this.#pictures.delete(`${tx},${ty}`); }

  clear() { this.#pictures.clear(); }

  draw({ cell_m, origin_m }) {
    for (const { tx, ty, picture } of this.#pictures.values())
      draw_picture(picture, origin_m[0] + tx * kTile * cell_m, origin_m[1] + ty * kTile * cell_m, cell_m);
  }
}
