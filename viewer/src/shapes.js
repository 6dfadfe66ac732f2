// Points of the deformed shell and of the lines on it, for any scale of the displacements.

/** a + scale b, into `out`. */
export function moved(a, scale, b, out) {
  for (let i = 0; i < a.length; ++i) out[i] = a[i] + scale * b[i];
  return out;
}

/** Directors a3 + scale r of length 1: normals of the deformed shell, but for its shear. */
export function directors(normal, scale, r, out) {
  return unit(moved(normal, scale, r, out));
}

function unit(vectors) {
  for (let i = 0; i < vectors.length; i += 3) {
    const size = Math.hypot(vectors[i], vectors[i + 1], vectors[i + 2]) || 1;
    for (let d = 0; d < 3; ++d) vectors[i + d] /= size;
  }
  return vectors;
}

/** Normals of a surface of triangles (vtk.js's polys) at its points. */
export function normalsOf(points, polys) {
  const out = new Float32Array(points.length);
  for (let t = 0; t < polys.length; t += 4) {
    const [a, b, c] = polys.subarray(t + 1, t + 4).map((p) => 3 * p);
    const side = (to, d) => points[to + d] - points[a + d];
    for (let d = 0; d < 3; ++d) {
      const [e, f] = [(d + 1) % 3, (d + 2) % 3];
      const part = side(b, e) * side(c, f) - side(b, f) * side(c, e);
      for (const p of [a, b, c]) out[p + d] += part;
    }
  }
  return unit(out);
}

/** Points after a rotation (row by row) and a translation. */
export function placed(points, { rotation, translation }) {
  const out = new Float32Array(points.length);
  for (let i = 0; i < points.length; i += 3)
    for (let d = 0; d < 3; ++d) {
      out[i + d] = translation[d];
      for (let k = 0; k < 3; ++k) out[i + d] += rotation[3 * d + k] * points[i + k];
    }
  return out;
}

/** [xmin, xmax, ymin, ...] of points. */
export function boundsOf(points) {
  const bounds = [Infinity, -Infinity, Infinity, -Infinity, Infinity, -Infinity];
  for (let i = 0; i < points.length; ++i) {
    const d = i % 3;
    bounds[2 * d] = Math.min(bounds[2 * d], points[i]);
    bounds[2 * d + 1] = Math.max(bounds[2 * d + 1], points[i]);
  }
  return bounds;
}

export const diagonal = (b) => Math.hypot(b[1] - b[0], b[3] - b[2], b[5] - b[4]);

/** The number of the point nearest to p. */
export function nearest(points, p) {
  let best = 0;
  let least = Infinity;
  for (let i = 0; i < points.length; i += 3) {
    const distance = (points[i] - p[0]) ** 2 + (points[i + 1] - p[1]) ** 2 + (points[i + 2] - p[2]) ** 2;
    if (distance < least) {
      least = distance;
      best = i / 3;
    }
  }
  return best;
}

/** Lines on the touching face, put on the mid-surface that is drawn: half a thickness back along the normal of the nearest point. */
export function linesOnSurface(scene) {
  return scene.lines.map((line) => {
    const points = line.points.slice();
    for (let i = 0; i < points.length; i += 3) {
      const p = nearest(scene.position, points.subarray(i, i + 3));
      let height = 0;
      for (let d = 0; d < 3; ++d) height += (points[i + d] - scene.position[3 * p + d]) * scene.normal[3 * p + d];
      const back = (Math.sign(height) * scene.thickness[p]) / 2;
      for (let d = 0; d < 3; ++d) points[i + d] -= back * scene.normal[3 * p + d];
    }
    return { ...line, points };
  });
}

const sides = 8;

function crossed(a, b) {
  const c = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const size = Math.hypot(...c) || 1;
  return c.map((value) => value / size);
}

/** Tubes round polylines, as screens draw lines of one pixel only: {points, polys}. `radius` is one number, or one for each line. */
export function tubes(polylines, radius) {
  const radiusOf = typeof radius === 'number' ? () => radius : (k) => radius[k];
  const count = polylines.reduce((sum, line) => sum + line.length / 3, 0);
  const points = new Float32Array(3 * sides * count);
  const polys = [];
  let first = 0;
  for (const [number, line] of polylines.entries()) {
    const n = line.length / 3;
    const thick = radiusOf(number);
    for (let k = 0; k < n; ++k) {
      const before = 3 * Math.max(k - 1, 0);
      const after = 3 * Math.min(k + 1, n - 1);
      const along = [0, 1, 2].map((d) => line[after + d] - line[before + d]);
      const least = along.map(Math.abs).indexOf(Math.min(...along.map(Math.abs)));
      const e1 = crossed(along, [0, 1, 2].map((d) => (d === least ? 1 : 0)));
      const e2 = crossed(along, e1);
      for (let s = 0; s < sides; ++s) {
        const c = thick * Math.cos((2 * Math.PI * s) / sides);
        const z = thick * Math.sin((2 * Math.PI * s) / sides);
        for (let d = 0; d < 3; ++d) points[3 * (first + sides * k + s) + d] = line[3 * k + d] + c * e1[d] + z * e2[d];
      }
      for (let s = 0; k > 0 && s < sides; ++s) {
        const [a, b] = [first + sides * (k - 1) + s, first + sides * (k - 1) + ((s + 1) % sides)];
        polys.push(4, a, b, b + sides, a + sides);
      }
    }
    first += sides * n;
  }
  return { points, polys: Uint32Array.from(polys) };
}

/** The dashes of a polyline: one for each period of its length, but at least one. */
export function dashes(line, period) {
  const at = [0];
  for (let i = 3; i < line.length; i += 3) at.push(at.at(-1) + Math.hypot(line[i] - line[i - 3], line[i + 1] - line[i - 2], line[i + 2] - line[i - 1]));
  const length = at.at(-1);
  const count = Math.max(1, Math.round(length / period));
  const place = (s) => {
    let k = 1;
    while (k < at.length - 1 && at[k] < s) ++k;
    const t = (s - at[k - 1]) / (at[k] - at[k - 1] || 1);
    return [0, 1, 2].map((d) => (1 - t) * line[3 * k - 3 + d] + t * line[3 * k + d]);
  };
  return Array.from({ length: count }, (_, n) => {
    const [from, to] = [0.2, 0.8].map((part) => ((n + part) * length) / count);
    const between = at.flatMap((s, k) => (s > from && s < to ? [...line.subarray(3 * k, 3 * k + 3)] : []));
    return Float32Array.from([...place(from), ...between, ...place(to)]);
  });
}

/** Two unit vectors at right angles to a unit vector and to each other. */
function across(n) {
  const least = n.map(Math.abs).indexOf(Math.min(...n.map(Math.abs)));
  const e1 = crossed(n, [0, 1, 2].map((d) => (d === least ? 1 : 0)));
  return [e1, crossed(n, e1)];
}

const ring = (n, place, radius) => {
  const [e1, e2] = across(n);
  return Array.from({ length: sides }, (_, s) => {
    const [c, z] = [radius * Math.cos((2 * Math.PI * s) / sides), radius * Math.sin((2 * Math.PI * s) / sides)];
    return place.map((x, d) => x + c * e1[d] + z * e2[d]);
  }).flat();
};

/** Arrows of a length that begin at places, along unit vectors: {points, polys}. */
export function arrows(places, directions, length) {
  const points = [];
  const polys = [];
  places.forEach((place, k) => {
    const n = directions[k];
    const along = (t) => place.map((x, d) => x + t * length * n[d]);
    const first = points.length / 3;
    points.push(...ring(n, place, 0.03 * length), ...ring(n, along(0.68), 0.03 * length), ...ring(n, along(0.68), 0.11 * length), ...along(1));
    for (let s = 0; s < sides; ++s) {
      const next = (s + 1) % sides;
      polys.push(4, first + s, first + next, first + sides + next, first + sides + s);
      polys.push(3, first + 2 * sides + s, first + 2 * sides + next, first + 3 * sides);
    }
    polys.push(sides, ...Array.from({ length: sides }, (_, s) => first + 2 * sides + s));
  });
  return { points: Float32Array.from(points), polys: Uint32Array.from(polys) };
}

/** Discs on both sides of a surface, `lift` above it: {points, polys}. */
export function discs(places, normals, radii, lift) {
  const points = [];
  const polys = [];
  places.forEach((place, k) => {
    for (const side of [1, -1]) {
      const first = points.length / 3;
      points.push(...ring(normals[k], place.map((x, d) => x + side * lift * normals[k][d]), radii[k]));
      polys.push(sides, ...Array.from({ length: sides }, (_, s) => first + s));
    }
  });
  return { points: Float32Array.from(points), polys: Uint32Array.from(polys) };
}
