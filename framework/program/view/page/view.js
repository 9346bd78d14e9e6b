// What the view shows: a saved map, a mission that runs, or one that has ended.
import { ask_json, say } from './api.js';
import { offer_edits } from './edit.js';
import { show_live } from './live.js';
import { map, show_map } from './map.js';
import { show_run } from './timeline.js';

async function start() {
  const settings = await ask_json('/api/view');
  const show = { live: show_live, map: show_map, run: show_run }[settings.kind];
  await show(settings);
  if (settings.edit && map) offer_edits();
}

start().catch((error) => say(`The view cannot be shown: ${error.message}`));
