// The point of the shell that a ray meets first.

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Where a ray meets a triangle (Moeller and Trumbore): {t, weights} or null. */
function meeting(origin, direction, a, b, c) {
  const ab = minus(b, a);
  const ac = minus(c, a);
  const p = cross(direction, ac);
  const determinant = dot(ab, p);
  if (determinant === 0) return null;
  const s = minus(origin, a);
  const u = dot(s, p) / determinant;
  if (u < 0 || u > 1) return null;
  const q = cross(s, ab);
  const v = dot(direction, q) / determinant;
  if (v < 0 || u + v > 1) return null;
  return { t: dot(ac, q) / determinant, weights: [1 - u - v, u, v] };
}

/** The number of the point nearest to where the ray first meets a triangle; -1 if it misses. `polys` as of cellArrays(). */
export function pickedPoint(points, polys, origin, direction) {
  const at = (i) => [points[3 * i], points[3 * i + 1], points[3 * i + 2]];
  let picked = -1;
  let first = Infinity;
  for (let k = 0; k < polys.length; k += 4) {
    const corners = [polys[k + 1], polys[k + 2], polys[k + 3]];
    const found = meeting(origin, direction, ...corners.map(at));
    if (found && found.t > 0 && found.t < first) {
      first = found.t;
      picked = corners[found.weights.indexOf(Math.max(...found.weights))];
    }
  }
  return picked;
}
