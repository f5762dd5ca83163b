// What is drawn over the picture: symbols, forces, paths, names. Sizes are in pixels, symbols those of the page's header.

import { Vector3 } from 'three';
import { colourOf } from './bodies.js';
import { palette } from './palette.js';
import { Drawn, moved, unit } from './strokes.js';
import { digits, element, roundUp, set, through } from './svg.js';

/** Size of a unit of symbols, pixels. */
const UNIT = 10;
/** Length of the longest arrow, pixels. */
const LONGEST = 72;
/** Length of an arrow from which on its head has its full size, pixels. */
const FULL = 14;
/** Part of the largest reaction below which one is none. */
const NONE = 1e-6;
/** With more markers than this, their names are left to the pointer. */
const MOST_NAMES = 16;
/** Ways from a point that its name is tried at, best first. */
const SIDES = [
  [1, -1], [1, 1], [-1, -1], [-1, 1], [0, -1.5], [0, 1.6], [1.2, 0], [-1.2, 0], [1, -2.4], [1, 2.4], [-1, -2.4], [-1, 2.4], [0, -3], [0, 3],
];

/** Everything over the picture. */
export class Marks {
  constructor(motion, layer, project) {
    Object.assign(this, { motion, project, layer });
    this.groups = {};
    for (const name of ['paths', 'joints', 'loads', 'reactions', 'markers', 'names']) {
      this.groups[name] = element(layer, 'g', { class: name });
    }
    this.paths = motion.markers.map((marker) => element(this.groups.paths, 'path', {
      fill: 'none', stroke: colourOf(marker.body ?? 0), 'stroke-width': 1.2, 'stroke-opacity': 0.55,
    }));
    this.ways = this.wayOfMarkers();
    this.symbols = motion.marks.map(({ name, kind, symbol }) => new Drawn(this.groups.joints, motion.symbols[symbol], `${name} (${kind})`));
    this.arrows = motion.actions.map((action) => {
      const group = element(action.is_reaction ? this.groups.reactions : this.groups.loads, 'g');
      return { group, parts: [] };
    });
    this.scales = this.longest();
    this.dots = motion.markers.map((marker, number) => {
      const dot = element(this.groups.markers, 'circle', { r: 3.2, fill: palette.ink, 'data-marker': marker.name });
      element(dot, 'title', {}, marker.name);
      dot.addEventListener('click', () => this.picked?.(number));
      dot.style.cursor = 'pointer';
      return dot;
    });
    this.values = motion.actions.map((action) => action.is_reaction && this.valueOf(action));
    this.names = [...this.values.filter(Boolean), ...this.namesOf()];
    this.selected = -1;
    // Boxes that no name takes: of the axes, and of a scale of colours.
    this.reserved = [];
  }

  /** Where markers go, in space. */
  wayOfMarkers() {
    const { motion } = this;
    const now = motion.time;
    const ways = motion.markers.map(() => []);
    for (const time of motion.times) {
      motion.seek(time);
      ways.forEach((way, number) => way.push(motion.place(number)));
    }
    motion.seek(now);
    return ways;
  }

  /** The largest of what acts, loads and reactions apart, forces and moments apart. */
  longest() {
    const { motion } = this;
    const found = {};
    motion.actions.forEach((action, number) => {
      const { values } = motion.tracks[action.track];
      const key = this.keyOf(action);
      for (let k = 0; k < values.length; k += action.components) {
        found[key] = Math.max(found[key] ?? 0, Math.hypot(...values.subarray(k, k + action.components)));
      }
    });
    return found;
  }

  keyOf(action) {
    return `${action.is_reaction ? 'reaction' : 'load'} ${action.unit}`;
  }

  /** Sizes of the longest arrows, in words: of loads, of reactions. */
  inWords(isReaction) {
    const keys = Object.keys(this.scales).filter((key) => key.startsWith(isReaction ? 'reaction' : 'load') && this.scales[key] > 0);
    return keys.map((key) => `${digits(this.scales[key], 3)}\u2009${key.slice(key.indexOf(' ') + 1)}`).join(', ');
  }

  /** The size of a reaction, to be written at the tip of its arrow. */
  valueOf(action) {
    const label = element(this.groups.reactions, 'text', { fill: palette.reaction, 'font-size': 12 });
    return { label, side: 0, place: () => this.motion.place(action.marker), text: '' };
  }

  namesOf() {
    const { motion } = this;
    const named = [];
    const add = (text, colour, place, rank) => {
      const label = element(this.groups.names, 'text', { fill: colour, 'font-size': 12 }, text);
      named.push({ label, place, rank, side: 0, text });
    };
    motion.bodies.forEach((body, number) => {
      add(body.name, colourOf(number), () => (body.lengths ? body.section(Math.floor(body.lengths.length / 3), 0.5).point : body.vector(0, 0)), 1);
    });
    for (const { name, colour, ends, label } of motion.marks.filter((mark) => mark.label)) {
      const middle = () => motion.endOf(ends[0]).add(motion.endOf(ends[1])).multiplyScalar(0.5);
      add(name, colour, label === 'middle' ? middle : () => motion.endOf(ends[1]), 3);
    }
    (motion.surfaces ?? []).forEach(({ name, body, lines }) => {
      const line = lines[lines.length >> 1];
      const [point, owner] = [line[line.length >> 1], motion.bodies[body]];
      add(name, palette.faint, () => (owner ? motion.pointOf(owner, { point }) : new Vector3(...point)), 3);
    });
    const markers = motion.markers.map((marker, number) => ({ marker, number }));
    if (markers.length <= MOST_NAMES) {
      for (const { marker, number } of markers) add(motion.bodies.length > 1 ? marker.name : marker.label, palette.ink, () => motion.place(number), 2);
    }
    return named.sort((a, b) => a.rank - b.rank);
  }

  /** Draws anew what stands still: after the view has changed. */
  updatePaths() {
    this.ways.forEach((way, number) => {
      const points = [];
      for (const place of way) {
        const point = this.project(place);
        const last = points.at(-1);
        if (!last || Math.hypot(point[0] - last[0], point[1] - last[1]) > 0.7) points.push(point);
      }
      set(this.paths[number], { d: points.length > 2 ? through(points) : '', 'stroke-width': number === this.selected ? 2.4 : 1.2 });
    });
  }

  update() {
    const { motion } = this;
    this.points = motion.markers.map((_, number) => this.project(motion.place(number)));
    this.points.forEach(([x, y], number) => {
      const chosen = number === this.selected;
      set(this.dots[number], { cx: x.toFixed(1), cy: y.toFixed(1), r: chosen ? 6 : 3.2, fill: chosen ? palette.load : palette.ink });
    });
    motion.marks.forEach((mark, number) => this.symbols[number].draw(this.placed(mark)));
    motion.actions.forEach((action, number) => this.updateAction(action, number));
    this.placeNames();
  }

  /** Where a symbol is. */
  placed(mark) {
    const { motion, pixel } = this;
    const ends = mark.ends.map((end) => this.project(motion.endOf(end)));
    const along = this.along(mark, ends[1]);
    return {
      ends,
      along,
      pixel,
      unit: UNIT,
      travel: () => this.travel(mark, ends, unit(along)),
      limit: (limit) => this.project(motion.endOf(mark.ends[0]).addScaledVector(motion.direction(mark), limit)),
      seen: (direction) => this.seen(motion.endOf(mark.ends[1]), new Vector3(...direction), ends[1]),
    };
  }

  /** How a symbol's direction, or that of its second marker, is seen: of length one where it lies in the image. */
  along(mark, second) {
    const { motion } = this;
    let direction = motion.direction(mark);
    if (!direction) {
      const { marker } = mark.ends[1];
      direction = new Vector3(1, 0, 0);
      if (marker !== undefined) direction.applyQuaternion(motion.stanceAt(marker));
    }
    return this.seen(motion.endOf(mark.ends[1]), direction, second);
  }

  /** How a direction at a place, which is at a point of the image, is seen. */
  seen(place, direction, point) {
    const tip = this.project(place.clone().addScaledVector(direction, this.pixel * 100));
    return [(tip[0] - point[0]) / 100, (tip[1] - point[1]) / 100];
  }

  /** The ends of the way of a second end along a direction: on the ground in the whole run, else where it is. */
  travel({ ends: [ground, { marker }] }, [first, second], way) {
    if (ground.point === undefined) return [second, second];
    const along = this.ways[marker].map((place) => this.project(place)).map(([x, y]) => (x - first[0]) * way[0] + (y - first[1]) * way[1]);
    return [Math.min(...along), Math.max(...along)].map((end) => moved(first, way, end));
  }

  updateAction(action, number) {
    const { group, parts } = this.arrows[number];
    if (group.parentNode.style.display === 'none') return;
    const longest = this.scales[this.keyOf(action)];
    const found = longest > 0 ? this.motion.vectors(number) : [];
    while (parts.length < found.length) parts.push(new Drawn(group, this.motion.symbols[action.symbol], action.name));
    found.forEach(({ at, vector }, k) => parts[k].draw(this.arrow(action, at, vector, longest)));
    const value = this.values[number];
    if (value) this.write(value, found[0], action, longest);
  }

  /** Writes how large a reaction is. */
  write(value, found, action, longest) {
    const size = found?.vector.length() ?? 0;
    const text = size > NONE * longest ? `${digits(size, 3)}\u2009${action.unit}` : '';
    if (text !== value.text) {
      Object.assign(value, { text, width: undefined });
      value.label.textContent = text;
    }
    const reach = action.is_moment && this.motion.dimension === 2 ? 0 : (this.pixel * LONGEST) / longest;
    if (text) value.place = () => found.at.clone().addScaledVector(found.vector, reach);
  }

  /** Where the arrow of a force or a moment is; nowhere where it is too small. */
  arrow(action, place, vector, longest) {
    const size = (vector.length() / longest) * (action.body === undefined ? 1 : 0.6);
    if (size < 0.01) return undefined;
    const from = this.project(place);
    if (action.is_moment && this.motion.dimension === 2) return { ends: [from, from], along: [1, 0], unit: UNIT, amount: Math.sign(vector.z) * size };
    const tip = this.project(place.clone().addScaledVector(vector, (this.pixel * LONGEST * size) / vector.length()));
    return this.between(from, tip);
  }

  /** Where an arrow between two points is: with a head that it has room for. */
  between(from, tip) {
    const seen = Math.hypot(tip[0] - from[0], tip[1] - from[1]);
    return seen < 1.5 ? undefined : { ends: [from, tip], along: [1, 0], unit: UNIT * Math.min(1, seen / FULL) };
  }

  /** Names beside what they name, where they cover no other. */
  placeNames() {
    const taken = [...this.reserved, ...this.points.map(([x, y]) => [x - 4, y - 4, x + 4, y + 4])];
    for (const { feet } of this.symbols) taken.push(...feet);
    // Widths of texts differ by parts of a pixel from what is written.
    const isFree = (box) => taken.every(([a, b, c, d]) => box[2] + 1 < a || box[0] - 1 > c || box[3] < b || box[1] > d);
    const [width, height] = this.room ?? [1e9, 1e9];
    const isShown = ({ label, text }) => text && label.parentNode.style.display !== 'none';
    for (const name of this.names.filter(isShown)) {
      const [x, y] = this.project(name.place());
      if (name.width === undefined) {
        // What is not shown has no length.
        set(name.label, { display: 'inline' });
        name.width = name.label.getComputedTextLength();
      }
      const box = (side) => {
        const [a, b] = SIDES[side];
        const left = a > 0 ? x + 9 * a : a < 0 ? x + 9 * a - name.width : x - name.width / 2;
        const middle = y + 11 * b;
        return [left, middle - 7, left + name.width, middle + 7];
      };
      const fits = (side) => {
        const found = box(side);
        return isFree(found) && found[0] > 2 && found[1] > 2 && found[2] < width - 2 && found[3] < height - 2;
      };
      // Where it was, as long as it can stay there.
      const side = [name.side, ...SIDES.keys()].find(fits);
      set(name.label, { display: side === undefined ? 'none' : 'inline' });
      if (side === undefined) continue;
      name.side = side;
      const found = box(side);
      taken.push(found);
      set(name.label, { x: found[0].toFixed(1), y: (found[3] - 3).toFixed(1) });
    }
  }

  /** Draws axes, gravity and a scale in the corner, and returns their box. */
  orientation(corner, height) {
    const { motion } = this;
    corner.replaceChildren();
    const origin = [34, height - 34];
    const base = this.project(new Vector3());
    const arrow = (direction, colour, name, length) => {
      const tip = this.project(direction.clone().multiplyScalar(this.pixel * length));
      const way = [tip[0] - base[0], tip[1] - base[1]];
      if (Math.hypot(...way) < 3) return;
      const strokes = motion.symbols[0].map((stroke) => ({ ...stroke, [stroke.fill === 'none' ? 'stroke' : 'fill']: colour }));
      new Drawn(corner, strokes).draw({ ...this.between(origin, moved(origin, way, 1)), unit: 0.8 * UNIT });
      const at = moved(origin, way, 1 + 9 / Math.hypot(...way));
      element(corner, 'text', { x: at[0], y: at[1] + 4, fill: colour, 'font-size': 11, 'text-anchor': 'middle' }, name);
    };
    const axes = [[1, 0, 0, 'x'], [0, 1, 0, 'y'], [0, 0, 1, 'z']].slice(0, motion.dimension);
    axes.forEach(([x, y, z, name], axis) => arrow(new Vector3(x, y, z), palette.axes[axis], name, 24));
    const gravity = new Vector3(...motion.gravity, ...(motion.gravity.length < 3 ? [0] : []));
    if (gravity.length() > 0) {
      origin[0] += 62;
      origin[1] -= 8;
      arrow(gravity.normalize(), palette.faint, 'g', 20);
    }
    const metres = roundUp(55 * this.pixel);
    const [left, base_line] = [gravity.length() > 0 ? 128 : 84, height - 16];
    const length = metres / this.pixel;
    element(corner, 'path', { d: through([[left, base_line - 4], [left, base_line], [left + length, base_line], [left + length, base_line - 4]]), stroke: palette.faint, fill: 'none' });
    element(corner, 'text', { x: left + length / 2, y: base_line - 5, fill: palette.faint, 'font-size': 11, 'text-anchor': 'middle' }, `${digits(metres)} m`);
    return [0, height - 70, left + length, height];
  }
}
