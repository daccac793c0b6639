// Measured curves from a file of the reader's, drawn over a plot. The file is read in the browser and goes nowhere.

// Names and columns of numbers of a CSV text: comma, semicolon or tab; '#' begins a remark; decimal commas where the comma does not
// separate. Rows without a number in some column keep NaN there.
function readCsv(text) {
  const lines = text.replace(/^\uFEFF/, '').split(/\r\n|\n|\r/).filter((line) => line.trim() && !line.startsWith('#'));
  if (!lines.length) throw new Error('it has no rows');
  const separator = ['\t', ';', ','].find((s) => lines[0].includes(s)) || /\s+/;
  const cells = (line) => (typeof separator === 'string' && line.includes('"')
    ? (line.match(new RegExp(`("([^"]|"")*"|[^${separator}]*)(${separator}|$)`, 'g')) || []).map((c) => c.endsWith(separator) ? c.slice(0, -1) : c)
    : line.trim().split(separator)).map((c) => c.trim().replace(/^"(.*)"$/, '$1').replace(/""/g, '"'));
  const number = (cell) => (cell === '' ? NaN : Number(separator === ',' ? cell : cell.replace(',', '.')));
  const first = cells(lines[0]);
  const titled = first.some((c) => Number.isNaN(number(c)));
  const rows = lines.slice(titled ? 1 : 0).map((line) => cells(line).map(number));
  const columns = first.map((_, k) => rows.map((row) => (k < row.length ? row[k] : NaN)));
  if (columns.length < 2 || !columns.every((c) => c.length)) throw new Error('it needs two columns of numbers');
  return { names: first.map((c, k) => (titled && c ? c : `column ${k + 1}`)), columns };
}

// From a column's unit, which its name ends with, to that of an axis.
function unitFactor(name, axis) {
  const stress = { Pa: 1e-6, kPa: 1e-3, GPa: 1e3 }[(name.match(/(?:^|[_[( ])([kMG]?Pa)[\])]?$/) || [])[1]];
  if (axis.includes('[MPa]') && stress) return stress;
  return axis.includes('[%]') && /strain/i.test(name) && !/%|percent/i.test(name) ? 100 : 1;
}

// The column whose name has most words in common with an axis; else the one at `otherwise`.
function likeliest(names, axis, otherwise) {
  const words = axis.toLowerCase().match(/[a-z]{3,}/g) || [];
  const common = names.map((n) => words.filter((w) => n.toLowerCase().includes(w)).length - 0.01 * n.length);
  const best = common.indexOf(Math.max(...common));
  return common[best] > 0.5 ? best : otherwise;
}

// Adds a file to a plot, with a line of controls: which columns, times what, and away with it.
function overlay(view, file, text) {
  const { names, columns } = readCsv(text);
  const plot = view.plot;
  const colours = ['#111111', '#8e1b6b', '#00695c', '#7a4b00'];
  const number = plot.data.curves.filter((c) => c.measured).length;
  const curve = { name: file, colour: colours[number % colours.length], style: 'points', marker: (number + 5) % 6, width: 1.8, measured: true, x: [], y: [] };
  const line = add(view.overlays, 'div', { class: 'overlay' });
  marker(add(line, 'svg', { viewBox: '0 0 14 14', width: 14, height: 14, 'aria-hidden': 'true' }), curve.marker, 7, 7, curve.colour);
  add(line, 'b', {}, file);
  const choice = (axis, preset) => {
    const label = add(line, 'label', {}, axis === 'x' ? 'across ' : 'up ');
    const select = add(label, 'select');
    names.forEach((name, k) => add(select, 'option', { value: k }, name));
    select.value = preset;
    const times = add(add(line, 'label', {}, 'times '), 'input', { type: 'text', inputmode: 'decimal', size: 6 });
    times.value = unitFactor(names[preset], plot.data[axis]);
    select.addEventListener('change', () => { times.value = unitFactor(names[select.value], plot.data[axis]); take(); });
    times.addEventListener('change', () => take());
    return () => columns[select.value].map((v) => v * Number(times.value));
  };
  const x = likeliest(names, plot.data.x, 0);
  const across = choice('x', x);
  const up = choice('y', likeliest(names.map((n, k) => (k === x ? '' : n)), plot.data.y, x === 1 ? 0 : 1));
  const remove = add(line, 'button', { type: 'button' }, 'Remove');
  remove.addEventListener('click', () => {
    plot.data.curves.splice(plot.data.curves.indexOf(curve), 1);
    line.remove();
    view.refresh();
  });
  const take = () => {
    const xs = across();
    const ys = up();
    const good = xs.map((v, k) => k).filter((k) => Number.isFinite(xs[k]) && Number.isFinite(ys[k]));
    const every = Math.ceil(good.length / 1500); // more signs than pixels help nobody
    const kept = good.filter((_, k) => k % every === 0);
    curve.x = kept.map((k) => xs[k]);
    curve.y = kept.map((k) => ys[k]);
    plot.include(curve);
    view.refresh();
  };
  plot.data.curves.push(curve);
  take();
}

