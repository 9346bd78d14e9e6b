// The page of `cairn view` in a browser: node browser.cjs live|run ADDRESS [PICTURE]. Ends with 1 and says what is wrong.
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
const status_holds = (page, text) => page.waitForFunction(
    (wanted) => document.getElementById('status').textContent.includes(wanted), text, kPatience);
const seconds_of = async (page) => parseFloat(await page.textContent('#clock'));

async function watch(page) {
  await status_holds(page, 'held: running');
  await page.waitForFunction(() => document.querySelector('#tree .running'), null, kPatience);
  await page.waitForFunction(() => parseFloat(document.getElementById('clock').textContent) > 1, null, kPatience);
  check(await colours_of(page) > 20, 'the map is blank');

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
  const end_s = await seconds_of(page);
  await page.locator('#slider').focus();
  await page.keyboard.press('Home');
  check(await seconds_of(page) === 0, 'the slider does not lead to the beginning');
  check((await page.textContent('#tree')).includes('running'), 'nothing runs at the beginning');
  await page.click('#play');
  await page.waitForFunction(() => parseFloat(document.getElementById('clock').textContent) > 2, null, kPatience);
  await page.click('#play');
  await page.locator('#slider').focus();
  await page.keyboard.press('End');
  check(await seconds_of(page) === end_s, 'the slider does not lead to the end');
  check((await page.textContent('#log')).includes('step 1 (explore) begins'), 'the log is empty');
  await page.fill('#from', '0.6,0.6');
  await page.fill('#to', '2,2');
  await page.click('#go');
  await status_holds(page, 'Solved: ');
  if (picture) await page.screenshot({ path: picture });
}

async function main() {
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium' });
  const faults = [];
  try {
    const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
    page.on('pageerror', (error) => faults.push(error.message));
    page.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
    await page.goto(address);
    await (kind === 'live' ? watch : browse)(page);
  } finally {
    await browser.close();
  }
  check(!faults.length, faults.join('\n'));
}

main().catch((error) => {
  console.error(error.message);
  process.exit(1);
});
