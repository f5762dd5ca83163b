// Colours of flexible bodies by what acts in their sections, and of surfaces of finite element models by their stress.

import { palette } from './palette.js';
import { digits, element } from './svg.js';

/** Size of the scale, pixels. */
const [WIDTH, HEIGHT] = [150, 9];
/** Room that the scale takes above a picture, with a marker below it, pixels. */
export const LEGEND = 57;

/** What may be shown: its place among the numbers of a node or whether surfaces have it, its unit, whether it has a sign. */
const QUANTITIES = {
  'axial force': { part: 0, unit: 'N', isSigned: true },
  'bending moment': { part: 1, unit: 'N·m' },
  'largest normal stress': { part: 2, unit: 'Pa' },
  'von Mises stress': { isOfSkins: true, unit: 'Pa' },
};
const PARTS = 3;

function mixed(colours, part) {
  const place = Math.min(Math.max(part, 0), 1) * (colours.length - 1);
  const low = Math.min(Math.floor(place), colours.length - 2);
  const [a, b] = [colours[low], colours[low + 1]].map((colour) => [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16)));
  return `#${a.map((from, k) => Math.round(from + (b[k] - from) * (place - low)).toString(16).padStart(2, '0')).join('')}`;
}

/** A quantity that bodies are coloured by, with its scale over the whole run. */
export class Paint {
  constructor(motion, name) {
    Object.assign(this, QUANTITIES[name], { name });
    this.most = 0;
    if (this.isOfSkins) this.most = Math.max(0, ...motion.bodies.map(({ skin }) => skin?.stress?.most ?? 0));
    for (const { forces } of motion.bodies.filter((body) => body.forces)) {
      for (let k = this.part; k < forces.values.length; k += PARTS) this.most = Math.max(this.most, Math.abs(forces.values[k]));
    }
  }

  /** The names of what a run can be coloured by: of what is not zero all along. */
  static offered(motion) {
    return Object.keys(QUANTITIES).filter((name) => new Paint(motion, name).most > 0);
  }

  /** The value at a place of an element. */
  value({ force }, number, xi) {
    const [first, last] = [number, number + 1].map((node) => force[PARTS * node + this.part]);
    return first * (1 - xi) + last * xi;
  }

  colour(body, number, xi) {
    if (!body.force || this.isOfSkins) return palette.unpainted;
    return this.shade(this.value(body, number, xi));
  }

  /** The colour of a value. */
  shade(value) {
    const part = value / this.most;
    return this.isSigned ? mixed(palette.signed, 0.5 + 0.5 * part) : mixed(palette.rising, part);
  }

  /** Draws the scale into the upper right corner of a picture that is so wide, and returns its box. */
  legend(layer, width) {
    layer.replaceChildren();
    const [left, top, parts] = [width - WIDTH - 14, 26, 30];
    const colours = this.isSigned ? palette.signed : palette.rising;
    for (let k = 0; k < parts; k += 1) {
      element(layer, 'rect', { x: left + (k * WIDTH) / parts, y: top, width: WIDTH / parts + 0.5, height: HEIGHT, fill: mixed(colours, (k + 0.5) / parts) });
    }
    const text = (x, y, anchor, content) => element(layer, 'text', { x, y, 'font-size': 11, 'text-anchor': anchor, fill: palette.ink }, content);
    text(left + WIDTH, top - 6, 'end', `${this.name} [${this.unit}]`);
    text(left, top + 21, 'start', this.isSigned ? digits(-this.most, 3) : '0');
    text(left + WIDTH / 2, top + 21, 'middle', this.isSigned ? '0' : digits(this.most / 2, 3));
    text(left + WIDTH, top + 21, 'end', digits(this.most, 3));
    return [left, 0, width, top + 25];
  }
}
