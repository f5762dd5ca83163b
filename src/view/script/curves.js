// Curves of outputs against time. Values are those of the table, as `flexbody simulate` writes them.

import { palette } from './palette.js';
import { element, roundUp, rounded, set, through } from './svg.js';

const [HEIGHT, LEFT, RIGHT, TOP, BOTTOM] = [150, 58, 10, 12, 32];
/** Height where components have axes of their own. */
const LOW = 100;
/** Most letters of a value beside an axis. */
const MOST_LETTERS = 7;
/** Least part of an axis that a component takes which moves. */
const LEAST = 0.1;
/** Part of its largest value that is roundoff of a column. */
const ROUNDOFF = 1e-9;
/** Part of the largest component that is roundoff of the others. */
const ROUNDOFF_OF_OTHERS = 1e-12;
/** Quantities whose numbers are no components along x, y and z. */
const NO_VECTOR = /_body$|^deflection|stress$|^quaternion$|^orientation$|^natural_frequency$/;
/** Components of a stress. */
const COMPONENTS = ['xx', 'yy', 'zz', 'xy', 'xz', 'yz'];
/** Components in a surface. */
const SURFACE_COMPONENTS = ['11', '22', '12'];
/** Quantities that have these; bending moments do per length. */
const OF_SURFACE = /^membrane_|^curvature$|(bottom|top)_stress$/;
/** Most points of a line; of more, the least and the largest of as many parts are drawn. */
const MOST_POINTS = 1200;

/** Words for the components of a quantity. */
function axesOf(quantity, unit) {
  if (quantity === 'stress_tensor') return COMPONENTS;
  if (OF_SURFACE.test(quantity) || (quantity === 'bending_moment' && unit.endsWith('/m'))) return SURFACE_COMPONENTS;
  return NO_VECTOR.test(quantity) ? [] : ['x', 'y', 'z'];
}

/** Outputs by what they are read at and by what is read: `rope.middle`, `position`, then the columns. */
export function groups(outputs) {
  const found = new Map();
  outputs.forEach(({ name, unit, roundoff }, column) => {
    const whole = name.replace(/(\[\d+\])+$/, '');
    const cut = whole.lastIndexOf('.');
    const [of, quantity] = cut < 0 ? ['', whole] : [whole.slice(0, cut), whole.slice(cut + 1)];
    if (!found.has(of)) found.set(of, new Map());
    const quantities = found.get(of);
    const key = of === 'energy' || of === 'work' ? of : quantity;
    if (!quantities.has(key)) quantities.set(key, { unit, lines: [], isSum: key === of });
    const index = name.slice(whole.length);
    const axes = axesOf(quantity, unit);
    const axis = axes[index.slice(1, -1) - 1];
    const label = key === of ? quantity : axis ?? (index || quantity);
    quantities.get(key).lines.push({ name, column, label, roundoff: roundoff ?? 0 });
  });
  return found;
}

/** Round values between two, each with its text; where these are long, less a common value, whose text is the second result. */
function ticks(low, high, most) {
  const step = roundUp((high - low) / most);
  const values = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1) values.push(k * step);
  if (values.length < 2 && most < 32) return ticks(low, high, 2 * most);
  const less = (base) => values.map((value) => [value, rounded(value - base, step)]);
  const whole = less(0);
  if (whole.every(([, text]) => text.length <= MOST_LETTERS)) return [whole, ''];
  const middle = values.length >> 1;
  return [less(values[middle]), `${whole[middle][1]} +`];
}

/** Values of a column. */
function columnOf({ rows, width, values }, column) {
  return Array.from({ length: rows }, (_, row) => values[row * width + column]);
}

/** Lines of a quantity with their least and largest values; of those that only roundoff moves with the value that they keep. */
function measured(lines, table) {
  const found = lines.map((line) => {
    const finite = columnOf(table, line.column).filter(Number.isFinite);
    if (!finite.length) return { ...line, low: 0, high: 0 };
    return { ...line, low: finite.reduce((a, b) => Math.min(a, b)), high: finite.reduce((a, b) => Math.max(a, b)) };
  });
  const sizeOf = ({ low, high }) => Math.max(Math.abs(low), Math.abs(high));
  const whole = Math.max(...found.map(sizeOf));
  return found.map((line) => {
    const [size, least] = [sizeOf(line), Math.max(line.roundoff, ROUNDOFF_OF_OTHERS * whole)];
    if (line.high - line.low > Math.max(least, ROUNDOFF * size)) return line;
    const constant = size > least ? line.low : 0;
    return { ...line, low: constant, high: constant, constant };
  });
}

/** Lines in groups that share an axis: on it each that moves is seen to move. */
function sharing(lines) {
  const found = [];
  const fits = (lines) => {
    const span = Math.max(...lines.map(({ high }) => high)) - Math.min(...lines.map(({ low }) => low));
    return lines.every(({ constant, low, high }) => constant !== undefined || high - low >= LEAST * span);
  };
  for (const line of lines) {
    const group = found.find((group) => fits([...group, line]));
    if (group) group.push(line);
    else found.push([line]);
  }
  return found;
}

/** One set of axes. */
class Chart {
  constructor(parent, motion, title, lines, height) {
    Object.assign(this, { motion, lines, height });
    this.box = document.createElement('div');
    this.box.className = 'chart';
    parent.append(this.box);
    this.width = Math.max(parent.clientWidth - 4, 240);
    this.svg = element(this.box, 'svg', { width: this.width, height, role: 'img', 'aria-label': `${title} against time` });
    this.legend = document.createElement('div');
    this.legend.className = 'legend';
    this.box.append(this.legend);
    this.draw();
  }

  x(time) {
    const { start, end } = this.motion;
    return LEFT + ((time - start) / (end - start || 1)) * (this.width - LEFT - RIGHT);
  }

  y(value) {
    const [low, high] = this.range;
    return this.height - BOTTOM - ((value - low) / (high - low)) * (this.height - TOP - BOTTOM);
  }

  column(column) {
    return columnOf(this.motion.table, column);
  }

  draw() {
    const { motion, height } = this;
    let low = Math.min(...this.lines.map((line) => line.low));
    let high = Math.max(...this.lines.map((line) => line.high));
    if (!(high - low > ROUNDOFF * Math.max(Math.abs(low), Math.abs(high)))) {
      [low, high] = [low - 0.5 * (Math.abs(low) || 1), high + 0.5 * (Math.abs(high) || 1)];
    }
    const room = 0.06 * (high - low);
    this.range = [low - room, high + room];
    const grid = element(this.svg, 'g', { stroke: palette.grid });
    const texts = element(this.svg, 'g', { fill: palette.number, 'font-size': 10.5 });
    const [values, base] = ticks(...this.range, 4);
    element(texts, 'text', { x: LEFT + 2, y: TOP - 2, class: 'base' }, base);
    for (const [value, text] of values) {
      const y = this.y(value);
      element(grid, 'path', { d: through([[LEFT, y], [this.width - RIGHT, y]]) });
      element(texts, 'text', { x: LEFT - 6, y: y + 3.5, 'text-anchor': 'end' }, text);
    }
    for (const [time, text] of ticks(motion.start, motion.end, 6)[0]) {
      const x = this.x(time);
      element(grid, 'path', { d: through([[x, TOP], [x, height - BOTTOM]]) });
      element(texts, 'text', { x, y: height - BOTTOM + 13, 'text-anchor': 'middle' }, text);
    }
    element(texts, 'text', { x: (LEFT + this.width - RIGHT) / 2, y: height - 4, 'text-anchor': 'middle' }, 't [s]');
    for (const line of this.lines) {
      line.path = element(this.svg, 'path', {
        d: this.path(line), fill: 'none', stroke: line.colour, 'stroke-width': 1.5, 'stroke-linejoin': 'round', 'data-output': line.name,
      });
      const entry = document.createElement('span');
      entry.style.color = line.colour;
      entry.title = line.name;
      line.value = document.createElement('b');
      entry.append(`${line.label} `, line.value);
      this.legend.append(entry);
    }
    this.cursor = element(this.svg, 'path', { stroke: palette.ink, 'stroke-width': 1, 'stroke-opacity': 0.6 });
    this.svg.style.cursor = 'pointer';
  }

  path({ column, constant }) {
    const values = this.column(column);
    if (constant !== undefined) values.fill(constant);
    const times = this.motion.rowTimes;
    const point = (row) => [this.x(times[row]), this.y(values[row])];
    if (values.length <= MOST_POINTS) return through(values.map((_, row) => point(row)));
    const points = [];
    const each = (2 * values.length) / MOST_POINTS;
    for (let part = 0; part * each < values.length; part += 1) {
      const rows = Array.from({ length: Math.min(Math.ceil(each), values.length - Math.floor(part * each)) }, (_, k) => Math.floor(part * each) + k);
      const sorted = rows.sort((a, b) => values[a] - values[b]);
      points.push(...[sorted[0], sorted.at(-1)].sort((a, b) => a - b).map(point));
    }
    return through(points);
  }

  update() {
    const { motion } = this;
    const x = this.x(motion.time);
    set(this.cursor, { d: through([[x, TOP], [x, this.height - BOTTOM]]) });
    const step = 1e-3 * (this.range[1] - this.range[0]);
    for (const { value, column, constant } of this.lines) {
      value.textContent = constant === undefined ? rounded(motion.row[column], step) : `${rounded(constant, 1e-4 * Math.abs(constant))} constant`;
    }
  }
}

/** The curves beside the picture. */
export class Curves {
  constructor(motion, choice, panel, seek) {
    Object.assign(this, { motion, choice, panel, seek });
    this.groups = groups(motion.outputs);
    this.charts = [];
    const add = (label, names) => {
      if (!names.length) return;
      const group = document.createElement('optgroup');
      group.label = label;
      for (const name of names) group.append(new Option(name || 'scene', name));
      choice.append(group);
    };
    const markers = new Set(motion.markers.map((marker) => marker.name));
    const names = [...this.groups.keys()];
    add('Markers', names.filter((name) => markers.has(name)));
    add('Others', names.filter((name) => !markers.has(name)));
    choice.addEventListener('change', () => this.chosen?.(choice.value));
  }

  /** What is shown at first: the marker whose position moves most, or whatever there is. */
  get first() {
    const { rows, width, values } = this.motion.table;
    const span = ({ column }) => {
      let [low, high] = [Infinity, -Infinity];
      for (let row = 0; row < rows; row += 1) {
        low = Math.min(low, values[row * width + column]);
        high = Math.max(high, values[row * width + column]);
      }
      return high - low;
    };
    const moves = (name) => Math.max(...(this.groups.get(name).get('position')?.lines.map(span) ?? [-1]));
    return [...this.groups.keys()].sort((a, b) => moves(b) - moves(a))[0];
  }

  /** Shows the curves of a marker, joint or of the scene. */
  show(name) {
    this.name = name;
    this.charts = [];
    this.panel.replaceChildren();
    const quantities = this.groups.get(name);
    if (!quantities) {
      const note = document.createElement('p');
      note.textContent = name === undefined ? 'The scene has no outputs.' : `No output is read at ${name}.`;
      this.panel.append(note);
      this.choice.selectedIndex = -1;
      return;
    }
    this.choice.value = name;
    for (const [key, quantity] of quantities) this.add(key.replaceAll('_', ' '), quantity);
    this.update();
  }

  /** Charts of a quantity: one, or more where its components differ much in size. */
  add(title, { unit, lines, isSum }) {
    const head = document.createElement('div');
    head.className = 'title';
    head.textContent = unit ? `${title} [${unit}]` : title;
    this.panel.append(head);
    const all = measured(lines, this.motion.table).map((line, number) => ({ ...line, colour: palette.curves[number % palette.curves.length] }));
    const groups = isSum ? [all] : sharing(all);
    for (const group of groups) {
      const chart = new Chart(this.panel, this.motion, title, group, groups.length > 1 ? LOW : HEIGHT);
      chart.svg.addEventListener('click', (event) => {
        const { start, end } = this.motion;
        const part = (event.offsetX - LEFT) / (chart.width - LEFT - RIGHT);
        this.seek(start + Math.min(Math.max(part, 0), 1) * (end - start));
      });
      this.charts.push(chart);
    }
  }

  update() {
    for (const chart of this.charts) chart.update();
  }
}
