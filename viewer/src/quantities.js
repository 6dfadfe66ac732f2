// What may be shown as colours: each component of each field, and the length of each vector.

const axes = ['X', 'Y', 'Z'];

function length(rows) {
  return Float32Array.from(rows[0], (_, i) => Math.hypot(...rows.map((row) => row[i])));
}

const withUnit = (label, unit) => (unit === '1' ? label : `${label} [${unit}]`);

/**
 * [{id, group, label, unit, values(frame)}], in the order of the table of fields. Frames before the last one have few fields; values() is undefined
 * where they have none.
 */
export function quantitiesOf(scene) {
  const all = [];
  for (const field of scene.fields) {
    const rowsIn = (frame) => (frame.rows ? frame.rows[field.key] : field.rows);
    const add = (part, label, values) =>
      all.push({
        id: `${field.key}:${part}`,
        group: `${field.arrays[0].split('_')[0]}: ${field.meaning}`,
        label: withUnit(label, field.unit),
        unit: field.unit,
        values: (frame) => rowsIn(frame) && values(rowsIn(frame)),
      });
    if (field.arrays.length === 1 && field.rows.length === 3) {
      add('length', `|${field.arrays[0]}|`, length);
      field.rows.forEach((_, d) => add(axes[d], `${field.arrays[0]} ${axes[d]}`, (rows) => rows[d]));
    } else {
      field.rows.forEach((_, k) => add(String(k), field.arrays[k], (rows) => rows[k]));
    }
  }
  return all;
}

/** The range of a quantity in all frames that have it. */
export function rangeInFrames(quantity, frames) {
  const ranges = frames.map((frame) => quantity.values(frame)).filter((values) => values?.length > 0).map(rangeOf);
  return [Math.min(...ranges.map(([low]) => low)), Math.max(...ranges.map(([, high]) => high))];
}

/** Pressure where the contact has an area, else the displacement: along lines the pressure depends on the mesh. */
export function defaultQuantity(scene) {
  return scene.touchesOnAreas ? 'eta:0' : 'u:length';
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
