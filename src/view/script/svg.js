// Elements of SVG.

const NAMESPACE = 'http://www.w3.org/2000/svg';

/** An element with attributes inside another. */
export function element(parent, name, attributes = {}, text) {
  const made = document.createElementNS(NAMESPACE, name);
  set(made, attributes);
  if (text !== undefined) made.textContent = text;
  parent.append(made);
  return made;
}

/** Sets attributes. */
export function set(of, attributes) {
  for (const [name, value] of Object.entries(attributes)) {
    if (of.getAttribute(name) !== String(value)) of.setAttribute(name, value);
  }
}

/** A path through points in pixels. */
export function through(points, closed = false) {
  const pairs = points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`);
  return pairs.length ? `M${pairs.join('L')}${closed ? 'Z' : ''}` : '';
}

/** The first of 1, 2 and 5 times a power of ten that is not below a number. */
export function roundUp(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].map((digit) => digit * power).find((step) => step >= value * (1 - 1e-9));
}

/** A number to so many digits, without an end of zeros. */
export function digits(value, count = 4) {
  if (value === 0) return '0';
  const size = Math.abs(value);
  const isPlain = size < 1e5 && size >= 1e-3;
  const text = isPlain ? String(Number(value.toPrecision(count))) : value.toExponential(count - 1).replace(/\.?0+e/, 'e').replace('e+', 'e');
  return text.replaceAll('-', '\u2212');
}

/** A number to the last digit that a step changes. */
export function rounded(value, step) {
  const size = Math.abs(value);
  if (!(size > 0.5 * step)) return '0';
  const count = Math.floor(Math.log10(size) + 1e-9) - Math.floor(Math.log10(step) + 1e-9) + 1;
  return digits(value, Math.min(Math.max(count, 1), 9));
}
