// The scenes of the pages as typed arrays: what report/report_scene.cc and report/surface_scene.cc write.

function bytesOf(text) {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; ++i) bytes[i] = letters.charCodeAt(i);
  return bytes.buffer;
}

const floats = (text) => new Float32Array(bytesOf(text));
const numbers = (text) => new Uint32Array(bytesOf(text));

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

/** An instant of the steps: {time, step, u, r, eta, obstacles: [{rotation, translation}]}. */
function readFrame(frame, points) {
  const rows = (name) => (frame[name] ?? []).map((values) => row(values, points));
  return { ...frame, rows: { u: rows('u'), r: rows('r'), eta: rows('eta') }, u: interleaved(rows('u')), r: interleaved(rows('r')) };
}

/**
 * Returns {shape, subdivisions, cells, points, merged, fields, position, u, r, normal, obstacles, lines, supports, loads, frames, modes, touchesOnAreas}. The last frame is
 * the solution, with all fields; there is no other without steps. Modes are frames, too: their displacement is a field of the solution.
 */
export function readScene(json) {
  const fields = json.fields.map((field) => ({
    ...field,
    rows: field.values.map((values) => row(values, json.points)),
    values: undefined,
  }));
  const field = (key) => fields.find((f) => f.key === key);
  const u = interleaved(field('u').rows);
  const r = interleaved(field('r').rows);
  const modeOf = ({ key, rows }) => ({ key, time: json.time, rows: { [key]: rows }, u: interleaved(rows) });
  return {
    ...json,
    fields,
    frames: [...json.frames.map((frame) => readFrame(frame, json.points)), { time: json.time, u, r }],
    modes: fields.filter((f) => f.is_mode).map(modeOf),
    position: interleaved(field('position').rows),
    u,
    r,
    normal: interleaved(field('frame/a3').rows),
    thickness: field('thickness').rows[0],
    obstacles: json.obstacles.map((o) => ({
      name: o.name,
      points: floats(o.points),
      triangles: numbers(o.triangles),
    })),
    lines: json.lines.map(polyline),
    touchesOnAreas: json.touches_on_areas,
    supports: json.supports.map(polyline),
    loads: { places: floats(json.loads.places), displacements: floats(json.loads.displacements), directions: floats(json.loads.directions) },
  };
}

/** A mesh in space. Its points are relative to `origin`; `edges` and `curves` as in report/surface_scene.hpp. */
export function readParts(json) {
  const { edges } = json;
  return {
    ...json,
    position: floats(json.positions),
    normal: floats(json.normals),
    region: numbers(json.region),
    line: numbers(json.line),
    turned: numbers(json.turned),
    number: new Float64Array(bytesOf(json.number)),
    edges: {
      kinds: edges.kinds,
      kind: numbers(edges.kind),
      angle: floats(edges.angle),
      doubtful: numbers(edges.doubtful),
      places: numbers(edges.places),
      sides: numbers(edges.sides),
    },
    curves: json.curves.map((curve) => ({ ...curve, edges: numbers(curve.edges), marks: numbers(curve.marks) })),
  };
}
