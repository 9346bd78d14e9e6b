// The page of `cairn view` in a browser: node browser.cjs live|run|map ADDRESS [PICTURE]. Ends with 1 and says what is wrong.
const { execSync } = require('node:child_process');
const { chromium } = require('playwright-core');

const [kind, address, picture] = process.argv.slice(2);
const kPatience = { timeout: 60000 };

function check(is_right, what) {
  if (!is_right) throw new Error(what);
}

// What is drawn comes later than what is said, on a busy machine much later.
async function comes(page, is_there, what) {
  for (let i = 0; i < 600 && !await is_there(); ++i) await page.waitForTimeout(100);
  check(await is_there(), what);
}

// How many different colours the map has.
const colours_of = (page) => page.evaluate(() => {
  const canvas = document.getElementById('map');
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  return new Set(new Uint32Array(data.buffer)).size;
});
// How much of the map's canvas is free, which is white.
const free_of = (page) => page.evaluate(() => {
  const canvas = document.getElementById('map');
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  return new Uint32Array(data.buffer).filter((pixel) => (pixel & 0xff) > 240).length;
});
// What has been so for two seconds stays.
async function settled_free_of(page) {
  let free = -1;
  for (let same = 0, i = 0; i < 60 && same < 4; ++i) {
    const now = await free_of(page);
    same = now === free ? same + 1 : 0;
    free = now;
    await page.waitForTimeout(500);
  }
  return free;
}

const status_holds = (page, text) => page.waitForFunction(
    (wanted) => document.getElementById('status').textContent.includes(wanted), text, kPatience);
const seconds_of = async (page) => parseFloat(await page.textContent('#clock'));

const focus_of = (page) => page.evaluate(() => document.activeElement.id);
const view_of = (page) => page.evaluate(async () => ({ ...(await import('/view/canvas.js')).view }));
const near = (a, b) => Object.keys(a).every((key) => Math.abs(a[key] - b[key]) <= 1e-6 * Math.max(1, Math.abs(a[key])));

// While the landmarks of a run that goes on change, come and go.
async function keeps_focus_in_list(page) {
  const focused = await page.evaluate(async () => {
    const { list_landmarks } = await import('/view/map.js');
    const one = (id, degree) => ({ id, label: `L${id}`, category: 'circle', degree, evidence: [] });
    const focus = () => document.activeElement.textContent;
    list_landmarks([one(1, 0.5), one(3, 0.5)], () => {});
    document.querySelectorAll('#landmarks button')[1].focus();
    const texts = [];
    list_landmarks([one(1, 0.6), one(2, 0.6), one(3, 0.7)], () => {});
    texts.push(focus());
    list_landmarks([one(1, 0.6), one(2, 0.6)], () => {});
    texts.push(focus());
    list_landmarks([], () => {});
    return texts;
  });
  check(focused[0] === 'L3: circle, degree 0.70' && focused[1] === 'L2: circle, degree 0.60', `the focus in the list: ${focused}`);
}

async function watch(page) {
  await status_holds(page, 'held: running');
  await page.waitForFunction(() => document.querySelector('#tree .running'), null, kPatience);
  await page.waitForFunction(() => parseFloat(document.getElementById('clock').textContent) > 1, null, kPatience);
  await comes(page, async () => await colours_of(page) > 20, 'the map is blank');
  await page.waitForFunction(() => document.getElementById('charts').textContent.includes('Time of a tick'), null, kPatience);

  await page.locator('#pause').focus();
  await page.keyboard.press('Enter');
  await status_holds(page, 'held: paused');
  check(await focus_of(page) === 'resume', 'the focus is lost with a pause');
  await page.waitForFunction(() => document.getElementById('clock').textContent.endsWith(', paused'), null, kPatience);
  const before = await seconds_of(page);
  await page.waitForTimeout(300);
  check(await seconds_of(page) === before, 'the clock goes on in a pause');
  await page.keyboard.press('Enter');
  await status_holds(page, 'held: running');
  check(await focus_of(page) === 'pause', 'the focus is lost when it goes on');

  await page.waitForFunction(() => document.getElementById('tree').textContent.includes('waiting for orders'), null, kPatience);
  await settled_free_of(page);
  const followed = await view_of(page);
  await page.click('#all');
  check(near(followed, await view_of(page)), 'the view has not followed the map that grew');
  const map = await page.locator('#map').boundingBox();
  await page.mouse.click(map.x + map.width / 2, map.y + map.height / 2, { button: 'right' });
  check(await page.inputValue('#goto-place') === '', 'a right click aims');
  await page.mouse.click(map.x + map.width / 2, map.y + map.height / 2);
  check(/^[\d.]+,[\d.]+$/.test(await page.inputValue('#goto-place')), 'a click aims at nothing');
  await page.click('#goto');
  await status_holds(page, 'Taken: ');
  await page.click('#stop');
  await page.waitForFunction(() => document.getElementById('tree').textContent.includes('waiting for orders'), null, kPatience);
  await page.fill('#goto-place', 'no such place');
  await page.press('#goto-place', 'Enter');
  await status_holds(page, 'no such place');
  await page.fill('#goto-place', '1.0, 0.8');
  await page.press('#goto-place', 'Enter');
  await status_holds(page, 'Taken: ');
  await page.waitForTimeout(1500);
  check((await page.textContent('#status')).startsWith('Taken: '), 'the answer to an order does not stay');
  await keeps_focus_in_list(page);
  if (picture) await page.screenshot({ path: picture });
  await page.click('#cancel');
  await status_holds(page, 'has ended: cancelled. To browse it: cairn view ');
}

async function browse(page) {
  await status_holds(page, 'Drag the time');
  await comes(page, async () => await colours_of(page) > 20, 'the map is blank');
  const end_s = await seconds_of(page), free_at_end = await settled_free_of(page);
  await page.locator('#slider').focus();
  await page.keyboard.press('Home');
  await comes(page, async () => await free_of(page) < free_at_end / 2, 'the grid of the beginning is that of the end');
  check(await seconds_of(page) === 0, 'the slider does not lead to the beginning');
  check((await page.textContent('#tree')).includes('running'), 'nothing runs at the beginning');
  await page.click('#play');
  await page.waitForFunction(() => parseFloat(document.getElementById('clock').textContent) > 2, null, kPatience);
  await page.click('#play');
  await page.locator('#slider').focus();
  await page.keyboard.press('End');
  check(await seconds_of(page) === end_s, 'the slider does not lead to the end');
  await comes(page, async () => await free_of(page) === free_at_end, 'the grid of the end does not come back');
  check((await page.textContent('#log')).includes('step 1 (explore) begins'), 'the log is empty');
  check((await page.textContent('#charts figcaption')).startsWith('Error of the pose'), 'no chart of the pose');
  check((await page.textContent('#times')).includes('muriel'), 'no times of the modules');
  await page.fill('#from', '0.6,0.6');
  await page.fill('#to', '2,2');
  await page.click('#go');
  await status_holds(page, 'Solved: ');
  if (picture) await page.screenshot({ path: picture });
}

// What differs from one time to the next.
function without_times(answer) {
  return JSON.parse(JSON.stringify(answer, (key, value) => key.endsWith('_ms') ? undefined : value));
}

// Of the office: two landmarks chosen by the keyboard alone.
async function plan_by_keyboard(page) {
  await page.locator('#map').focus();
  const before = await page.evaluate(() => document.getElementById('map').toDataURL());
  await page.keyboard.press('+');
  await page.keyboard.press('ArrowLeft');
  await page.waitForFunction((was) => document.getElementById('map').toDataURL() !== was, before, kPatience);
  const answered = page.waitForResponse('**/api/plan');
  for (let chosen = 0, i = 0; chosen < 2 && i < 100; ++i) {
    await page.keyboard.press('Tab');
    if (!await page.evaluate(() => document.activeElement.closest('#landmarks') !== null)) continue;
    await page.keyboard.press('Enter');
    ++chosen;
  }
  const { answer } = await (await answered).json();
  check(answer.outcome === 'solved', `the keyboard's plan: ${answer.outcome}`);
  await status_holds(page, 'Solved: ');
  const printed = execSync(await page.textContent('#command'), { encoding: 'utf8' });
  check(JSON.stringify(without_times(JSON.parse(printed))) === JSON.stringify(without_times(answer)),
        `the printed command answers otherwise: ${printed}`);
}

// Circle, square and triangle look the same whatever else there is; so many others differ.
async function has_symbols(page) {
  const { own, others } = await page.evaluate(async () => {
    const { symbol_of } = await import('/view/symbols.js');
    const text = (category) => `${symbol_of(category).shape} ${symbol_of(category).colour}`;
    return { others: Array.from({ length: 18 }, (_, i) => text(`kind_${i}`)), own: ['triangle', 'square', 'circle'].map(text) };
  });
  check(own.every((symbol, i) => symbol.startsWith(['triangle ', 'square ', 'circle '][i])), `symbols: ${own}`);
  check(new Set([...own, ...others]).size === 21, `symbols that are alike: ${others}`);
  const colours = await page.evaluate(async () => {
    const [{ landmarks }, { context, to_screen }] = await Promise.all([import('/view/map.js'), import('/view/canvas.js')]);
    return landmarks.map(({ category, x, y }) => [category, ...context.getImageData(...to_screen(x, y).map(Math.round), 1, 1).data.slice(0, 3)].join(' '));
  });
  for (const wanted of ['circle 213 94 0', 'square 0 114 178', 'triangle 0 158 115'])
    check(colours.includes(wanted), `${wanted} is not among ${colours}`);
}

// Two points of the driven path by clicks; the wheel keeps what is under the pointer, dragging moves by as much.
async function plan_by_mouse(page) {
  await page.click('#clear');
  await page.click('#all');
  const box = await page.locator('#map').boundingBox();
  const [x, y] = [box.x + box.width / 3, box.y + box.height / 2];
  const under = () => page.evaluate(async ([px, py]) => (await import('/view/canvas.js')).to_map(px, py), [x - box.x, y - box.y]);
  const before = await under(), all = await view_of(page);
  await page.mouse.move(x, y);
  await page.mouse.wheel(0, -200);
  await page.waitForFunction(async (scale) => (await import('/view/canvas.js')).view.scale > scale, all.scale, kPatience);
  check(near(await under(), before), 'the wheel moves what is under the pointer');
  const zoomed = await view_of(page);
  await page.mouse.down();
  await page.mouse.move(x + 60, y + 30, { steps: 4 });
  await page.mouse.up();
  const moved = await view_of(page);
  check(near(moved, { x: zoomed.x - 60 / zoomed.scale, y: zoomed.y + 30 / zoomed.scale, scale: zoomed.scale }), 'dragging moves by another way');
  await page.mouse.click(x, y, { button: 'right' });
  check(await page.inputValue('#from') === '', 'dragging or a right click plans');
  await page.click('#all');
  const ends = await page.evaluate(async () => {
    const [{ map }, { to_screen }] = await Promise.all([import('/view/map.js'), import('/view/canvas.js')]);
    return [map.driven_path[0], map.driven_path.at(-1)].map(([at_x, at_y]) => to_screen(at_x, at_y));
  });
  for (const [px, py] of ends) await page.mouse.click(box.x + px, box.y + py);
  check(/^[\d.]+,[\d.]+$/.test(await page.inputValue('#from')), 'the first click chooses nothing');
  await status_holds(page, 'Solved: ');
  await page.click('#clear');
}

async function change(page) {
  await page.fill('#edit-what', 'L1');
  await page.fill('#edit-name', 'pillar_box');
  await page.press('#edit-name', 'Enter');
  await status_holds(page, 'L1 is pillar_box');
  check((await page.textContent('#landmarks')).includes('pillar_box'), 'the list has the old name');
  await page.locator('#edit-route').selectOption({ index: 0 });
  await page.click('#edit-close');
  await status_holds(page, 'Now closed: R');
  check((await page.textContent('#edit-route')).includes(', closed'), 'the route is listed as open');
  await page.click('#edit-open');
  await status_holds(page, 'Now open: R');
  await page.fill('#edit-at', 'L1');
  await page.fill('#edit-category', 'seen');
  await page.press('#edit-category', 'Enter');
  await status_holds(page, 'Wrote ');
  await page.press('#edit-category', 'Enter');
  await status_holds(page, 'there is such a file already');
}

async function look_at_map(page) {
  await comes(page, async () => await colours_of(page) > 20, 'the map is blank');
  await has_symbols(page);
  await plan_by_mouse(page);
  await plan_by_keyboard(page);
  await change(page);

  const background = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await background();
  await page.emulateMedia({ colorScheme: 'dark' });
  check(await background() !== light, 'dark mode changes nothing');
  if (picture) await page.screenshot({ path: picture });
  await page.setViewportSize({ width: 390, height: 844 });
  const sizes = await page.evaluate(() => ({
    map: document.getElementById('map').getBoundingClientRect().height,
    wide: document.documentElement.scrollWidth }));
  check(sizes.map > 300 && sizes.wide <= 390, `on a phone: ${JSON.stringify(sizes)}`);
  if (picture) await page.screenshot({ path: picture.replace('.png', '_phone.png') });
}

async function main() {
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium' });
  const faults = [];
  try {
    const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
    page.on('pageerror', (error) => faults.push(error.message));
    page.on('console', (message) => message.type() === 'error' && !message.text().includes('status of 400') && faults.push(message.text()));
    await page.goto(address);
    await { live: watch, run: browse, map: look_at_map }[kind](page);
  } finally {
    await browser.close();
  }
  check(!faults.length, faults.join('\n'));
}

main().catch((error) => {
  console.error(error.message);
  process.exit(1);
});
