// What was recorded, and where everything is at a time between two frames.
//
// The page holds a header (JSON) and numbers (base64). A track of numbers is `rows` times `width`: of kind `exact` doubles, of
// kind `steps` a lowest value and a step (two singles) for every column, then 16-bit counts of steps. A track of one row never changes.

import { Matrix4, Quaternion, Vector3 } from 'three';
import { enlarge } from './deflection.js';

/** Parts of the size of a scene: ends that are nearer are together, ends that are further apart are not. */
const [CLOSED, OPEN] = [1e-4, 0.01];
/** Part of the size of a scene, and change of a direction, beyond which bodies move as a whole. */
const FAR = 0.2;

/** Numbers in base64. */
export function bytesOf(text) {
  return Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
}

function read(track, buffer) {
  const { at, rows, width } = track;
  if (track.kind === 'exact') return { rows, width, values: new Float64Array(buffer, at, rows * width) };
  const scales = new Float32Array(buffer, at, 2 * width);
  const counts = new Uint16Array(buffer, at + 8 * width, rows * width);
  const values = new Float32Array(rows * width);
  for (let k = 0; k < values.length; k += 1) {
    values[k] = scales[2 * (k % width)] + scales[2 * (k % width) + 1] * counts[k];
  }
  return { rows, width, values };
}

/** One row of a track between two of its rows. */
function between(track, place, into) {
  const { rows, width, values } = track;
  const low = Math.min(Math.floor(place), rows - 1);
  const high = Math.min(low + 1, rows - 1);
  const part = place - low;
  for (let k = 0; k < width; k += 1) {
    const from = values[low * width + k];
    into[k] = from + (values[high * width + k] - from) * part;
  }
}

/** The place of a time among increasing times: whole numbers at these. */
export function placeOf(times, time) {
  let [low, high] = [0, times.length - 1];
  if (high < 1 || time <= times[0]) return 0;
  if (time >= times[high]) return high;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return low + (time - times[low]) / (times[high] - times[low]);
}

/** Weights of positions and slopes of both ends of an element of a length, at `xi` in [0, 1]; then those in the derivative by length. */
export function hermite(xi, length) {
  const [a, b] = [xi * xi, xi * xi * xi];
  return [
    [1 - 3 * a + 2 * b, length * (xi - 2 * a + b), 3 * a - 2 * b, length * (b - a)],
    [6 * (a - xi) / length, 1 - 4 * xi + 3 * a, 6 * (xi - a) / length, 3 * a - 2 * xi],
  ];
}

/** A body at a time. */
class Body {
  constructor(described, number, tracks, dimension) {
    Object.assign(this, described, { number, dimension });
    this.track = tracks[described.track];
    this.now = new Float32Array(this.track.width);
    this.each = this.track.width / described.nodes;
    this.radius ??= 0;
    this.drawn = described.drawn === undefined ? undefined : tracks[described.drawn].values;
    if (described.skin) {
      const { points, modes, amplitudes, triangles, edges, stress } = described.skin;
      this.skin = { points: tracks[points].values, modes: tracks[modes], amplitudes: tracks[amplitudes], triangles, edges };
      if (stress) {
        this.skin.stress = { modes: tracks[stress.modes], strains: tracks[stress.strains], most: stress.most, hasFaces: stress.hasFaces };
        this.strains = new Float32Array(tracks[stress.strains].width);
      }
      this.amplitudes = new Float32Array(tracks[amplitudes].width);
      this.undeformed = new Float32Array(this.amplitudes.length);
    }
    if (described.forces !== undefined) {
      this.forces = tracks[described.forces];
      this.force = new Float32Array(this.forces.width);
    }
    this.starts = [0];
    for (const length of this.lengths ?? []) this.starts.push(this.starts.at(-1) + length);
  }

  /** Puts the body where it is at a place among the frames, with its deflection times a factor. */
  seek(place, factor, isCarried) {
    between(this.track, place, this.now);
    if (this.forces) between(this.forces, place, this.force);
    if (this.strains) between(this.skin.stress.strains, place, this.strains);
    if (this.skin) {
      between(this.skin.amplitudes, place, this.amplitudes);
      this.undeformed.forEach((from, mode) => { this.amplitudes[mode] = from + factor * (this.amplitudes[mode] - from); });
    }
    if (this.drawn && factor !== 1) enlarge(this, factor, isCarried);
  }

  /** Whether it moves as a whole in a scene of a size: a node far, or all directions. */
  movesFar(size) {
    const { track: { values, rows, width }, drawn, dimension, each } = this;
    const nodes = Array.from({ length: this.nodes }, (_, node) => node * each);
    const change = (row, from, to) => {
      let most = 0;
      for (let k = from; k < to; k += 1) most = Math.max(most, Math.abs(values[row * width + k] - drawn[k]));
      return most;
    };
    return Array.from({ length: rows }, (_, row) => row).some((row) => (
      nodes.some((at) => change(row, at, at + dimension) > FAR * size) || nodes.every((at) => change(row, at + dimension, at + each) > FAR)
    ));
  }

  vector(node, part) {
    const at = node * this.each + part * this.dimension;
    return new Vector3(this.now[at], this.now[at + 1], this.dimension > 2 ? this.now[at + 2] : 0);
  }

  /** How the frame or section at a node stands. */
  stance(node) {
    if (this.dimension === 2) {
      // The section of a beam has a direction of its own; that of a rigid body is its slope.
      const direction = this.vector(node, this.turns ? 2 : 1);
      return new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), Math.atan2(direction.y, direction.x));
    }
    if (!this.turns) return new Quaternion();
    const at = node * this.each + this.each - 4;
    const [w, x, y, z] = this.now.subarray(at, at + 4);
    return new Quaternion(x, y, z, w).normalize();
  }

  /** Sum of three numbers a mode times the amplitudes. */
  deformed(ways) {
    const sum = new Vector3();
    this.amplitudes.forEach((amplitude, mode) => sum.addScaledVector(new Vector3().fromArray(ways, 3 * mode), amplitude));
    return sum;
  }

  /** Stress of von Mises at a point of a surface, Pa. */
  vonMises(point) {
    const { modes: { values, width, rows }, hasFaces } = this.skin.stress;
    const first = rows > 1 ? point * width : 0;
    const parts = [0, 1, 2, 3, 4, 5].map((part) => (
      this.strains.reduce((sum, strain, mode) => sum + strain * values[first + 6 * mode + part], 0)
    ));
    // Of a plate or shell they are 11, 22 and 12 at its bottom, then at its top.
    if (hasFaces) return Math.max(...[0, 3].map((k) => Math.hypot(parts[k] - parts[k + 1] / 2, Math.sqrt(0.75) * parts[k + 1], Math.sqrt(3) * parts[k + 2])));
    const [xx, yy, zz, xy, xz, yz] = parts;
    return Math.sqrt(((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) / 2 + 3 * (xy * xy + xz * xz + yz * yz));
  }

  /** Point and derivative of the line inside an element. */
  line(element, xi) {
    const [values, slopes] = hermite(xi, this.lengths[element]);
    const [point, tangent] = [new Vector3(), new Vector3()];
    for (let k = 0; k < 4; k += 1) {
      const vector = this.vector(element + (k >> 1), k & 1);
      point.addScaledVector(vector, values[k]);
      tangent.addScaledVector(vector, slopes[k]);
    }
    return [point, tangent];
  }

  /** Point of the line, its tangent and how its section stands; of a cable one that is turned from the first as little as can be. */
  section(element, xi, before) {
    const [point, tangent] = this.line(element, xi);
    tangent.normalize();
    let stance;
    if (this.dimension === 2) {
      const normal = tangent.clone();
      if (this.turns) {
        const [a, b] = [element, element + 1].map((node) => this.vector(node, 2).normalize());
        normal.copy(a.lerp(b, xi)).normalize();
      }
      stance = basis(normal, new Vector3(0, 0, 1));
    } else if (this.turns) {
      const [a, b] = [this.stance(element), this.stance(element + 1)];
      stance = basis(tangent, new Vector3(0, 1, 0).applyQuaternion(a.slerp(b, xi)));
    } else {
      const first = before ? new Vector3(0, 1, 0).applyQuaternion(before) : crossing(tangent);
      stance = basis(tangent, first);
    }
    return { point, tangent, stance };
  }
}

/** A direction across another. */
export function crossing(along) {
  const [x, y, z] = [Math.abs(along.x), Math.abs(along.y), Math.abs(along.z)];
  const axis = z <= x && z <= y ? new Vector3(0, 0, 1) : y <= x ? new Vector3(0, 1, 0) : new Vector3(1, 0, 0);
  return axis.addScaledVector(along, -axis.dot(along)).normalize();
}

/** The rotation that takes x to a direction, and y as near to a second one as can be. */
export function basis(along, second) {
  const first = along.clone().normalize();
  let across = second.clone().addScaledVector(first, -second.dot(first));
  across = across.lengthSq() > 1e-12 ? across.normalize() : crossing(first);
  const third = first.clone().cross(across);
  return new Quaternion().setFromRotationMatrix(new Matrix4().makeBasis(first, across, third));
}

/** Everything that was recorded. */
export class Motion {
  constructor(header, buffer) {
    Object.assign(this, header);
    const tracks = header.tracks.map((track) => read(track, buffer));
    this.tracks = tracks;
    this.times = tracks[header.times].values;
    this.table = tracks[header.table];
    this.rowTimes = tracks[header.row_times].values;
    this.bodies = header.bodies.map((body, number) => new Body(body, number, tracks, header.dimension));
    this.row = new Float64Array(this.table.width);
    this.factor = 1;
    this.isCarried = false;
    this.acting = header.actions.map((action) => new Float32Array(tracks[action.track].width));
    this.seek(this.times[0]);
    this.fixAxes();
    this.seek(this.times[0]);
  }

  get start() {
    return this.times[0];
  }

  get end() {
    return this.times[this.times.length - 1];
  }

  /** Puts everything where it is at a time. */
  seek(time) {
    this.time = Math.min(Math.max(time, this.start), this.end);
    const place = placeOf(this.times, this.time);
    for (const body of this.bodies) body.seek(place, this.factor, this.isCarried);
    this.actions.forEach((action, number) => between(this.tracks[action.track], place, this.acting[number]));
    between(this.table, placeOf(this.rowTimes, this.time), this.row);
  }

  /** Where a marker is. */
  place(number) {
    const marker = this.markers[number];
    if (marker.columns) {
      return new Vector3(...[0, 1, 2].map((k) => (k < marker.columns.length ? this.row[marker.columns[k]] : 0)));
    }
    const body = this.bodies[marker.body];
    return marker.point ? this.pointOf(body, marker) : body.line(marker.element, marker.xi)[0];
  }

  /** Where a point of a body is, which modes may move. */
  pointOf(body, { point: at, modes }) {
    const point = new Vector3(...at);
    if (modes) point.add(body.deformed(modes));
    return point.applyQuaternion(body.stance(0)).add(body.vector(0, 0));
  }

  /** How what a marker belongs to stands there. */
  stanceAt(number) {
    const marker = this.markers[number];
    if (marker.columns) return new Quaternion();
    const body = this.bodies[marker.body];
    if (marker.rotation) {
      const turn = body.deformed(marker.rotation);
      return body.stance(0).multiply(new Quaternion().setFromAxisAngle(turn.clone().normalize(), turn.length()));
    }
    if (marker.point) return body.stance(0);
    return body.section(marker.element, marker.xi).stance;
  }

  /** Where an end of a joint or spring is. */
  endOf(end) {
    return end.point ? new Vector3(...end.point) : this.place(end.marker);
  }

  /** Directions that symbols have at the start, in the axes of what they are fixed to. */
  fixAxes() {
    for (const mark of this.marks) {
      const first = mark.ends[0].marker;
      if (!mark.direction) continue;
      mark.along = new Vector3(...mark.direction);
      if (!mark.is_local && first !== undefined) mark.along.applyQuaternion(this.stanceAt(first).invert());
    }
  }

  /** The direction of a symbol now. */
  direction(mark) {
    const first = mark.ends[0].marker;
    if (!mark.along) return undefined;
    return first === undefined ? mark.along.clone() : mark.along.clone().applyQuaternion(this.stanceAt(first));
  }

  /** What a force or moment is now, in global axes: one vector, or several along or over a body, each where it acts. */
  vectors(number) {
    const [action, values] = [this.actions[number], this.acting[number]];
    const each = action.components;
    const vector = (k, stance) => {
      const at = k * each;
      let found;
      if (each === 1) found = this.dimension === 2 ? new Vector3(0, 0, values[at]) : undefined;
      else found = new Vector3(values[at], values[at + 1], each > 2 ? values[at + 2] : 0);
      if (found === undefined) found = this.direction(this.marks[action.joint])?.multiplyScalar(values[at]) ?? new Vector3();
      return action.follower ? found.applyQuaternion(stance) : found;
    };
    if (action.body === undefined) {
      return [{ at: this.place(action.marker), vector: vector(0, this.stanceAt(action.marker)) }];
    }
    const body = this.bodies[action.body];
    if (action.points) return action.points.map((point, k) => ({ at: this.pointOf(body, point), vector: vector(k) }));
    const count = values.length / each;
    const [whole, found] = [body.starts.at(-1), []];
    for (let k = 0; k < count; k += 1) {
      const along = (whole * (k + 0.5)) / count;
      let element = body.starts.findIndex((start) => start > along) - 1;
      if (element < 0) element = body.lengths.length - 1;
      const section = body.section(element, (along - body.starts[element]) / body.lengths[element]);
      found.push({ at: section.point, vector: vector(k, section.stance) });
    }
    return found;
  }

  /** Whether ends that are together at the start are together too where bodies are drawn, in a scene of a size. */
  fits(size) {
    const gaps = () => this.marks.map(({ ends: [first, second] }) => this.endOf(first).distanceTo(this.endOf(second)));
    const now = this.time;
    this.seek(this.start);
    const atStart = gaps();
    for (const body of this.bodies) {
      if (body.drawn) body.now.set(body.drawn);
      body.amplitudes?.set(body.undeformed);
    }
    const drawn = gaps();
    this.seek(now);
    return drawn.every((gap, number) => atStart[number] > CLOSED * size || gap < OPEN * size);
  }

  /** Measures displacements of bodies from the start of the run. */
  measureFromStart() {
    for (const body of this.bodies) {
      body.drawn = body.track.values.slice(0, body.track.width);
      if (body.skin) body.undeformed = body.skin.amplitudes.values.slice(0, body.amplitudes.length);
    }
  }

  /** Points that everything stays about, and how far around each of them. */
  reach() {
    const found = [];
    const add = (point, around = 0) => found.push({ point: point.clone(), around });
    const steps = Math.min(this.times.length, 60);
    for (let k = 0; k < steps; k += 1) {
      this.seek(this.times[Math.round((k * (this.times.length - 1)) / Math.max(steps - 1, 1))]);
      for (const body of this.bodies) {
        for (let node = 0; node < body.nodes; node += 1) add(body.vector(node, 0), body.radius);
        body.lengths?.forEach((_, element) => add(body.line(element, 0.5)[0]));
      }
      this.markers.forEach((_, number) => add(this.place(number)));
    }
    for (const end of this.marks.flatMap((mark) => mark.ends)) if (end.point) add(new Vector3(...end.point));
    this.seek(this.start);
    if (!found.length) add(new Vector3(), 1);
    return found;
  }
}
