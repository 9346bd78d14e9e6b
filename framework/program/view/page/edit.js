// Changes of a saved map: names, closed routes, templates of what stands in it.
import { element, post, say } from './api.js';
import { redraw } from './canvas.js';
import { landmarks, load_lists, mark_route, routes } from './map.js';

const label_of = (id) => landmarks.find((one) => one.id === id)?.label ?? `L${id}`;

function list_routes() {
  const chosen = element('edit-route').value;
  element('edit-route').replaceChildren(...routes.map((route) => {
    const option = document.createElement('option');
    option.value = `R${route.id}`;
    option.textContent = `R${route.id}: ${label_of(route.from)} to ${label_of(route.to)}${route.closed ? ', closed' : ''}`;
    return option;
  }));
  if (routes.some((route) => `R${route.id}` === chosen)) element('edit-route').value = chosen;
}

async function change(what, body, sentence_of) {
  try {
    const answer = await post(`/api/edit/${what}`, body);
    await load_lists();
    list_routes();
    redraw();
    say(sentence_of(answer));
  } catch (error) { say(error.message); }
}

const on_submit = (id, act) => { element(id).onsubmit = (event) => { event.preventDefault(); act(); }; };

function close_or_open(what) {
  const both_ways = element('edit-both').checked;
  change(what, { route: element('edit-route').value, both_ways }, ({ changed }) =>
    changed.length ? `Now ${what === 'close' ? 'closed' : 'open'}: ${changed.map((id) => `R${id}`).join(', ')}.` : 'It was so already.');
}

export function offer_edits() {
  element('edit-part').hidden = false;
  list_routes();
  on_submit('edit-name-form', () => change('name', { what: element('edit-what').value, name: element('edit-name').value },
    ({ id, name }) => name ? `${id} is ${name}.` : `${id} has no name any more.`));
  on_submit('edit-capture-form', () => change('capture',
    { at: element('edit-at').value, category: element('edit-category').value, radius_m: Number(element('edit-radius').value) },
    ({ file, diameter_m }) => `Wrote ${file}: ${diameter_m.toFixed(2)} m across.`));
  element('edit-close').onclick = () => close_or_open('close');
  element('edit-open').onclick = () => close_or_open('open');
  element('edit-route').onchange = () => mark_route(element('edit-route').value);
  document.addEventListener('chosen', ({ detail }) => {
    element('edit-at').value = detail.text;
    if (detail.text.startsWith('L')) element('edit-what').value = detail.text;
  });
}
