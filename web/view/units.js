// Numbers as people write them.
const PREFIX = [[1e-12, 'p'], [1e-9, 'n'], [1e-6, '\u00b5'], [1e-3, 'm'], [1, ''], [1e3, 'k'], [1e6, 'M'], [1e9, 'G']];

function digits(value, n) {
  return Number.isFinite(value) ? String(Number(value.toPrecision(n))) : '-';
}

function prefixFor(size) {
  if (!(size > 0) || !Number.isFinite(size)) return [1, ''];
  return [...PREFIX].reverse().find(([factor]) => size >= 0.9995 * factor) ?? PREFIX[0];
}

/// A value of an SI unit with the prefix that leaves 1 to 1000 before the point.
export function si(value, unit, n = 4) {
  const [factor, prefix] = prefixFor(Math.abs(value));
  return `${digits(value / factor, n)} ${prefix}${unit}`.trim();
}

/// A length of the assembly; without a unit of length the bare number.
export function length(data, value, n = 4) {
  return data.unit === 'm' ? si(value * data.length, 'm', n) : digits(value * data.length, n);
}

/// Several in one unit, by the greatest.
export function lengths(data, values, n = 4) {
  if (data.unit !== 'm') return values.map((v) => digits(v * data.length, n)).join(', ');
  const [factor, prefix] = prefixFor(Math.max(...values.map(Math.abs)) * data.length);
  return `${values.map((v) => digits((v * data.length) / factor, n)).join(', ')} ${prefix}m`;
}

export function volume(data, value) {
  if (data.unit !== 'm') return digits(value * data.length ** 3, 4);
  const edge = Math.cbrt(value) * data.length;
  const [factor, unit] = edge < 0.9995e-3 ? [1e-6, '\u00b5m'] : edge < 0.9995 ? [1e-3, 'mm'] : [1, 'm'];
  return `${digits((edge / factor) ** 3, 4)} ${unit}\u00b3`;
}

/// 1, 2 or 5 times a power of ten, at most `value`.
export function roundBelow(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  const digit = value / power;
  return (digit >= 5 ? 5 : digit >= 2 ? 2 : 1) * power;
}

/// Marks of a bar of forces: powers of ten, or 1, 2, 5 where they are few.
export function logTicks(low, high, unit) {
  const ticks = [];
  const few = high / low < 300 ? [1, 2, 5] : [1];
  for (let p = Math.floor(Math.log10(low)); p <= Math.ceil(Math.log10(high)); p += 1) {
    for (const k of few) {
      const value = k * 10 ** p;
      const place = Math.log(value / low) / Math.log(high / low);
      if (place > -1e-9 && place < 1 + 1e-9) ticks.push([place, si(value, unit, 3)]);
    }
  }
  return ticks;
}
