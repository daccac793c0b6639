'use strict';
// A plot drawn at the width that it has on the page. The page holds the same plot as plain SVG, drawn when it was made; this one can be
// zoomed, and letters keep their size. Everything from outside is set as text or attribute, never parsed as markup.

const SVG = 'http://www.w3.org/2000/svg';

// A new element with attributes, at the end of a parent.
function add(parent, name, attributes = {}, text = '') {
  const svg = parent.namespaceURI === SVG || name === 'svg';
  const made = svg ? document.createElementNS(SVG, name) : document.createElement(name);
  for (const key in attributes) made.setAttribute(key, attributes[key]);
  if (text) made.textContent = text;
  parent.appendChild(made);
  return made;
}

// Round values between two, six or so.
function ticks(low, high, about = 6) {
  const raw = (high - low) / about;
  const power = Math.pow(10, Math.floor(Math.log10(raw)));
  const lead = raw / power;
  const step = power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
  const out = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) out.push(k * step);
  return out;
}

const shown = (v, digits = 6) => String(Number(v.toPrecision(digits)));
const isLine = (curve) => curve.style === 'solid' || curve.style === 'dashed';

// A small sign about (x, y), by number, so that curves differ not by colour alone; like the program's of the same number.
function marker(parent, number, x, y, colour) {
  const path = { 1: 'M-3-3h6v6h-6z', 2: 'M0-4l4 7h-8z', 3: 'M0-4l4 4-4 4-4-4z', 4: 'M-3-3l6 6m0-6l-6 6' }[number % 6];
  const place = { transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})` };
  if (path) add(parent, 'path', { ...place, d: path, fill: colour, stroke: number % 6 === 4 ? colour : 'none', 'stroke-width': 2 });
  else if (number % 6 === 5) add(parent, 'circle', { ...place, r: 3.2, fill: '#fff', stroke: colour, 'stroke-width': 1.6 });
  else add(parent, 'circle', { ...place, r: 3.5, fill: colour });
}

class Plot {
  // data: as the page holds it. svg: the element to draw into.
  constructor(svg, data) {
    this.svg = svg;
    this.data = data;
    this.hidden = new Set();
    this.paper = 0; // width to be drawn at for the printer, or 0
    this.full = data.range;
    this.range = [...this.full];
    this.id = 'area' + Plot.count++;
  }

  get zoomed() { return this.range.some((v, k) => v !== this.full[k]); }
  px(v) { return this.left + (v - this.range[0]) / (this.range[1] - this.range[0]) * (this.right - this.left); }
  py(v) { return this.bottom - (v - this.range[2]) / (this.range[3] - this.range[2]) * (this.bottom - this.top); }
  vx(p) { return this.range[0] + (p - this.left) / (this.right - this.left) * (this.range[1] - this.range[0]); }
  vy(p) { return this.range[2] + (this.bottom - p) / (this.bottom - this.top) * (this.range[3] - this.range[2]); }
  visible() { return this.data.curves.filter((c, k) => !this.hidden.has(k)); }

  // Sets the range, but for plots whose axes share a scale, or have rows, as it suits them.
  zoom(range) {
    const [x0, x1, y0, y1] = range;
    const least = (k) => 1e-6 * (this.full[k + 1] - this.full[k]);
    if (!(x1 - x0 > least(0)) || !(y1 - y0 > least(2))) return;
    this.range = this.data.rows.length ? [x0, x1, this.full[2], this.full[3]] : [x0, x1, y0, y1];
    this.draw();
  }

  // By a factor about a place in the picture.
  zoomAt(factor, x, y) {
    const about = [this.vx(x), this.vx(x), this.vy(y), this.vy(y)];
    const next = this.range.map((v, k) => about[k] + (v - about[k]) * factor);
    const whole = next[1] - next[0] >= this.full[1] - this.full[0] && next[3] - next[2] >= this.full[3] - this.full[2];
    this.zoom(whole ? this.full : next);
  }

  pan(dx, dy) {
    const x = this.vx(0) - this.vx(dx);
    const y = this.vy(0) - this.vy(dy);
    this.zoom([this.range[0] + x, this.range[1] + x, this.range[2] + y, this.range[3] + y]);
  }

  reset() { this.zoom(this.full); }

  // Widens the whole view, and the current one with it, to what a new curve needs.
  include(curve) {
    const edge = this.full;
    const reach = [Math.min, Math.max, Math.min, Math.max];
    curve.x.forEach((x, k) => {
      this.full = this.full.map((v, side) => reach[side](v, side < 2 ? x : curve.y[k]));
    });
    const room = [0, 0, 2, 2].map((k) => 0.03 * (this.full[k + 1] - this.full[k])); // so that no sign is cut at the edge
    this.full = this.full.map((v, side) => (v === edge[side] ? v : v + (side % 2 ? 1 : -1) * room[side]));
    this.range = [...this.full];
  }

  layout() {
    const rows = this.data.rows;
    const letter = 7;
    this.width = this.paper || Math.max(240, Math.round(this.svg.parentNode.clientWidth));
    this.height = rows.length ? 96 + 40 * rows.length : Math.round(Math.min(430, Math.max(270, 0.64 * this.width)));
    const [x0, x1, y0, y1] = this.range;
    this.yTicks = rows.length ? rows.map((_, k) => -1 - k) : ticks(y0, y1, this.height > 300 ? 6 : 5);
    const names = rows.length ? rows : this.yTicks.map((v) => shown(v));
    this.left = Math.min(0.45 * this.width, 32 + letter * Math.max(2, ...names.map((n) => n.length)));
    this.top = 12;
    this.right = this.width - 14;
    this.bottom = this.height - 48;
    if (this.data.equal) { // the axis that needs less room gives up the rest of it
      const across = (x1 - x0) / (this.right - this.left);
      const up = (y1 - y0) / (this.bottom - this.top);
      if (across > up) {
        const spare = (this.bottom - this.top) * (1 - up / across);
        this.bottom -= spare;
        this.height -= spare;
      } else {
        this.right = this.left + (x1 - x0) / up;
      }
    }
    this.xTicks = ticks(x0, x1, this.right - this.left < 380 ? 4 : 7);
    this.names = names;
  }

  draw() {
    this.layout();
    const svg = this.svg;
    const keep = [...svg.children].filter((e) => e.tagName === 'desc');
    svg.replaceChildren(...keep);
    svg.setAttribute('viewBox', `0 0 ${this.width} ${this.height}`);
    svg.setAttribute('font-size', 13);
    const area = add(add(svg, 'defs'), 'clipPath', { id: this.id });
    add(area, 'rect', { x: this.left - 1, y: this.top - 6, width: this.right - this.left + 2, height: this.bottom - this.top + 12 });
    this.drawAxes();
    const inside = add(svg, 'g', { 'clip-path': `url(#${this.id})` });
    this.data.curves.forEach((curve, k) => this.hidden.has(k) || this.drawCurve(add(inside, 'g'), curve));
    for (const [x, y] of this.data.marks) {
      add(inside, 'circle', { cx: this.px(x), cy: this.py(y), r: 5, fill: 'none', stroke: '#b03a2e', 'stroke-width': 2 });
    }
    this.above = add(svg, 'g'); // crosshair and selection
  }

  drawAxes() {
    const svg = this.svg;
    for (const v of this.xTicks) {
      const zero = Math.abs(v) < 1e-12;
      add(svg, 'line', { x1: this.px(v), x2: this.px(v), y1: this.bottom, y2: this.top, stroke: zero ? '#8a949e' : '#ddd' });
      add(svg, 'text', { x: this.px(v), y: this.bottom + 18, 'text-anchor': 'middle', fill: '#333' }, shown(v));
    }
    this.yTicks.forEach((v, k) => {
      const y = this.py(v);
      add(svg, 'line', { x1: this.left, x2: this.right, y1: y, y2: y, stroke: v === 0 ? '#8a949e' : '#ddd' });
      add(svg, 'text', { x: this.left - 6, y: y + 4, 'text-anchor': 'end', fill: '#333' }, this.names[k]);
    });
    add(svg, 'text', { x: 0.5 * (this.left + this.right), y: this.height - 10, 'text-anchor': 'middle', fill: '#111' }, this.data.x);
    const turned = `translate(14 ${0.5 * (this.top + this.bottom)}) rotate(-90)`;
    add(svg, 'text', { transform: turned, 'text-anchor': 'middle', fill: '#111' }, this.data.y);
  }

  drawCurve(group, curve) {
    if (curve.style === 'bars') return this.drawBars(group, curve);
    const at = curve.x.map((x, k) => [this.px(x), this.py(curve.y[k])]);
    if (curve.style === 'points') {
      for (const [x, y] of at) marker(group, curve.marker, x, y, curve.colour);
      return undefined;
    }
    const line = { points: at.map(([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`).join(' '), fill: 'none', stroke: curve.colour };
    if (curve.style === 'dashed') line['stroke-dasharray'] = '7 4';
    add(group, 'polyline', { ...line, 'stroke-width': curve.width, 'stroke-linejoin': 'round' });
    const apart = 110;
    let way = apart - 20 - 17 * curve.marker;
    for (let k = 1; curve.marker >= 0 && k < at.length; ++k) {
      way += Math.hypot(at[k][0] - at[k - 1][0], at[k][1] - at[k - 1][1]);
      if (way >= apart) {
        marker(group, curve.marker, at[k][0], at[k][1], curve.colour);
        way = 0;
      }
    }
    return undefined;
  }

  drawBars(group, curve) {
    const bars = this.data.curves.filter((c) => c.style === 'bars');
    const place = bars.indexOf(curve);
    let apart = (this.full[1] - this.full[0]) / 8;
    for (let k = 1; k < curve.x.length; ++k) apart = Math.min(apart, Math.abs(curve.x[k] - curve.x[k - 1]));
    const wide = 0.86 * apart / bars.length;
    curve.x.forEach((x, k) => {
      const from = this.px(x - 0.43 * apart + place * wide);
      const to = this.px(x - 0.43 * apart + (place + 1) * wide);
      const top = this.py(Math.max(0, curve.y[k]));
      const size = { x: from, y: top, width: Math.max(0.5, to - from), height: this.py(Math.min(0, curve.y[k])) - top };
      add(group, 'rect', { ...size, fill: curve.colour, 'fill-opacity': place > 0 ? 0.2 : 0.85, stroke: curve.colour });
    });
  }

  // The point of a curve nearest to a place in the picture. What a curve is at an x is asked more than how near it passes.
  nearest(curve, x, y) {
    let best = -1;
    let least = Infinity;
    for (let k = 0; k < curve.x.length; ++k) {
      const far = (this.px(curve.x[k]) - x) ** 2 + (isLine(curve) ? 0.02 : 0.3) * (this.py(curve.y[k]) - y) ** 2;
      if (far < least) {
        least = far;
        best = k;
      }
    }
    return best;
  }
}
Plot.count = 0;

