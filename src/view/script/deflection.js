// Deflections: how bodies differ from themselves as they are drawn, in place or carried by the rigid motion that is nearest to theirs.

import { Quaternion, Vector3 } from 'three';

/** No motion. */
const STILL = { from: new Vector3(), to: new Vector3(), turn: new Quaternion() };

function middle(points) {
  return points.reduce((sum, point) => sum.add(point), new Vector3()).divideScalar(points.length);
}

/** The rigid motion that is nearest to that of points, which turns about their middle. Source: Horn, Closed-form solution of absolute orientation (1987). */
export function nearest(before, after) {
  const [from, to] = [middle(before), middle(after)];
  const sums = Array.from({ length: 3 }, () => [0, 0, 0]);
  before.forEach((point, number) => {
    const [a, b] = [point.clone().sub(from).toArray(), after[number].clone().sub(to).toArray()];
    for (let i = 0; i < 3; i += 1) for (let j = 0; j < 3; j += 1) sums[i][j] += a[i] * b[j];
  });
  const [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = sums;
  let matrix = [
    [xx + yy + zz, yz - zy, zx - xz, xy - yx],
    [yz - zy, xx - yy - zz, xy + yx, zx + xz],
    [zx - xz, xy + yx, yy - xx - zz, yz + zy],
    [xy - yx, zx + xz, yz + zy, zz - xx - yy],
  ];
  // Powers of it, with eigenvalues that are not negative, tend to the projection on the vector of the largest one.
  const shift = Math.hypot(...matrix.flat()) || 1;
  matrix = matrix.map((row, i) => row.map((entry, j) => entry + (i === j ? shift : 0)));
  for (let doubled = 0; doubled < 30; doubled += 1) {
    const size = Math.max(...matrix.flat().map(Math.abs));
    const scaled = matrix.map((row) => row.map((entry) => entry / size));
    matrix = scaled.map((row) => [0, 1, 2, 3].map((j) => row.reduce((sum, entry, k) => sum + entry * scaled[k][j], 0)));
  }
  const [w, x, y, z] = matrix.reduce((best, row, k) => (row[k] > best[1] ? [row, row[k]] : best), [matrix[0], 0])[0];
  return { from, to, turn: new Quaternion(x, y, z, w).normalize() };
}

/** Numbers of a body in a state, as vectors at its nodes and quaternions of its sections. */
class View {
  constructor(body, values) {
    Object.assign(this, { body, values });
    this.isFramed = body.turns && body.dimension === 3;
    this.vectors = (body.each - (this.isFramed ? 4 : 0)) / body.dimension;
  }

  vector(node, part) {
    const { values, body: { each, dimension } } = this;
    const at = node * each + part * dimension;
    return new Vector3(values[at], values[at + 1], dimension > 2 ? values[at + 2] : 0);
  }

  quaternion(node) {
    const [w, x, y, z] = this.values.subarray(this.body.each * (node + 1) - 4, this.body.each * (node + 1));
    return new Quaternion(x, y, z, w).normalize();
  }

  set(node, part, vector) {
    const { values, body: { each, dimension } } = this;
    values.set(vector.toArray().slice(0, dimension), node * each + part * dimension);
  }

  setQuaternion(node, { w, x, y, z }) {
    this.values.set([w, x, y, z], this.body.each * (node + 1) - 4);
  }

  /** Points of nodes, and beside them where sections have directions. */
  points(beside) {
    const found = [];
    for (let node = 0; node < this.body.nodes; node += 1) {
      const point = this.vector(node, 0);
      found.push(point);
      if (this.isFramed) found.push(new Vector3(0, beside, 0).applyQuaternion(this.quaternion(node)).add(point));
    }
    return found;
  }
}

/** Multiplies deflections of a body by a factor: from where it is drawn, or from there carried along. */
export function enlarge(body, factor, isCarried) {
  if (isCarried && !body.lengths) return;
  const [drawn, now] = [new View(body, body.drawn), new View(body, body.now)];
  const beside = 0.1 * body.starts.at(-1);
  const { from, to, turn } = isCarried ? nearest(drawn.points(beside), now.points(beside)) : STILL;
  const back = turn.clone().invert();
  for (let node = 0; node < body.nodes; node += 1) {
    for (let part = 0; part < now.vectors; part += 1) {
      const [old, vector] = [drawn.vector(node, part), now.vector(node, part)];
      if (part === 0) vector.sub(to);
      vector.applyQuaternion(back);
      if (part === 0) vector.add(from);
      vector.sub(old).multiplyScalar(factor).add(old);
      if (part === 0) vector.sub(from);
      vector.applyQuaternion(turn);
      if (part === 0) vector.add(to);
      now.set(node, part, vector);
    }
    if (!now.isFramed) continue;
    const [old, stance] = [drawn.quaternion(node), back.clone().multiply(now.quaternion(node))];
    if (old.dot(stance) < 0) stance.set(-stance.x, -stance.y, -stance.z, -stance.w);
    const [a, b] = [old, stance].map(({ x, y, z, w }) => [x, y, z, w]);
    stance.set(...b.map((value, k) => a[k] + factor * (value - a[k]))).normalize();
    now.setQuaternion(node, turn.clone().multiply(stance));
  }
}
