// How the points of drawn cells are joined: triangles to fill them, lines along their sides. Points of a cell are a lattice, the first
// coordinate fastest; a triangle's lattice has one point less in each row.

/** Of one cell: {points, triangles: [[a, b, c]], sides: [[a, b, ...]]} with numbers of its points. */
function pattern(shape, n) {
  const isTriangle = shape === 'triangle';
  const start = [0];
  for (let j = 0; j <= n; ++j) start.push(start[j] + (isTriangle ? n - j : n) + 1);
  const at = (i, j) => start[j] + i;
  const triangles = [];
  for (let j = 0; j < n; ++j)
    for (let i = 0; i < (isTriangle ? n - j : n); ++i) {
      triangles.push([at(i, j), at(i + 1, j), at(i, j + 1)]);
      if (!isTriangle || i + 1 < n - j) triangles.push([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
    }
  const along = [...Array(n + 1).keys()];
  const sides = isTriangle
    ? [along.map((k) => at(k, 0)), along.map((k) => at(n - k, k)), along.map((k) => at(0, n - k))]
    : [along.map((k) => at(k, 0)), along.map((k) => at(n, k)), along.map((k) => at(k, n)), along.map((k) => at(0, k))];
  return { points: start[n + 1], triangles, sides };
}

/** vtk.js cell arrays (count, then numbers) of all cells. */
export function cellArrays(shape, n, cells) {
  const one = pattern(shape, n);
  const polys = new Uint32Array(4 * one.triangles.length * cells);
  const lines = new Uint32Array(one.sides.length * (n + 2) * cells);
  let p = 0;
  let l = 0;
  for (let cell = 0; cell < cells; ++cell) {
    const first = cell * one.points;
    for (const triangle of one.triangles) {
      polys[p++] = 3;
      for (const corner of triangle) polys[p++] = first + corner;
    }
    for (const side of one.sides) {
      lines[l++] = side.length;
      for (const point of side) lines[l++] = first + point;
    }
  }
  return { polys, lines };
}

/** Number of points of a cell. */
export const pointsPerCell = (shape, n) => pattern(shape, n).points;

/** The middle of a cell as it is drawn: [[point, weight], ...] with numbers of its points. */
export function middleOf(shape, n) {
  if (shape === 'triangle') {
    const start = (j) => j * (n + 1) - (j * (j - 1)) / 2;
    const at = (i, j) => start(j) + i;
    const k = Math.floor(n / 3);
    const rest = n / 3 - k; // in the small triangle at (k, k), or in the turned one beside it
    return 2 * rest <= 1
      ? [[at(k, k), 1 - 2 * rest], [at(k + 1, k), rest], [at(k, k + 1), rest]].filter(([, weight]) => weight > 1e-9)
      : [[at(k + 1, k + 1), 2 * rest - 1], [at(k + 1, k), 1 - rest], [at(k, k + 1), 1 - rest]];
  }
  const at = (i, j) => (n + 1) * j + i;
  const k = Math.floor(n / 2);
  return n % 2 === 0 ? [[at(k, k), 1]] : [[at(k + 1, k), 0.5], [at(k, k + 1), 0.5]];
}
