// The scene of report.html as typed arrays: what io/report_scene.cc writes.

function bytesOf(text) {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; ++i) bytes[i] = letters.charCodeAt(i);
  return bytes.buffer;
}

const floats = (text) => new Float32Array(bytesOf(text));

/** A row of `points` values; one number stands for all. */
function row(values, points) {
  return typeof values === 'string' ? floats(values) : new Float32Array(points).fill(values ?? NaN);
}

/** Components of three-vectors next to each other. */
function interleaved(rows) {
  const all = new Float32Array(3 * rows[0].length);
  for (let i = 0; i < rows[0].length; ++i) for (let d = 0; d < 3; ++d) all[3 * i + d] = rows[d][i];
  return all;
}

const polyline = (line) => ({ ...line, points: floats(line.points), displacements: floats(line.displacements) });

/** Returns {shape, subdivisions, cells, points, merged, fields, position, u, r, normal, obstacles, lines, supports}. */
export function readScene(json) {
  const fields = json.fields.map((field) => ({
    ...field,
    rows: field.values.map((values) => row(values, json.points)),
    values: undefined,
  }));
  const field = (key) => fields.find((f) => f.key === key);
  return {
    ...json,
    fields,
    position: interleaved(field('position').rows),
    u: interleaved(field('u').rows),
    r: interleaved(field('r').rows),
    normal: interleaved(field('frame/a3').rows),
    thickness: field('thickness').rows[0],
    obstacles: json.obstacles.map((o) => ({
      name: o.name,
      points: floats(o.points),
      triangles: new Uint32Array(bytesOf(o.triangles)),
    })),
    lines: json.lines.map(polyline),
    supports: json.supports.map(polyline),
  };
}
