// Curves of outputs against time. Values are those of the table, as `flexbody simulate` writes them.

import { digits, element, roundUp, set, through } from './svg.js';

const COLOURS = ['#4a78b5', '#c2571a', '#2e7d4f', '#8f4f9e', '#8c8048', '#b3246b', '#4795a3', '#6b737c', '#24292f'];
const [HEIGHT, LEFT, RIGHT, TOP, BOTTOM] = [150, 58, 10, 10, 32];
/** Most points of a line; of more, the least and the largest of as many parts are drawn. */
const MOST_POINTS = 1200;

/** Outputs by what they are read at and by what is read: `rope.middle`, `position`, then the columns. */
export function groups(outputs) {
  const found = new Map();
  outputs.forEach(({ name, unit }, column) => {
    const whole = name.replace(/(\[\d+\])+$/, '');
    const cut = whole.lastIndexOf('.');
    const [of, quantity] = cut < 0 ? ['', whole] : [whole.slice(0, cut), whole.slice(cut + 1)];
    if (!found.has(of)) found.set(of, new Map());
    const quantities = found.get(of);
    const key = of === 'energy' || of === 'work' ? of : quantity;
    if (!quantities.has(key)) quantities.set(key, { unit, lines: [] });
    const label = of === 'energy' || of === 'work' ? quantity : name.slice(whole.length) || quantity;
    quantities.get(key).lines.push({ name, column, label });
  });
  return found;
}

/** Round values between two. */
function ticks(low, high, most) {
  const step = roundUp((high - low) / most);
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1) found.push(k * step);
  return found;
}

/** One set of axes. */
class Chart {
  constructor(parent, motion, title, { unit, lines }) {
    Object.assign(this, { motion, lines });
    this.box = document.createElement('div');
    this.box.className = 'chart';
    parent.append(this.box);
    const head = document.createElement('div');
    head.className = 'title';
    head.textContent = unit ? `${title} [${unit}]` : title;
    this.box.append(head);
    this.width = Math.max(parent.clientWidth - 4, 240);
    this.svg = element(this.box, 'svg', { width: this.width, height: HEIGHT, role: 'img', 'aria-label': `${title} against time` });
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
    return HEIGHT - BOTTOM - ((value - low) / (high - low)) * (HEIGHT - TOP - BOTTOM);
  }

  column(column) {
    const { rows, width, values } = this.motion.table;
    return Array.from({ length: rows }, (_, row) => values[row * width + column]);
  }

  draw() {
    const { motion } = this;
    const series = this.lines.map((line) => this.column(line.column));
    const finite = series.flat().filter(Number.isFinite);
    let low = finite.reduce((a, b) => Math.min(a, b), Infinity);
    let high = finite.reduce((a, b) => Math.max(a, b), -Infinity);
    // What roundoff alone moves is a straight line.
    const least = 1e-9 * Math.max(Math.abs(low), Math.abs(high)) || 1;
    if (!(high - low > least)) [low, high] = [low - 0.5 * (Math.abs(low) || 1), high + 0.5 * (Math.abs(high) || 1)];
    const room = 0.06 * (high - low);
    this.range = [low - room, high + room];
    const grid = element(this.svg, 'g', { stroke: '#e4e8ec' });
    const texts = element(this.svg, 'g', { fill: '#57606a', 'font-size': 10.5 });
    for (const value of ticks(...this.range, 4)) {
      const y = this.y(value);
      element(grid, 'path', { d: through([[LEFT, y], [this.width - RIGHT, y]]) });
      element(texts, 'text', { x: LEFT - 6, y: y + 3.5, 'text-anchor': 'end' }, digits(Math.abs(value) < 1e-9 * (high - low) ? 0 : value, 3));
    }
    for (const time of ticks(motion.start, motion.end, 6)) {
      const x = this.x(time);
      element(grid, 'path', { d: through([[x, TOP], [x, HEIGHT - BOTTOM]]) });
      element(texts, 'text', { x, y: HEIGHT - BOTTOM + 13, 'text-anchor': 'middle' }, digits(time, 3));
    }
    element(texts, 'text', { x: (LEFT + this.width - RIGHT) / 2, y: HEIGHT - 4, 'text-anchor': 'middle' }, 't [s]');
    this.lines.forEach((line, number) => {
      line.colour = COLOURS[number % COLOURS.length];
      line.path = element(this.svg, 'path', {
        d: this.path(series[number]), fill: 'none', stroke: line.colour, 'stroke-width': 1.5, 'stroke-linejoin': 'round', 'data-output': line.name,
      });
      const entry = document.createElement('span');
      entry.style.color = line.colour;
      line.value = document.createElement('b');
      entry.append(`${line.label} `, line.value);
      this.legend.append(entry);
    });
    this.cursor = element(this.svg, 'path', { stroke: '#24292f', 'stroke-width': 1, 'stroke-opacity': 0.6 });
    this.svg.style.cursor = 'pointer';
  }

  path(values) {
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
    set(this.cursor, { d: through([[x, TOP], [x, HEIGHT - BOTTOM]]) });
    for (const line of this.lines) line.value.textContent = digits(motion.row[line.column], 5);
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
    for (const [title, quantity] of quantities) {
      const chart = new Chart(this.panel, this.motion, title.replaceAll('_', ' '), quantity);
      chart.svg.addEventListener('click', (event) => {
        const { start, end } = this.motion;
        const part = (event.offsetX - LEFT) / (chart.width - LEFT - RIGHT);
        this.seek(start + Math.min(Math.max(part, 0), 1) * (end - start));
      });
      this.charts.push(chart);
    }
    this.update();
  }

  update() {
    for (const chart of this.charts) chart.update();
  }
}
