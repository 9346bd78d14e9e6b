// A recording in Rerun's viewer, in a browser: node rerun.cjs RECORDING [PICTURE]. Ends with 1 and says what is wrong.
const { createServer } = require('node:http');
const { existsSync, readFileSync } = require('node:fs');
const { extname, join, normalize } = require('node:path');
const { chromium } = require('playwright-core');

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

(async () => {
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  const browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  page.on('console', (message) => { if (process.env.VERBOSE) console.log(message.text()); });
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  await page.waitForFunction(() => window.has_started, null, { timeout: 60000 });
  await page.waitForTimeout(Number(process.env.WAIT_MS ?? 15000));
  if (picture) await page.screenshot({ path: picture });
  await browser.close();
  server.close();
})().catch((error) => { console.error(error.message); process.exit(1); });
