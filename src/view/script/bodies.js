// Bodies as surfaces: of chains rings of vertices along their lines, of rigid bodies their shape, of finite element models triangles that deform.

import {
  BoxGeometry, BufferAttribute, BufferGeometry, Color, CylinderGeometry, DoubleSide, EdgesGeometry, Group, LatheGeometry, Line, LineBasicMaterial,
  LineSegments, Mesh, MeshLambertMaterial, Quaternion, SphereGeometry, Vector2, Vector3,
} from 'three';
import { ConvexGeometry } from 'three/examples/jsm/geometries/ConvexGeometry.js';
import { palette } from './palette.js';

/** Points around a section, and least number of sections along a chain. */
const AROUND = 16;
const ALONG = 72;
/** Half the width of what is thinner, pixels. */
const THIN = 1.6;
/** Half the width from which on lines show how sections stand, pixels. */
const WIDE = 3;
/** Half the width of the thinnest rigid body, in sizes of the scene. */
const LEAST = 0.011;
const edges = () => new LineBasicMaterial({ color: palette.ink, transparent: true, opacity: 0.55 });

function material(number) {
  return new MeshLambertMaterial({ color: colourOf(number), side: DoubleSide });
}

/** Points of the boundary of a section of half widths, on a rectangle's edges or around an ellipse. */
function rim(corners) {
  if (corners) return [[1, 1], [-1, 1], [-1, 1], [-1, -1], [-1, -1], [1, -1], [1, -1], [1, 1]];
  return Array.from({ length: AROUND + 1 }, (_, k) => {
    const angle = (2 * Math.PI * k) / AROUND;
    return [Math.cos(angle), Math.sin(angle)];
  });
}

/** Shows colours of vertices, or that of a body. */
function showColours({ material }, body, isPainted) {
  Object.assign(material, { vertexColors: isPainted, needsUpdate: true });
  material.color.set(isPainted ? '#fff' : colourOf(body.number));
}

/** A cable, rod or beam. */
class Chain {
  constructor(body) {
    this.body = body;
    this.parts = Math.max(2, Math.ceil(ALONG / body.lengths.length));
    this.rim = rim(body.corners);
    const [rings, width] = [body.lengths.length * this.parts + 1, this.rim.length];
    this.rings = rings;
    const index = [];
    for (let ring = 0; ring + 1 < rings; ring += 1) {
      for (let k = 0; k + 1 < width; k += body.corners ? 2 : 1) {
        const [a, b] = [ring * width + k, (ring + 1) * width + k];
        index.push(a, a + 1, b, a + 1, b + 1, b);
      }
    }
    // Lids of both ends, with vertices of their own.
    const lid = rings * width;
    for (let k = 1; k + 1 < width; k += 1) {
      index.push(lid, lid + k + 1, lid + k);
      index.push(lid + width, lid + width + k, lid + width + k + 1);
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(3 * (rings + 2) * width), 3));
    geometry.setAttribute('normal', new BufferAttribute(new Float32Array(3 * (rings + 2) * width), 3));
    geometry.setAttribute('color', new BufferAttribute(new Float32Array(3 * (rings + 2) * width), 3));
    geometry.setIndex(index);
    this.object = new Mesh(geometry, material(body.number));
    this.object.frustumCulled = false;
    if (body.corners || (body.turns && body.dimension === 3)) this.addEdges(rings, width);
  }

  /** Lines along the body: edges of what has corners, four around what is round and can twist. */
  addEdges(rings, width) {
    const index = [];
    for (let ring = 0; ring + 1 < rings; ring += 1) {
      for (let k = 0; k < width - 1; k += this.body.corners ? 2 : AROUND / 4) index.push(ring * width + k, (ring + 1) * width + k);
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', this.object.geometry.attributes.position);
    geometry.setIndex(index);
    this.edges = new LineSegments(geometry, edges());
    this.edges.frustumCulled = false;
    this.object.add(this.edges);
    Object.assign(this.object.material, { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2 });
  }

  /** Half widths of the section at a place of an element. */
  halves(element, xi, least) {
    const sizes = this.body.sections;
    const [a, b] = sizes[Math.min(element, sizes.length - 1)];
    return [0, 1].map((k) => Math.max(a[k] + (b[k] - a[k]) * xi, least));
  }

  update(pixel, paint) {
    const { position, normal, color } = this.object.geometry.attributes;
    const width = this.rim.length;
    const [point, out] = [new Vector3(), new Vector3()];
    if (this.edges) this.edges.visible = Math.max(...this.halves(0, 0, 0)) > WIDE * pixel;
    let before;
    const painted = new Color();
    const put = (at, section, halves, [y, z], direction) => {
      if (paint) color.setXYZ(at, painted.r, painted.g, painted.b);
      point.set(0, y * halves[0], z * halves[1]).applyQuaternion(section.stance).add(section.point);
      position.setXYZ(at, point.x, point.y, point.z);
      out.copy(direction).applyQuaternion(section.stance);
      normal.setXYZ(at, out.x, out.y, out.z);
    };
    for (let ring = 0; ring < this.rings; ring += 1) {
      const element = Math.min(Math.floor(ring / this.parts), this.body.lengths.length - 1);
      const xi = ring / this.parts - element;
      const section = this.body.section(element, xi, before);
      const halves = this.halves(element, xi, THIN * pixel);
      before = section.stance;
      if (paint) painted.set(paint.colour(this.body, element, xi));
      this.rim.forEach(([y, z], k) => put(ring * width + k, section, halves, [y, z], this.outward(k, halves)));
      if (ring === 0 || ring === this.rings - 1) {
        const lid = (this.rings + (ring === 0 ? 0 : 1)) * width;
        const ahead = new Vector3(ring === 0 ? -1 : 1, 0, 0);
        this.rim.forEach(([y, z], k) => put(lid + k, section, halves, [y, z], ahead));
      }
    }
    for (const changed of [position, normal, color]) changed.needsUpdate = true;
  }

  paint(paint) {
    showColours(this.object, this.body, Boolean(paint));
  }

  outward(k, halves) {
    if (this.body.corners) {
      const side = [[0, 0, 1], [0, -1, 0], [0, 0, -1], [0, 1, 0]][k >> 1];
      return new Vector3(...side);
    }
    const [y, z] = this.rim[k];
    return new Vector3(0, y / halves[0], z / halves[1]).normalize();
  }
}

/** Shape of a rigid body. */
function shape(body, least) {
  const turned = (geometry, axis) => {
    const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), new Vector3(...axis).normalize());
    return geometry.applyQuaternion(turn);
  };
  const { solid } = body;
  if (solid?.box) return new BoxGeometry(...solid.box);
  if (solid?.sphere) return new SphereGeometry(solid.sphere, 48, 24);
  if (solid?.cylinder) {
    const { radius, length, axis } = solid.cylinder;
    return turned(new CylinderGeometry(radius, radius, length, 48), axis);
  }
  if (solid?.tube) {
    const { radius, inner_radius: inner, length, axis } = solid.tube;
    const [low, high] = [-length / 2, length / 2];
    const corners = [[inner, low], [radius, low], [radius, low], [radius, high], [radius, high], [inner, high], [inner, high], [inner, low]];
    return turned(new LatheGeometry(corners.map((corner) => new Vector2(...corner)), 48), axis);
  }
  if (body.points.length < 2) {
    // The ellipsoid that has the same inertia, as large as can be seen.
    return new SphereGeometry(1, 32, 16).scale(...body.inertial.map((half) => Math.max(half, 1.6 * least)));
  }
  // What its markers and its centre of mass span, as thick as can be seen.
  const directions = new SphereGeometry(least, 8, 6).attributes.position;
  const around = [];
  for (const place of body.points) {
    for (let k = 0; k < directions.count; k += 1) {
      around.push(new Vector3().fromBufferAttribute(directions, k).add(new Vector3(...place)));
    }
  }
  return new ConvexGeometry(around);
}

/** Stands an object where the frame of a rigid or reduced body does. */
function follow(object, body) {
  object.position.copy(body.vector(0, 0));
  object.quaternion.copy(body.stance(0));
}

/** A rigid body. */
class Rigid {
  constructor(body, size) {
    this.body = body;
    const geometry = shape(body, LEAST * size);
    this.object = new Group();
    const surface = new Mesh(geometry, material(body.number));
    if (!body.solid) {
      surface.material.flatShading = body.points.length < 2 ? false : true;
      // What stands for an inertia, which may be wide, hides nothing.
      const opacity = Math.max(...body.inertial) > 1.6 * LEAST * size ? 0.3 : body.points.length > 2 ? 0.82 : 1;
      Object.assign(surface.material, { opacity, transparent: opacity < 1, depthWrite: opacity > 0.5 });
    }
    this.object.add(surface);
    if (body.solid && !body.solid.sphere) {
      this.object.add(new LineSegments(new EdgesGeometry(geometry, 40), edges()));
    }
    if (body.solid?.cylinder || body.solid?.sphere || body.solid?.tube) this.addSpokes(body.solid);
  }

  /** A line on what is round, so that one sees it turn. */
  addSpokes(solid) {
    const { radius, length, axis } = solid.cylinder ?? solid.tube ?? { radius: solid.sphere, length: 0, axis: [0, 0, 1] };
    const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), new Vector3(...axis).normalize());
    const points = [];
    if (solid.sphere) {
      for (let k = 0; k < 64; k += 1) {
        for (const step of [k, k + 1]) {
          const angle = (Math.PI * step) / 32;
          points.push(new Vector3(0, radius * 1.002 * Math.cos(angle), radius * 1.002 * Math.sin(angle)));
        }
      }
    } else {
      const inner = solid.tube?.inner_radius ?? 0;
      for (const end of [-0.501, 0.501]) {
        for (const side of [1, -1]) points.push(new Vector3(side * inner, end * length, 0), new Vector3(side * radius, end * length, 0));
      }
      points.push(new Vector3(1.001 * radius, -0.5 * length, 0), new Vector3(1.001 * radius, 0.5 * length, 0));
    }
    const geometry = new BufferGeometry().setFromPoints(points.map((point) => point.applyQuaternion(turn)));
    this.object.add(new LineSegments(geometry, edges()));
  }

  update() {
    follow(this.object, this.body);
  }
}

/** A finite element model: triangles between points that modes move. */
class Skin {
  constructor(body) {
    this.body = body;
    const { points, triangles, edges: ends } = body.skin;
    const position = new BufferAttribute(points.slice(), 3);
    const between = (index) => new BufferGeometry().setAttribute('position', position).setIndex(index);
    this.object = new Group();
    const surface = new Mesh(between(triangles), material(body.number));
    Object.assign(surface.material, { flatShading: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2 });
    for (const part of [surface, new LineSegments(between(ends), edges())]) {
      part.frustumCulled = false;
      this.object.add(part);
    }
    surface.geometry.setAttribute('color', new BufferAttribute(new Float32Array(points.length), 3));
    Object.assign(this, { position, surface });
  }

  paint(paint) {
    showColours(this.surface, this.body, Boolean(paint?.isOfSkins && this.body.strains));
  }

  /** Colours of the points by their stress. */
  colour(paint) {
    const { color } = this.surface.geometry.attributes;
    const painted = new Color();
    for (let point = 0; point < color.count; point += 1) {
      painted.set(paint.shade(this.body.vonMises(point)));
      color.setXYZ(point, painted.r, painted.g, painted.b);
    }
    color.needsUpdate = true;
  }

  update(_, paint) {
    const { body, position } = this;
    if (paint?.isOfSkins && body.strains) this.colour(paint);
    const { points, modes: { values, width, rows } } = body.skin;
    for (let k = 0; k < points.length; k += 1) {
      // Where all points move alike, one row says how.
      let at = (rows > 1 ? Math.floor(k / 3) * width : 0) + (k % 3);
      let sum = points[k];
      for (const amplitude of body.amplitudes) {
        sum += values[at] * amplitude;
        at += 3;
      }
      position.array[k] = sum;
    }
    position.needsUpdate = true;
    follow(this.object, body);
  }
}

/** The surfaces of all bodies. */
export function surfaces(motion, size) {
  return motion.bodies.map((body) => {
    if (body.lengths) return new Chain(body);
    return body.skin ? new Skin(body) : new Rigid(body, size);
  });
}

/** Lines of what bodies touch, lighter than these: they stand still, or move with a rigid body. */
class Bed {
  constructor(body, lines) {
    this.body = body;
    this.object = new Group();
    for (const line of lines) {
      const geometry = new BufferGeometry().setFromPoints(line.map((point) => new Vector3(...point)));
      const drawn = new Line(geometry, new LineBasicMaterial({ color: palette.bed }));
      drawn.frustumCulled = !body;
      this.object.add(drawn);
    }
  }

  update() {
    if (this.body) follow(this.object, this.body);
  }
}

/** The surfaces that bodies touch. */
export function beds(motion) {
  return (motion.surfaces ?? []).map(({ body, lines }) => new Bed(motion.bodies[body], lines));
}

/** The colour of a body's name. */
export function colourOf(number) {
  return palette.bodies[number % palette.bodies.length];
}
