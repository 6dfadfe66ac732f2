// What may be shown as colours: each component of each field, and the length of each vector.

const axes = ['X', 'Y', 'Z'];

function length(rows) {
  return Float32Array.from(rows[0], (_, i) => Math.hypot(...rows.map((row) => row[i])));
}

const withUnit = (label, unit) => (unit === '1' ? label : `${label} [${unit}]`);

/** [{id, group, label, unit, values()}], in the order of the table of fields. */
export function quantitiesOf(scene) {
  const all = [];
  for (const field of scene.fields) {
    const add = (part, label, values) =>
      all.push({ id: `${field.key}:${part}`, group: `${field.arrays[0].split('_')[0]}: ${field.meaning}`, label: withUnit(label, field.unit), unit: field.unit, values });
    if (field.arrays.length === 1 && field.rows.length === 3) {
      add('length', `|${field.arrays[0]}|`, () => length(field.rows));
      field.rows.forEach((row, d) => add(axes[d], `${field.arrays[0]} ${axes[d]}`, () => row));
    } else {
      field.rows.forEach((row, k) => add(String(k), field.arrays[k], () => row));
    }
  }
  return all;
}

/** Pressure where there is contact, else the displacement. */
export function defaultQuantity(scene) {
  const pressure = scene.fields.find((field) => field.key === 'eta');
  return pressure && pressure.rows[0].some((value) => value > 0) ? 'eta:0' : 'u:length';
}

/** The least and the largest value; the same number twice where they differ by no more than what single precision and rounding leave. */
export function rangeOf(values) {
  let low = Infinity;
  let high = -Infinity;
  for (const value of values)
    if (Number.isFinite(value)) {
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  if (low > high) return [0, 0];
  return high - low > 1e-5 * Math.max(Math.abs(low), Math.abs(high)) ? [low, high] : [(low + high) / 2, (low + high) / 2];
}

/** Four digits or so, without an exponent where that is short. */
export function shown(value, digits = 4) {
  if (!Number.isFinite(value)) return 'none';
  return Number(value.toPrecision(digits)).toString().replace('e+', 'e');
}
