// The page of `cairn view` in a browser: node browser.cjs live|run|map ADDRESS [PICTURE]. Ends with 1 and says what is wrong.
const { execSync } = require('node:child_process');
const { chromium } = require('playwright-core');

const [kind, address, picture] = process.argv.slice(2);
const kPatience = { timeout: 60000 };

function check(is_right, what) {
  if (!is_right) throw new Error(what);
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
  return new Uint32Array(data.buffer).filter((pixel) => (pixel & 0xff) > 200).length;
});
const status_holds = (page, text) => page.waitForFunction(
    (wanted) => document.getElementById('status').textContent.includes(wanted), text, kPatience);
const seconds_of = async (page) => parseFloat(await page.textContent('#clock'));

async function watch(page) {
  await status_holds(page, 'held: running');
  await page.waitForFunction(() => document.querySelector('#tree .running'), null, kPatience);
  await page.waitForFunction(() => parseFloat(document.getElementById('clock').textContent) > 1, null, kPatience);
  check(await colours_of(page) > 20, 'the map is blank');
  await page.waitForFunction(() => document.getElementById('charts').textContent.includes('Time of a tick'), null, kPatience);

  await page.click('#pause');
  await status_holds(page, 'held: paused');
  const before = await seconds_of(page);
  await page.waitForTimeout(300);
  check(await seconds_of(page) === before, 'the clock goes on in a pause');
  await page.click('#resume');
  await status_holds(page, 'held: running');

  await page.waitForFunction(() => document.getElementById('tree').textContent.includes('waiting for orders'), null, kPatience);
  const map = await page.locator('#map').boundingBox();
  await page.mouse.click(map.x + map.width / 2, map.y + map.height / 2);
  check((await page.textContent('#goto')).startsWith('Go to '), 'a click aims at nothing');
  await page.click('#goto');
  await status_holds(page, 'Taken: ');
  await page.waitForTimeout(300);
  if (picture) await page.screenshot({ path: picture });
  await page.click('#cancel');
  await status_holds(page, 'has ended: cancelled');
}

async function browse(page) {
  await status_holds(page, 'Drag the time');
  for (let i = 0; i < 100 && await colours_of(page) <= 20; ++i) await page.waitForTimeout(50);
  check(await colours_of(page) > 20, 'the map is blank');
  const end_s = await seconds_of(page), free_at_end = await free_of(page);
  await page.locator('#slider').focus();
  await page.keyboard.press('Home');
  for (let i = 0; i < 100 && await free_of(page) > free_at_end / 2; ++i) await page.waitForTimeout(50);
  check(await free_of(page) < free_at_end / 2, 'the grid of the beginning is that of the end');
  check(await seconds_of(page) === 0, 'the slider does not lead to the beginning');
  check((await page.textContent('#tree')).includes('running'), 'nothing runs at the beginning');
  await page.click('#play');
  await page.waitForFunction(() => parseFloat(document.getElementById('clock').textContent) > 2, null, kPatience);
  await page.click('#play');
  await page.locator('#slider').focus();
  await page.keyboard.press('End');
  check(await seconds_of(page) === end_s, 'the slider does not lead to the end');
  for (let i = 0; i < 100 && await free_of(page) !== free_at_end; ++i) await page.waitForTimeout(50);
  check(await free_of(page) === free_at_end, 'the grid of the end does not come back');
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
  for (let i = 0; i < 100 && await colours_of(page) <= 20; ++i) await page.waitForTimeout(50);
  check(await colours_of(page) > 20, 'the map is blank');
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
