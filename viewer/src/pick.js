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

/** Whether a triangle lies between a point and the eye. A part `near` of the way is left out at the point. */
export function isHidden(points, polys, eye, point, near = 0.004) {
  const [dx, dy, dz] = minus(point, eye);
  for (let k = 0; k < polys.length; k += 4) {
    const [a, b, c] = [3 * polys[k + 1], 3 * polys[k + 2], 3 * polys[k + 3]];
    // As in meeting(), without arrays: it runs for each name.
    const [abx, aby, abz] = [points[b] - points[a], points[b + 1] - points[a + 1], points[b + 2] - points[a + 2]];
    const [acx, acy, acz] = [points[c] - points[a], points[c + 1] - points[a + 1], points[c + 2] - points[a + 2]];
    const [px, py, pz] = [dy * acz - dz * acy, dz * acx - dx * acz, dx * acy - dy * acx];
    const determinant = abx * px + aby * py + abz * pz;
    if (determinant === 0) continue;
    const [sx, sy, sz] = [eye[0] - points[a], eye[1] - points[a + 1], eye[2] - points[a + 2]];
    const u = (sx * px + sy * py + sz * pz) / determinant;
    if (u < 0 || u > 1) continue;
    const [qx, qy, qz] = [sy * abz - sz * aby, sz * abx - sx * abz, sx * aby - sy * abx];
    const v = (dx * qx + dy * qy + dz * qz) / determinant;
    if (v < 0 || u + v > 1) continue;
    const t = (acx * qx + acy * qy + acz * qz) / determinant;
    if (t > 0 && t < 1 - near) return true;
  }
  return false;
}
