// The pictures of a run that has ended in docs/view.md: node pictures.cjs ADDRESS FOLDER. Needs playwright-core.
const { chromium } = require('playwright-core');

const [address, folder] = process.argv.slice(2);
const kPictures = [
  { name: 'view_run.png', viewport: { width: 1280, height: 760 }, colorScheme: 'light' },
  { name: 'view_dark.png', viewport: { width: 1280, height: 760 }, colorScheme: 'dark' },
  { name: 'view_phone.png', viewport: { width: 390, height: 844 }, colorScheme: 'light' },
];

(async () => {
  const browser = await chromium.launch({ executablePath: '/usr/bin/chromium' });
  for (const { name, viewport, colorScheme } of kPictures) {
    const page = await browser.newPage({ viewport, colorScheme });
    await page.goto(address);
    await page.waitForFunction(() => document.getElementById('status').textContent.includes('Drag'));
    await page.waitForTimeout(800);
    await page.evaluate(() => {
      const slider = document.getElementById('slider');
      slider.value = Number(slider.max) / 2;
      slider.oninput();
    });
    await page.waitForTimeout(500);
    await page.screenshot({ path: `${folder}/${name}` });
    await page.close();
  }
  await browser.close();
})();
