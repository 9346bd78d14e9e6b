// Milliseconds between frames of the view's page while its map is moved, in chromium: node frames.cjs ADDRESS [PICTURE]
const { chromium } = require('playwright-core');

const kFrames = 120;

async function measure(page, name) {
  await page.waitForTimeout(3000);  // until the level of detail is there
  const times = await page.evaluate(async (frames) => {
    const canvas = document.getElementById('map');
    const at = [];
    for (let i = 0; i <= frames; ++i) {
      canvas.dispatchEvent(new KeyboardEvent('keydown', { key: i % 2 ? 'ArrowLeft' : 'ArrowRight', cancelable: true }));
      await new Promise((done) => requestAnimationFrame(done));
      at.push(performance.now());
    }
    return at.slice(1).map((time, i) => time - at[i]).sort((a, b) => a - b);
  }, kFrames);
  const part = (ratio) => times[Math.min(Math.floor(ratio * times.length), times.length - 1)].toFixed(1);
  console.log(`| ${name} | ${part(0.5)} | ${part(0.95)} | ${part(1)} |`);
}

async function main() {
  const [address, picture] = process.argv.slice(2);
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium' });
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  await page.goto(address);
  await page.waitForFunction(() => document.getElementById('status').textContent.includes('landmarks,'));
  console.log('| shown | median ms | 95 % | worst |\n|---|---:|---:|---:|');
  for (const name of ['whole map', 'some rooms', 'single cells']) {
    await measure(page, name);
    if (picture) await page.screenshot({ path: picture.replace('.png', `_${name.replace(' ', '_')}.png`) });
    for (let i = 0; i < 8; ++i) await page.click('#in');
  }
  await browser.close();
}

main();
