// Clusters of landmarks, of the level that is chosen.
import { element } from './api.js';
import { draw_label, draw_lines } from './canvas.js';

// The levels that there are now; the one that is chosen stays.
export function offer_levels(clusters) {
  const chooser = element('level');
  const levels = [...new Set(clusters.map((cluster) => cluster.level))].sort((a, b) => a - b);
  const offered = [...chooser.options].slice(1).map((option) => Number(option.value));
  if (String(levels) === String(offered)) return;
  const chosen = chooser.value;
  while (chooser.options.length > 1) chooser.remove(1);
  for (const level of levels) chooser.add(new Option(String(level), String(level)));
  chooser.value = levels.includes(Number(chosen)) ? chosen : '0';
}

// Each joined to the landmark that it is named after.
export function draw_clusters(clusters, landmarks) {
  const level = Number(element('level').value);
  if (!level) return;
  const at = new Map(landmarks.map((landmark) => [landmark.id, landmark]));
  for (const cluster of clusters.filter((one) => one.level === level)) {
    const anchor = at.get(cluster.anchor);
    if (!anchor) continue;
    const members = cluster.landmarks.map((id) => at.get(id)).filter((one) => one);
    draw_lines(members.map((one) => [[anchor.x, anchor.y], [one.x, one.y]]), '#cc79a7', 3, [6, 4]);
    draw_label(cluster.label, anchor.x, anchor.y);
  }
}
