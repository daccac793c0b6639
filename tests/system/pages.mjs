// What a browser finds on pages of results. Started as: node pages.mjs PAGE [CURVE.CSV], with PROVETA_NODE_MODULES and PROVETA_CHROMIUM
// set; writes its findings as JSON. test_pages.py judges them.
import { createRequire } from 'node:module';
import { mkdtempSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const { chromium } = createRequire(join(process.env.PROVETA_NODE_MODULES, 'any.js'))('playwright-core');
const [file, csv] = process.argv.slice(2);
const address = pathToFileURL(file).href;
const profile = mkdtempSync(join(tmpdir(), 'proveta_pages_'));
const found = { errors: [], requests: [], bytes: statSync(file).size };

// Runs within the page: texts whose contrast with what is behind them is below 4.5, and the lowest of all.
function contrasts() {
  const parts = (text) => (text.match(/[\d.]+/g) || []).map(Number);
  const light = (rgb) => {
    const [r, g, b] = rgb.map((v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const behind = (element) => {
    for (let e = element; e; e = e.parentElement) {
      const [r, g, b, a = 1] = parts(getComputedStyle(e).backgroundColor);
      if (a > 0.5) return [r, g, b];
    }
    return [255, 255, 255];
  };
  const low = [];
  let lowest = 21;
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const e = texts.currentNode.parentElement;
    if (!texts.currentNode.textContent.trim() || !e.checkVisibility() || /^(script|style|title|desc)$/i.test(e.tagName)) continue;
    const style = getComputedStyle(e);
    const front = light(parts(e instanceof SVGElement ? style.fill : style.color).slice(0, 3));
    const back = light(behind(e));
    const contrast = (Math.max(front, back) + 0.05) / (Math.min(front, back) + 0.05);
    lowest = Math.min(lowest, contrast);
    if (contrast < 4.5) low.push(`${contrast.toFixed(2)}: ${texts.currentNode.textContent.trim().slice(0, 60)}`);
  }
  return { low, lowest };
}

// Runs within the page: what is asked of its structure.
function structure() {
  const levels = [...document.querySelectorAll('h1,h2,h3,h4')].map((h) => Number(h.tagName[1]));
  const named = (svg) => svg.getAttribute('aria-label') || svg.querySelector(':scope > title')?.textContent;
  const svgs = [...document.querySelectorAll('svg')].filter((s) => s.getAttribute('aria-hidden') !== 'true');
  const small = [...document.querySelectorAll('.live svg[role=img] text')].map((t) => parseFloat(getComputedStyle(t).fontSize)
    * t.ownerSVGElement.getBoundingClientRect().width / t.ownerSVGElement.viewBox.baseVal.width);
  return {
    lang: document.documentElement.lang,
    title: document.title,
    levels,
    mains: document.querySelectorAll('main').length,
    svgs: svgs.length,
    nameless: svgs.filter((s) => s.getAttribute('role') !== 'img' || !named(s) || !s.querySelector('desc')?.textContent).length,
    uncaptioned: [...document.querySelectorAll('main table')].filter((t) => !t.closest('.readout') && !t.caption).length,
    unscoped: [...document.querySelectorAll('main table th')].filter((t) => !t.closest('.readout') && !t.scope).length,
    smallest: Math.min(...small),
    hacked: window.hacked === undefined ? 'no' : 'yes',
  };
}

const ticks = (page, n) => page.evaluate((k) => [...document.querySelectorAll('figure.plot')[k].querySelectorAll('svg text[text-anchor=middle]')]
  .map((t) => t.textContent), n);

// The first plot, used as a reader does.
async function usePlot(page) {
  const out = {};
  const box = page.locator('figure.plot .drawing').first();
  await box.scrollIntoViewIfNeeded();
  const area = await box.boundingBox();
  const middle = [area.x + 0.3 * area.width, area.y + 0.5 * area.height];
  const readout = async () => box.locator('.readout tr').evaluateAll((rows) => rows.slice(1).map((r) => [...r.cells].map((c) => c.textContent)));
  await page.mouse.move(...middle);
  out.hover = await readout();
  out.crosshairs = await box.locator('svg line[stroke-dasharray]').count();
  out.ticks = await ticks(page, 0);
  await page.mouse.wheel(0, 100); // not clicked yet: the page scrolls
  out.unfocused = await ticks(page, 0);
  await page.waitForTimeout(400); // until the page rests
  await box.scrollIntoViewIfNeeded();
  const now = await box.boundingBox();
  const at = [now.x + 0.3 * now.width, now.y + 0.5 * now.height];
  await page.mouse.click(...at);
  await page.mouse.wheel(0, -300);
  await page.waitForTimeout(200);
  out.wheeled = await ticks(page, 0);
  const reset = page.locator('figure.plot .tools button').first(); // there while something is out of view
  await reset.click();
  out.reset = await ticks(page, 0);
  await box.scrollIntoViewIfNeeded();
  const last = await box.boundingBox();
  await page.mouse.move(last.x + 0.3 * last.width, last.y + 0.3 * last.height);
  await page.mouse.down();
  await page.mouse.move(last.x + 0.6 * last.width, last.y + 0.6 * last.height, { steps: 4 });
  await page.mouse.up();
  out.dragged = await ticks(page, 0);
  await box.focus();
  await page.keyboard.press('0');
  out.zeroed = await ticks(page, 0);
  await page.keyboard.press('Home');
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowRight');
  out.keyed = await readout();
  out.said = await box.locator('[aria-live]').textContent();
  const lines = () => box.locator('svg polyline').count();
  out.lines = await lines();
  const entry = page.locator('figure.plot .key button').first();
  if (await entry.count()) {
    await entry.focus();
    await page.keyboard.press('Enter');
    out.fewer = await lines();
    await page.keyboard.press('Enter');
    out.again = await lines();
  }
  if (csv) {
    const marks = () => box.locator('svg g g circle').count();
    const before = await marks();
    await page.locator('figure.plot input[type=file]').first().setInputFiles(csv);
    await page.locator('figure.plot .overlay').first().waitFor();
    out.overlaid = await marks() - before;
    out.factors = await page.locator('figure.plot .overlay input').evaluateAll((all) => all.map((i) => i.value));
    out.columns = await page.locator('figure.plot .overlay select').evaluateAll((all) => all.map((s) => s.selectedOptions[0].textContent));
  }
  return out;
}

const browser = await chromium.launchPersistentContext(profile, {
  executablePath: process.env.PROVETA_CHROMIUM, headless: true, viewport: { width: 1200, height: 900 },
  args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
});
try {
  const page = await browser.newPage();
  page.on('console', (m) => { if (m.type() === 'error' || m.type() === 'warning') found.errors.push(m.text()); });
  page.on('pageerror', (e) => found.errors.push(String(e)));
  page.on('request', (r) => { if (r.url() !== address) found.requests.push(r.url()); });
  await page.goto(address);
  found.structure = await page.evaluate(structure);
  found.contrast = await page.evaluate(contrasts);
  found.width = await page.evaluate(() => document.scrollingElement.scrollWidth);
  if (await page.locator('figure.plot').count()) found.plot = await usePlot(page);
  await page.setViewportSize({ width: 390, height: 844 });
  await page.waitForTimeout(300);
  found.phone = { width: await page.evaluate(() => document.scrollingElement.scrollWidth), ...await page.evaluate(structure) };
  await page.emulateMedia({ media: 'print' });
  found.printed = await page.evaluate(() => [...document.querySelectorAll('.tools, nav, .hint')].filter((e) => e.checkVisibility()).length);
  if (process.env.PROVETA_PICTURES) { // to look at
    await page.emulateMedia({ media: 'screen' });
    await page.screenshot({ path: `${process.env.PROVETA_PICTURES}_phone.png`, fullPage: true });
    await page.setViewportSize({ width: 1200, height: 900 });
    await page.reload();
    await page.waitForTimeout(200);
    await page.screenshot({ path: `${process.env.PROVETA_PICTURES}_desk.png`, fullPage: true });
    await page.emulateMedia({ media: null });
    await page.pdf({ path: `${process.env.PROVETA_PICTURES}.pdf`, preferCSSPageSize: true });
  }
  console.log(JSON.stringify(found));
} finally {
  await browser.close();
  rmSync(profile, { recursive: true, force: true });
}
