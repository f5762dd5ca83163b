// Symbols as strokes: where their frames are in the picture. What strokes mean is written beside `Stroke` in the Rust library.

import { element, set, through } from './svg.js';

/** Parts of a circle and of an arc. */
const ARC = 24;

export const moved = ([x, y], [a, b], by) => [x + a * by, y + b * by];
export const unit = ([x, y]) => (Math.hypot(x, y) > 1e-9 ? [x / Math.hypot(x, y), y / Math.hypot(x, y)] : [0, 1]);
/** The normal of the same length that points down the page. */
const across = ([x, y]) => (x >= 0 ? [-y, x] : [y, -x]);
const between = ([a, b], [c, d]) => [c - a, d - b];

/** The frame of a stroke: its points and axes in pixels, from those of what the symbol stands for. */
function frameOf({ points, axes }, placed) {
  const { ends: [first, second], along, unit: size } = placed;
  const beside = points.beside && moved(moved(second, [1, 0], points.beside[0] * size), [0, 1], points.beside[1] * size);
  const limit = points.limit !== undefined && placed.limit(points.limit);
  const known = { first: [first, first], second: [second, second], both: [first, second], travel: points === 'travel' && placed.travel() };
  const [from, to] = known[points] ?? [beside || limit, beside || limit];
  const span = between(from, to);
  const axis = axes.global ? placed.seen(axes.global) : { page: [1, 0], along: unit(along), axis: along, span: unit(span) }[axes];
  const other = across(axis);
  const at = ([part, aside, x, y]) => (
    moved(moved(moved(moved(from, span, part), across(span), aside), axis, x * size), other, y * size)
  );
  return { from, to, span, axis, other, at, size };
}

function circle({ centre, radius }, { at, span, size }, placed) {
  const reach = Math.max(Math.hypot(...span), 2 * size);
  const whole = radius.units * size + radius.part * reach + (radius.length && radius.length / placed.pixel);
  const middle = at(centre);
  return through(Array.from({ length: ARC + 1 }, (_, k) => {
    const angle = (2 * Math.PI * k) / ARC;
    return [middle[0] + whole * Math.cos(angle), middle[1] + whole * Math.sin(angle)];
  }), true);
}

/** An arc shortened by an amount and its head, both as paths. */
function arc({ radius, from, sweep, head }, { at, size }, amount) {
  const whole = sweep * amount;
  const point = (angle) => at([0, 0, radius * Math.cos(angle), -radius * Math.sin(angle)]);
  const points = Array.from({ length: ARC + 1 }, (_, k) => point(from + (whole * k) / ARC));
  const end = from + whole;
  const way = [-Math.sin(end), -Math.cos(end)].map((part) => part * Math.sign(whole));
  const long = Math.min(head, 1.2 * Math.abs(whole)) * size;
  const ahead = moved(points[ARC], way, 0.36 * long);
  const back = moved(ahead, way, -long);
  const corners = [1, -1].map((side) => moved(back, [Math.cos(end), -Math.sin(end)], 0.42 * side * long));
  return [through(points), through([ahead, ...corners], true)];
}

function cells({ from, to, pitch, counts, cell, is_joined: isJoined }, { at, axis, other, size }) {
  const [start, end] = [at(from), at(to)];
  const way = between(start, end);
  const count = Math.min(Math.max(Math.round(Math.hypot(...way) / (pitch * size)), counts[0]), counts[1]);
  const lines = Array.from({ length: count }, (_, number) => cell.map(([part, x, y]) => (
    moved(moved(moved(start, way, (number + part) / count), axis, x * size), other, y * size)
  )));
  return isJoined ? through([start, ...lines.flat(), end]) : lines.map((line) => through(line)).join('');
}

/** A symbol in a layer of a picture. */
export class Drawn {
  constructor(layer, strokes, title) {
    this.group = element(layer, 'g');
    if (title) element(this.group, 'title', {}, title);
    this.strokes = strokes.map((stroke) => {
      const attributes = { fill: stroke.fill, stroke: stroke.stroke, 'stroke-linejoin': 'round', 'stroke-linecap': 'round' };
      const path = element(this.group, 'path', attributes);
      const head = stroke.arc && element(this.group, 'path', { fill: stroke.stroke });
      return { stroke, path, head };
    });
  }

  /** Draws it where it is: ends and direction in pixels, the size of a unit, a part of arcs. Nothing where there is no place. */
  draw(placed) {
    // What stands on the ground, whose place no name takes.
    this.feet = [];
    for (const { stroke, path, head } of this.strokes) {
      if (!placed) {
        for (const drawn of [path, head]) if (drawn) set(drawn, { d: '' });
        continue;
      }
      const frame = frameOf(stroke, placed);
      let d;
      if (stroke.line) d = through(stroke.line.map(frame.at), stroke.fill !== 'none');
      else if (stroke.circle) d = circle(stroke.circle, frame, placed);
      else if (stroke.repeat) d = cells(stroke.repeat, frame);
      else {
        const [line, tip] = arc(stroke.arc, frame, placed.amount ?? 1);
        set(head, { d: tip });
        d = line;
      }
      set(path, { d, 'stroke-width': (stroke.width * placed.unit).toFixed(2) });
      if (stroke.repeat && stroke.axes === 'page') {
        const [[left, upper], [right]] = [stroke.repeat.from, stroke.repeat.to].map(frame.at);
        this.feet.push([left, frame.from[1] + 3, right, upper + 0.5 * placed.unit]);
      }
    }
  }
}
