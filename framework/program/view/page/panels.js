// The behaviour tree and the log beside the map.
import { element } from './api.js';

const kSigns = { running: '▶', success: '✔', failure: '✖', halted: '◼', waiting: '·' };
const kMaxLines = 500;
let nodes = new Map();  // path -> {item, state, reason}

function item_of(node) {
  const item = document.createElement('li');
  const row = document.createElement('div');
  const state = document.createElement('span');
  state.className = 'state';
  const name = document.createElement('span');
  name.textContent = node.name === node.kind ? node.kind : `${node.kind} "${node.name}"`;
  const more = document.createElement('small');
  row.title = `${node.path}  ${node.settings}`;
  row.append(state, name, more);
  item.append(row);
  nodes.set(node.path, { row, state, more, settings: node.settings });
  show_node(node.path, 'waiting', '');
  if (node.children?.length) {
    const list = document.createElement('ul');
    list.append(...node.children.map(item_of));
    item.append(list);
  }
  return item;
}

export function show_tree(tree) {
  nodes = new Map();
  element('tree').replaceChildren(...tree.map(item_of));
}

export function show_node(path, state, reason) {
  const node = nodes.get(path);
  if (!node) return;
  node.row.className = state;
  node.state.textContent = `${kSigns[state] ?? '?'} ${state === 'waiting' ? '' : state}`;
  node.more.textContent = reason || node.settings;
}

export function clear_nodes() {
  for (const path of nodes.keys()) show_node(path, 'waiting', '');
}

// Sentences of the report begin with their time.
export function event_of(sentence) {
  const found = /^([\d.]+) s: ([^]*)$/.exec(sentence);
  return found ? [Number(found[1]), found[2]] : [0, sentence];
}

function line_of(time_s, sentence) {
  const item = document.createElement('li');
  const time = document.createElement('b');
  time.textContent = `${time_s.toFixed(1)} s`;
  item.append(time, ` ${sentence}`);
  return item;
}

// Keeps the end in sight unless somebody has scrolled up.
export function add_lines(lines, left_out) {
  const log = element('log');
  const is_at_end = log.scrollTop + log.clientHeight > log.scrollHeight - 30;
  if (left_out) log.append(line_of(lines[0]?.[0] ?? 0, `(${left_out} lines left out)`));
  log.append(...lines.map(([time_s, sentence]) => line_of(time_s, sentence)));
  while (log.childElementCount > kMaxLines) log.firstElementChild.remove();
  if (is_at_end) log.scrollTop = log.scrollHeight;
}

export function show_lines(lines) {
  element('log').replaceChildren();
  add_lines(lines.slice(-kMaxLines), 0);
}

export function show_facts(facts) {
  element('facts').replaceChildren(...facts.flatMap(([name, value]) => {
    const term = document.createElement('dt'), text = document.createElement('dd');
    term.textContent = name; text.textContent = value;
    return [term, text];
  }));
}

export function show_parts(...ids) {
  for (const id of ids) element(id).hidden = false;
}
