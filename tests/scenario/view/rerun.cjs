// A recording in Rerun's viewer, in a browser: node rerun.cjs RECORDING|--is-there [PICTURE]. Ends with 1 and says what
// is wrong.
const { createServer } = require('node:http');
const { existsSync, readFileSync } = require('node:fs');
const { extname, join, normalize } = require('node:path');
const { chromium } = require('playwright-core');

const kPatience_ms = 180000;
const [recording, picture] = process.argv.slice(2);
const viewer = require.resolve.paths('@rerun-io/web-viewer').map((folder) => join(folder, '@rerun-io/web-viewer')).find(existsSync);
const kPage = `<!doctype html><body style="margin:0"><script type="module">
import { WebViewer } from '/viewer/index.js';
const viewer = new WebViewer();
await viewer.start(location.origin + '/run.mcap', document.body, { width: '100%', height: '100vh', hide_welcome_screen: true });
window.has_started = true;
</script>`;
const kTypes = { '.js': 'text/javascript', '.wasm': 'application/wasm' };

const server = createServer((request, response) => {
  const { pathname } = new URL(request.url, 'http://localhost');
  try {
    if (pathname === '/') { response.writeHead(200, { 'content-type': 'text/html' }); response.end(kPage); return; }
    const file = pathname === '/run.mcap' ? recording : join(viewer, normalize(pathname.slice('/viewer'.length)) + (extname(pathname) ? '' : '.js'));
    const bytes = readFileSync(file);
    response.writeHead(200, { 'content-type': kTypes[extname(file)] ?? 'application/octet-stream' });
    response.end(bytes);
  } catch { response.writeHead(404); response.end(); }
});

// Of the picture's left half, where the viewer draws in space: how much is as free cells are, and how much as occupied.
async function cells_of(page, png) {
  return page.evaluate(async (base64) => {
    const picture = new Image();
    picture.src = `data:image/png;base64,${base64}`;
    await picture.decode();
    const canvas = document.createElement('canvas');
    canvas.width = 380; canvas.height = 530;
    const context = canvas.getContext('2d');
    context.drawImage(picture, -205, -60);
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    let free = 0, occupied = 0;
    for (let i = 0; i < data.length; i += 4) {
      const [red, green, blue] = data.subarray(i, i + 3);
      if (Math.max(red, green, blue) - Math.min(red, green, blue) > 6) continue;  // the space around is coloured
      if (red > 220 && red < 255) ++free;
      if (red < 50) ++occupied;
    }
    return { free, occupied };
  }, png.toString('base64'));
}

(async () => {
  if (recording === '--is-there') {
    if (!viewer) throw new Error('@rerun-io/web-viewer is missing');
    return;
  }
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  const browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  const counter = await browser.newPage();
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  await page.waitForFunction(() => window.has_started, null, { timeout: kPatience_ms });
  let cells = {};
  for (const end = Date.now() + kPatience_ms; Date.now() < end;) {
    const png = await page.screenshot({ path: picture });
    cells = await cells_of(counter, png);
    if (cells.free > 500 && cells.occupied > 50) break;
    await page.waitForTimeout(2000);
  }
  await browser.close();
  server.close();
  console.log(`as free cells are: ${cells.free} pixels, as occupied ones: ${cells.occupied}`);
  if (!(cells.free > 500 && cells.occupied > 50)) throw new Error(`the grid is not drawn: ${JSON.stringify(cells)}`);
})().catch((error) => { console.error(error.message); process.exit(1); });
