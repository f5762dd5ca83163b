// What is drawn over the picture: joints, springs, forces, paths, names. Sizes are in pixels, symbols those of the still drawing.

import { Vector3 } from 'three';
import { colourOf } from './bodies.js';
import { digits, element, roundUp, set, through } from './svg.js';

const [INK, FAINT, GROUND, LOAD, MOTION, SPRING, REACTION] = ['#24292f', '#8a929b', '#3a3f45', '#c2571a', '#2e7d4f', '#6f4a9e', '#b3246b'];
/** Length of the longest arrow, pixels. */
const LONGEST = 72;
/** Part of the largest reaction below which one is none. */
const NONE = 1e-6;
/** With more markers than this, their names are left to the pointer. */
const MOST_NAMES = 16;
/** Ways from a point that its name is tried at, best first. */
const SIDES = [
  [1, -1], [1, 1], [-1, -1], [-1, 1], [0, -1.5], [0, 1.6], [1.2, 0], [-1.2, 0], [1, -2.4], [1, 2.4], [-1, -2.4], [-1, 2.4], [0, -3], [0, 3],
];

const moved = ([x, y], [a, b], by) => [x + a * by, y + b * by];
const unit = ([x, y]) => (Math.hypot(x, y) > 1e-9 ? [x / Math.hypot(x, y), y / Math.hypot(x, y)] : [0, 1]);
const across = ([x, y]) => [-y, x];

/** A line with hatching behind. */
function ground(centre, along, behind, half) {
  const lines = [through([moved(centre, along, -half), moved(centre, along, half)])];
  for (let at = -half + 3; at <= half; at += 5) {
    const top = moved(centre, along, at);
    lines.push(through([top, moved(moved(top, behind, 5), along, -4)]));
  }
  return lines.join('');
}

/** A support on the ground under a point. */
function foot(at) {
  const base = moved(at, [0, 1], 13);
  return through([at, moved(base, [1, 0], -8), moved(base, [1, 0], 8)], true) + ground(base, [1, 0], [0, 1], 11);
}

function zigzag(from, to) {
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
  const along = unit([to[0] - from[0], to[1] - from[1]]);
  const straight = Math.min(0.2 * length, 16);
  const teeth = Math.min(Math.max(Math.round((length - 2 * straight) / 5), 4), 24);
  const points = [from, moved(from, along, straight)];
  for (let tooth = 0; tooth < teeth; tooth += 1) {
    const at = moved(from, along, straight + ((tooth + 0.5) / teeth) * (length - 2 * straight));
    points.push(moved(at, across(along), tooth % 2 ? -6 : 6));
  }
  return through([...points, moved(to, along, -straight), to]);
}

function spiral(at) {
  return through(Array.from({ length: 49 }, (_, k) => {
    const [angle, radius] = [(4 * Math.PI * k) / 48, 5.5 + (8.5 * k) / 48];
    return [at[0] + radius * Math.cos(angle), at[1] - radius * Math.sin(angle)];
  }));
}

function circle(centre, radius) {
  return through(Array.from({ length: 25 }, (_, k) => {
    const angle = (2 * Math.PI * k) / 24;
    return [centre[0] + radius * Math.cos(angle), centre[1] + radius * Math.sin(angle)];
  }), true);
}

/** Two wheels with radii in the ratio of their rates: in mesh where they turn opposite ways, else with a belt. */
function wheels([from, to], ratio) {
  const reach = Math.hypot(to[0] - from[0], to[1] - from[1]);
  const sum = (reach > 16 ? reach : 16) * (ratio < 0 ? 1 : 0.6);
  const second = sum / (1 + Math.abs(ratio));
  const radii = [sum - second, second];
  const found = circle(from, radii[0]) + circle(to, radii[1]);
  if (ratio < 0 || reach <= 16) return found;
  const along = unit([to[0] - from[0], to[1] - from[1]]);
  const sine = (radii[0] - radii[1]) / reach;
  const belt = [1, -1].map((side) => {
    const out = [along[0] * sine - side * along[1] * Math.sqrt(1 - sine * sine), along[1] * sine + side * along[0] * Math.sqrt(1 - sine * sine)];
    return through([moved(from, out, radii[0]), moved(to, out, radii[1])]);
  });
  return found + belt.join('');
}

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
    this.joints = motion.joints.map((joint) => this.jointParts(joint));
    this.springs = motion.springs.map((spring) => {
      const [foot, coil] = [[FAINT, 1.3], [SPRING, 1.7]].map(([stroke, width]) => element(this.groups.joints, 'path', { fill: 'none', stroke, 'stroke-width': width }));
      element(coil, 'title', {}, spring.name);
      return { foot, coil };
    });
    const marks = (list, stroke, width) => list.map((of) => {
      const mark = element(this.groups.joints, 'path', { fill: 'none', stroke, 'stroke-width': width });
      element(mark, 'title', {}, of.name);
      return mark;
    });
    this.stops = marks(motion.stops, GROUND, 2.6);
    this.gears = marks(motion.gears, FAINT, 1.1);
    this.arrows = motion.actions.map((action) => {
      const group = element(action.is_reaction ? this.groups.reactions : this.groups.loads, 'g');
      return { group, parts: [] };
    });
    this.scales = this.longest();
    this.dots = motion.markers.map((marker, number) => {
      const dot = element(this.groups.markers, 'circle', { r: 3.2, fill: INK, 'data-marker': marker.name });
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

  jointParts(joint) {
    const group = element(this.groups.joints, 'g');
    element(group, 'title', {}, `${joint.name} (${joint.kind})`);
    const line = (stroke, width) => element(group, 'path', { fill: 'none', stroke, 'stroke-width': width, 'stroke-linejoin': 'round' });
    return { back: line(joint.is_motion ? MOTION : FAINT, 1.3), spring: line(SPRING, 1.3), front: line(GROUND, 1.6) };
  }

  /** The size of a reaction, to be written at the tip of its arrow. */
  valueOf(action) {
    const label = element(this.groups.reactions, 'text', { fill: REACTION, 'font-size': 12 });
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
    motion.joints.forEach((joint) => add(joint.name, joint.is_motion ? MOTION : FAINT, () => motion.endOf(joint.ends[1]), 3));
    motion.springs.forEach((spring) => {
      const middle = () => motion.endOf(spring.ends[0]).add(motion.endOf(spring.ends[1])).multiplyScalar(0.5);
      add(spring.name, SPRING, middle, 3);
    });
    (motion.surfaces ?? []).forEach(({ name, lines }) => {
      const line = lines[lines.length >> 1];
      add(name, FAINT, () => new Vector3(...line[line.length >> 1]), 3);
    });
    const markers = motion.markers.map((marker, number) => ({ marker, number }));
    if (markers.length <= MOST_NAMES) {
      for (const { marker, number } of markers) add(motion.bodies.length > 1 ? marker.name : marker.label, INK, () => motion.place(number), 2);
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
      set(this.dots[number], { cx: x.toFixed(1), cy: y.toFixed(1), r: chosen ? 6 : 3.2, fill: chosen ? LOAD : INK });
    });
    this.feet = [];
    motion.joints.forEach((joint, number) => this.updateJoint(joint, this.joints[number]));
    motion.springs.forEach((spring, number) => {
      const [from, to] = spring.ends.map((end) => this.project(motion.endOf(end)));
      set(this.springs[number].coil, { d: zigzag(from, to) });
      set(this.springs[number].foot, { d: spring.ends[0].point ? this.foot(from) : '' });
    });
    motion.stops.forEach((stop, number) => set(this.stops[number], { d: this.bars(stop) }));
    motion.gears.forEach((gear, number) => {
      set(this.gears[number], { d: this.gear(gear) });
    });
    motion.actions.forEach((action, number) => this.updateAction(action, number));
    this.placeNames();
  }

  updateJoint(joint, { back, spring, front }) {
    const { motion } = this;
    const [first, second] = joint.ends.map((end) => this.project(motion.endOf(end)));
    const isGrounded = joint.ends[0].point !== undefined;
    const at = isGrounded && joint.symbol !== 'slider' && joint.symbol !== 'prismatic' ? first : second;
    const along = this.along(joint, second);
    let [drawn, behind, filled] = ['', '', 'none'];
    if (joint.symbol === 'pin' || joint.symbol === 'spiral') {
      drawn = circle(at, 4);
      filled = '#fff';
      if (isGrounded) behind = this.foot(at);
      if (joint.along) behind += through([moved(at, along.way, -22 * along.size), moved(at, along.way, 22 * along.size)]);
      if (joint.symbol === 'spiral') set(spring, { d: spiral(at) });
    } else if (joint.symbol === 'weld') {
      const side = across(along.way);
      filled = GROUND;
      drawn = through([[5, 5], [5, -5], [-5, -5], [-5, 5]].map(([a, b]) => moved(moved(at, along.way, a), side, b)), true);
      if (isGrounded) behind = ground(at, side, along.way.map((part) => -part * this.outward(joint)), 13);
    } else if (joint.symbol === 'slider' || joint.symbol === 'prismatic') {
      const side = across(along.way);
      const corners = [[8, 5], [8, -5], [-8, -5], [-8, 5]];
      drawn = through(corners.map(([a, b]) => moved(moved(second, along.way, a), side, b)), true);
      behind = this.rail(joint, first, second, along.way);
    } else if (joint.symbol === 'link') {
      drawn = through([first, second]) + circle(first, 3.4) + circle(second, 3.4);
      if (isGrounded) behind = this.foot(first);
    } else if (joint.symbol === 'ring') {
      drawn = circle(second, 7);
    } else if (joint.symbol === 'motion') {
      behind = circle(second, 8.5);
    } else {
      drawn = circle(second, 6) + through([moved(second, along.way, -6), moved(second, along.way, 6)]);
    }
    set(back, { d: behind });
    set(front, { d: drawn, fill: filled });
  }

  /** Wheels of a gear between two angles; of one between an angle and a way the wheel that rolls along it; a line between two ways. */
  gear({ joints, angles, ratio }) {
    const ends = joints.map((joint) => this.project(this.motion.endOf(this.motion.joints[joint].ends[1])));
    if (angles[0] && angles[1]) return wheels(ends, ratio);
    const radius = Math.abs(angles[0] ? ratio : 1 / ratio) / this.pixel;
    return through(ends) + (angles[0] || angles[1] ? circle(ends[angles[0] ? 0 : 1], radius) : '');
  }

  /** A support on the ground, whose place no name takes. */
  foot([x, y]) {
    this.feet.push([x - 11, y + 3, x + 11, y + 19]);
    return foot([x, y]);
  }

  /** Bars of a stop: of a way where the marker is when it meets them, of an angle beside it. */
  bars(stop) {
    const { motion } = this;
    const joint = motion.joints[stop.joint];
    const second = this.project(motion.endOf(joint.ends[1]));
    const direction = stop.is_angle ? undefined : motion.direction(joint);
    const { way } = direction ? this.along(joint, second) : { way: [1, 0] };
    return [[-1, stop.lower], [1, stop.upper]].filter(([, limit]) => limit !== null).map(([side, limit]) => {
      const met = direction ? this.project(motion.endOf(joint.ends[0]).addScaledVector(direction, limit)) : second;
      const wall = moved(met, way, side * (direction ? 10 : 20));
      return through([moved(wall, across(way), -9), moved(wall, across(way), 9)]);
    }).join('');
  }

  /** How a joint's direction, or that of its second marker, is seen: unit way in the image, and how much of it lies there. */
  along(joint, second) {
    const { motion } = this;
    let direction = motion.direction(joint);
    if (!direction) {
      const { marker } = joint.ends[1];
      direction = new Vector3(1, 0, 0);
      if (marker !== undefined) direction.applyQuaternion(motion.stanceAt(marker));
    }
    const place = motion.endOf(joint.ends[1]);
    const tip = this.project(place.addScaledVector(direction, this.pixel * 100));
    const way = [tip[0] - second[0], tip[1] - second[1]];
    return { way: unit(way), size: Math.hypot(...way) / 100 };
  }

  /** 1 where the body goes on along its marker's direction, -1 where it ends there. */
  outward(joint) {
    const marker = this.motion.markers[joint.ends[1].marker];
    return marker.point || (marker.element === 0 && marker.xi < 0.5) ? 1 : -1;
  }

  /** The rail of a slider on the ground as long as its way, of another one a stretch of it. */
  rail(joint, first, second, way) {
    if (joint.ends[0].point === undefined) return through([moved(second, way, -26), moved(second, way, 26)]);
    const places = this.ways[joint.ends[1].marker].map((place) => this.project(place));
    const along = places.map(([x, y]) => (x - first[0]) * way[0] + (y - first[1]) * way[1]);
    const [low, high] = [Math.min(...along) - 26, Math.max(...along) + 26];
    return through([moved(first, way, low), moved(first, way, high)]);
  }

  updateAction(action, number) {
    const { group, parts } = this.arrows[number];
    if (group.parentNode.style.display === 'none') return;
    const longest = this.scales[this.keyOf(action)];
    const found = longest > 0 ? this.motion.vectors(number) : [];
    while (parts.length < found.length) {
      const colour = action.is_reaction ? REACTION : LOAD;
      parts.push(element(group, 'path', { fill: 'none', stroke: colour, 'stroke-width': 2, 'stroke-linejoin': 'round' }));
      element(parts.at(-1), 'title', {}, action.name);
    }
    found.forEach(({ at, vector }, k) => set(parts[k], { d: this.arrow(action, at, vector, longest) }));
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

  arrow(action, place, vector, longest) {
    const size = (vector.length() / longest) * (action.body === undefined ? 1 : 0.6);
    if (size < 0.01) return '';
    const from = this.project(place);
    if (action.is_moment && this.motion.dimension === 2) return this.turn(from, Math.sign(vector.z) * size);
    const tip = this.project(place.clone().addScaledVector(vector, (this.pixel * LONGEST * size) / vector.length()));
    const seen = Math.hypot(tip[0] - from[0], tip[1] - from[1]);
    if (seen < 1.5) return '';
    const way = unit([tip[0] - from[0], tip[1] - from[1]]);
    const head = Math.min(8, 0.6 * seen);
    const tipAt = (end) => through([moved(moved(end, way, -head), across(way), 0.45 * head), end, moved(moved(end, way, -head), across(way), -0.45 * head)]);
    return through([from, tip]) + tipAt(tip) + (action.is_moment ? tipAt(moved(tip, way, -head)) : '');
  }

  turn(at, size) {
    const whole = size * 1.5 * Math.PI;
    const point = (part) => {
      const angle = -0.6 + whole * part;
      return [at[0] + 15 * Math.cos(angle), at[1] - 15 * Math.sin(angle)];
    };
    const points = Array.from({ length: 25 }, (_, k) => point(k / 24));
    const way = unit([points[24][0] - points[23][0], points[24][1] - points[23][1]]);
    const head = Math.min(8, 10 * Math.abs(whole));
    const tips = [0.5, -0.5].map((side) => moved(moved(points[24], way, -head), across(way), side * head));
    return through(points) + through([tips[0], points[24], tips[1]]);
  }

  /** Names beside what they name, where they cover no other. */
  placeNames() {
    const taken = [...this.reserved, ...this.points.map(([x, y]) => [x - 4, y - 4, x + 4, y + 4]), ...this.feet];
    const isFree = (box) => taken.every(([a, b, c, d]) => box[2] < a || box[0] > c || box[3] < b || box[1] > d);
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
      const end = moved(origin, way, 1);
      const [along, head] = [unit(way), Math.min(6, 0.4 * Math.hypot(...way))];
      const tips = [0.45, -0.45].map((side) => moved(moved(end, along, -head), across(along), side * head));
      const d = through([origin, end]) + through([tips[0], end, tips[1]]);
      element(corner, 'path', { d, stroke: colour, fill: 'none', 'stroke-width': 1.6 });
      const at = moved(origin, way, 1 + 9 / Math.hypot(...way));
      element(corner, 'text', { x: at[0], y: at[1] + 4, fill: colour, 'font-size': 11, 'text-anchor': 'middle' }, name);
    };
    const axes = [[1, 0, 0, 'x', '#b35b52'], [0, 1, 0, 'y', '#4c8a5d'], [0, 0, 1, 'z', '#4a78b5']].slice(0, motion.dimension);
    for (const [x, y, z, name, colour] of axes) arrow(new Vector3(x, y, z), colour, name, 24);
    const gravity = new Vector3(...motion.gravity, ...(motion.gravity.length < 3 ? [0] : []));
    if (gravity.length() > 0) {
      origin[0] += 62;
      origin[1] -= 8;
      arrow(gravity.normalize(), FAINT, 'g', 20);
    }
    const metres = roundUp(55 * this.pixel);
    const [left, base_line] = [gravity.length() > 0 ? 128 : 84, height - 16];
    const length = metres / this.pixel;
    element(corner, 'path', { d: through([[left, base_line - 4], [left, base_line], [left + length, base_line], [left + length, base_line - 4]]), stroke: FAINT, fill: 'none' });
    element(corner, 'text', { x: left + length / 2, y: base_line - 5, fill: FAINT, 'font-size': 11, 'text-anchor': 'middle' }, `${digits(metres)} m`);
    return [0, height - 70, left + length, height];
  }
}
