// What the page's plots do when pointed at, dragged, or steered by keys.

class View {
  constructor(figure) {
    this.figure = figure;
    this.box = figure.querySelector('.drawing');
    this.svg = this.box.querySelector('svg');
    this.title = figure.querySelector('figcaption').textContent;
    this.plot = new Plot(this.svg, JSON.parse(figure.querySelector('script').textContent));
    this.at = null; // curve and point of the cursor
    this.svg.querySelector('title').remove(); // else it pops up over the cursor's values
    this.svg.setAttribute('aria-label', this.title);
    this.readout = add(this.box, 'div', { class: 'readout', 'aria-hidden': 'true' });
    this.readout.hidden = true;
    this.said = add(this.box, 'p', { class: 'unseen', 'aria-live': 'polite' });
    const how = 'Left and right move the cursor, up and down change the curve, plus and minus zoom, zero shows all.';
    const about = { tabindex: 0, role: 'application', 'aria-roledescription': 'interactive plot', 'aria-label': `${this.title} ${how}` };
    for (const key in about) this.box.setAttribute(key, about[key]);
    this.tools();
    this.legend();
    this.pointer();
    this.box.addEventListener('keydown', (event) => this.key(event));
    this.box.addEventListener('blur', () => this.leave());
    let width = 0;
    new ResizeObserver(() => {
      if (Math.abs(this.box.clientWidth - width) > 1) {
        width = this.box.clientWidth;
        this.refresh();
      }
    }).observe(this.box);
    figure.classList.add('live');
    this.refresh();
  }

  refresh() {
    this.plot.draw();
    this.back.hidden = !this.plot.zoomed;
    this.leave();
  }

  tools() {
    const bar = add(this.figure, 'div', { class: 'tools' });
    this.back = add(bar, 'button', { type: 'button' }, 'Show all');
    this.back.addEventListener('click', () => { this.plot.reset(); this.refresh(); this.box.focus(); });
    this.overlays = add(bar, 'div', { class: 'overlays' });
    const { x, y } = this.plot.data;
    if (!x.includes('[') || !y.includes('[')) return; // not something that is measured: it has no unit
    const label = document.createElement('label');
    label.className = 'file';
    label.textContent = 'Overlay a measured curve (CSV) ';
    bar.insertBefore(label, this.overlays);
    const input = add(label, 'input', { type: 'file', accept: '.csv,.txt,.tsv,text/csv' });
    input.addEventListener('change', () => {
      const file = input.files[0];
      if (!file) return;
      file.text().then((text) => overlay(this, file.name, text)).catch((wrong) => {
        add(this.overlays, 'p', { role: 'alert' }, `${file.name} cannot be drawn: ${wrong.message}.`);
      });
      input.value = '';
    });
  }

  legend() {
    for (const entry of this.figure.querySelectorAll('.key li')) {
      const number = Number(entry.dataset.curve);
      const name = this.plot.data.curves[number].name;
      const button = document.createElement('button');
      button.type = 'button';
      button.setAttribute('aria-pressed', 'true');
      button.append(...entry.childNodes);
      entry.append(button);
      button.addEventListener('click', () => {
        const hide = button.getAttribute('aria-pressed') === 'true';
        this.plot.data.curves.forEach((c, k) => { // curves without a name of their own go with the one before
          const own = k === number || (k > number && !c.name && this.plot.data.curves.slice(number + 1, k + 1).every((d) => !d.name));
          if (own && !c.measured) this.plot.hidden[hide ? 'add' : 'delete'](k);
        });
        button.setAttribute('aria-pressed', String(!hide));
        button.title = `${hide ? 'Show' : 'Hide'} ${name}`;
        this.refresh();
      });
    }
  }

  leave() {
    this.readout.hidden = true;
    this.at = null;
    this.plot.above.replaceChildren();
  }

  // Crosshair and values: of every curve the point nearest to a place.
  point(x, y) {
    const plot = this.plot;
    const found = plot.visible().map((curve) => ({ curve, k: plot.nearest(curve, x, y) })).filter(({ k }) => k >= 0);
    if (!found.length) return;
    const far = ({ curve, k }) => Math.hypot(plot.px(curve.x[k]) - x, plot.py(curve.y[k]) - y);
    const first = found.reduce((a, b) => (far(b) < far(a) ? b : a));
    this.show(this.beside(found, first), first);
  }

  // The points that stand about where the first one does; a curve that ends elsewhere has nothing to say there.
  beside(found, first) {
    const at = ({ curve, k }) => this.plot.px(curve.x[k]);
    return found.filter((one) => Math.abs(at(one) - at(first)) < 30);
  }

  show(found, first) {
    const plot = this.plot;
    const place = ({ curve, k }) => [plot.px(curve.x[k]), plot.py(curve.y[k])];
    const [cx, cy] = place(first);
    this.at = first;
    plot.above.replaceChildren();
    add(plot.above, 'line', { x1: cx, x2: cx, y1: plot.top, y2: plot.bottom, stroke: '#555', 'stroke-dasharray': '3 3' });
    if (!plot.data.rows.length) {
      add(plot.above, 'line', { x1: plot.left, x2: plot.right, y1: cy, y2: cy, stroke: '#555', 'stroke-dasharray': '3 3' });
    }
    const near = found.length > 12 ? [first] : found; // of a bundle only the one pointed at
    for (const one of near) {
      const [x, y] = place(one);
      add(plot.above, 'circle', { cx: x, cy: y, r: one === first ? 6 : 4, fill: '#fff', stroke: one.curve.colour, 'stroke-width': 2.5 });
    }
    this.write(near, first);
    const right = cx > 0.5 * plot.width;
    const scale = this.box.clientWidth / plot.width;
    this.readout.hidden = false;
    const left = right ? cx * scale - this.readout.offsetWidth - 14 : cx * scale + 14;
    this.readout.style.left = `${Math.max(0, Math.min(left, this.box.clientWidth - this.readout.offsetWidth))}px`;
    this.readout.style.top = `${Math.max(0, Math.min(cy * scale - 20, plot.height * scale - this.readout.offsetHeight))}px`;
  }

  write(found, first) {
    const { rows, x, y } = this.plot.data;
    this.readout.replaceChildren();
    const table = add(this.readout, 'table');
    const head = add(table, 'tr');
    for (const title of ['', x, rows.length ? '' : y]) add(head, 'th', {}, title);
    for (const { curve, k } of found) {
      const row = add(table, 'tr', curve === first.curve ? { class: 'first' } : {});
      const sign = add(add(row, 'td'), 'svg', { viewBox: '0 0 12 12', 'aria-hidden': 'true' });
      add(sign, 'circle', { cx: 6, cy: 6, r: 5, fill: curve.colour });
      row.firstChild.append(curve.name || rows[Math.round(-curve.y[k]) - 1] || '');
      add(row, 'td', {}, shown(curve.x[k], 5));
      add(row, 'td', {}, rows.length ? '' : shown(curve.y[k], 5));
    }
  }

  pointer() {
    const box = this.box;
    const down = new Map(); // pointers that are down: where they are now
    let start = null;
    const where = (event) => {
      const area = this.svg.getBoundingClientRect();
      const scale = this.plot.width / area.width;
      return [(event.clientX - area.left) * scale, (event.clientY - area.top) * scale];
    };
    const spread = () => {
      const [a, b] = [...down.values()];
      return { far: Math.hypot(a[0] - b[0], a[1] - b[1]), x: 0.5 * (a[0] + b[0]), y: 0.5 * (a[1] + b[1]) };
    };
    this.svg.addEventListener('pointerdown', (event) => {
      down.set(event.pointerId, where(event));
      start = where(event);
      if (event.pointerType === 'mouse') {
        this.svg.setPointerCapture(event.pointerId);
        box.focus({ preventScroll: true });
        event.preventDefault();
      }
    });
    this.svg.addEventListener('pointermove', (event) => {
      const [x, y] = where(event);
      if (down.size === 2 && down.has(event.pointerId)) { // pinch
        const before = spread();
        down.set(event.pointerId, [x, y]);
        const now = spread();
        if (now.far > 10) this.plot.zoomAt(before.far / now.far, now.x, now.y);
        this.back.hidden = !this.plot.zoomed;
      } else if (down.size === 1 && start && event.pointerType === 'mouse') {
        if (event.shiftKey) {
          this.plot.pan(x - start[0], y - start[1]);
          start = [x, y];
          this.back.hidden = !this.plot.zoomed;
        } else {
          this.select(start, [x, y]);
        }
      } else {
        this.point(x, y);
      }
    });
    const up = (event) => {
      const single = down.size === 1 && event.pointerType === 'mouse' && event.type === 'pointerup' && !event.shiftKey;
      down.delete(event.pointerId);
      if (single && start) this.zoomTo(start, where(event));
      else if (event.type === 'pointerup' && event.pointerType !== 'mouse') this.point(...where(event)); // a tap
      if (!down.size) start = null;
    };
    this.svg.addEventListener('pointerup', up);
    this.svg.addEventListener('pointercancel', up);
    this.svg.addEventListener('pointerleave', () => { if (!down.size && document.activeElement !== box) this.leave(); });
    this.svg.addEventListener('dblclick', () => { this.plot.reset(); this.refresh(); });
    // The wheel scrolls the page unless the plot has been clicked, or Ctrl is held.
    box.addEventListener('wheel', (event) => {
      if (!event.ctrlKey && document.activeElement !== box) return;
      event.preventDefault();
      const [x, y] = where(event);
      this.plot.zoomAt(Math.exp(0.0015 * event.deltaY), x, y);
      this.back.hidden = !this.plot.zoomed;
      this.point(x, y);
    }, { passive: false });
  }

  // What a drag selects: a rectangle, or of a flat drag the whole height.
  selection(a, b) {
    const p = this.plot;
    const flat = Math.abs(a[1] - b[1]) < 12;
    const clamp = (v, low, high) => Math.max(low, Math.min(high, v));
    const [x0, x1] = [a[0], b[0]].map((v) => clamp(v, p.left, p.right)).sort((u, v) => u - v);
    const [y0, y1] = flat ? [p.top, p.bottom] : [a[1], b[1]].map((v) => clamp(v, p.top, p.bottom)).sort((u, v) => u - v);
    return [x0, x1, y0, y1];
  }

  select(a, b) {
    const [x0, x1, y0, y1] = this.selection(a, b);
    this.leave();
    add(this.plot.above, 'rect', { x: x0, y: y0, width: x1 - x0, height: y1 - y0, fill: '#1f4e79', 'fill-opacity': 0.12, stroke: '#1f4e79' });
  }

  zoomTo(a, b) {
    const p = this.plot;
    const [x0, x1, y0, y1] = this.selection(a, b);
    if (x1 - x0 > 8) {
      p.zoom([p.vx(x0), p.vx(x1), p.vy(y1), p.vy(y0)]);
      this.refresh();
    } else {
      p.above.replaceChildren();
      this.point(...b);
    }
  }

  key(event) {
    const plot = this.plot;
    const curves = plot.visible().filter((c) => c.x.length);
    if (event.target !== this.box || event.altKey || event.metaKey || !curves.length) return;
    const zoom = { '+': 1 / 1.5, '=': 1 / 1.5, '-': 1.5 }[event.key];
    if (zoom || event.key === '0' || event.key === 'Escape') {
      const kept = this.at;
      const about = kept ? [plot.px(kept.curve.x[kept.k]), plot.py(kept.curve.y[kept.k])] : [0.5 * plot.width, 0.5 * plot.height];
      if (zoom) plot.zoomAt(zoom, ...about);
      else plot.reset();
      this.refresh();
      if (kept) this.show([kept], kept);
      event.preventDefault();
      return;
    }
    const jump = event.shiftKey ? 10 : 1;
    const by = { ArrowLeft: -jump, ArrowRight: jump, ArrowUp: 0, ArrowDown: 0, Home: -Infinity, End: Infinity }[event.key];
    if (by === undefined) return;
    event.preventDefault();
    let { curve, k } = this.at || { curve: curves[0], k: -1 };
    if (by === 0) {
      const next = (curves.indexOf(curve) + (event.key === 'ArrowDown' ? 1 : curves.length - 1)) % curves.length;
      const [x, y] = [plot.px(curve.x[Math.max(0, k)]), plot.py(curve.y[Math.max(0, k)])];
      curve = curves[next];
      k = plot.nearest(curve, x, y);
    } else {
      k = Math.max(0, Math.min(curve.x.length - 1, k + by));
    }
    const [x, y] = [plot.px(curve.x[k]), plot.py(curve.y[k])];
    const others = curves.filter((c) => c !== curve).map((c) => ({ curve: c, k: plot.nearest(c, x, y) })).filter((o) => o.k >= 0);
    const first = { curve, k };
    this.show([first, ...this.beside(others, first)], first);
    const { rows } = plot.data;
    this.said.textContent = `${curve.name || rows[Math.round(-curve.y[k]) - 1] || ''} ${plot.data.x} ${shown(curve.x[k], 5)}`
      + (rows.length ? '' : `, ${plot.data.y} ${shown(curve.y[k], 5)}`);
  }
}

const views = [...document.querySelectorAll('figure.plot')].map((figure) => new View(figure));
function print(paper) { // at a width at which letters are as large on paper as the text beside them
  for (const view of views) {
    view.plot.paper = paper && (view.box.clientWidth > 600 ? 680 : 380);
    view.refresh();
  }
}
addEventListener('beforeprint', () => print(true));
addEventListener('afterprint', () => print(false));
for (const box of document.querySelectorAll('.scroll')) { // reached by the keyboard where they scroll
  if (box.scrollWidth > box.clientWidth) box.tabIndex = 0;
}
for (const hint of document.querySelectorAll('.hint')) hint.hidden = false;
