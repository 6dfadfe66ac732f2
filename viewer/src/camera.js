// Where the camera stands so that all points fill the picture and none is cut off.

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

function unit(v) {
  const size = Math.hypot(...v);
  return v.map((value) => value / size);
}

/** The middle and the half width of points along a direction. */
function span(points, axis) {
  let [low, high] = [Infinity, -Infinity];
  for (let i = 0; i < points.length; i += 3) {
    const place = points[i] * axis[0] + points[i + 1] * axis[1] + points[i + 2] * axis[2];
    low = Math.min(low, place);
    high = Math.max(high, place);
  }
  return { middle: (low + high) / 2, half: (high - low) / 2 };
}

/** For a camera that looks along `direction` with an angle of `degrees` from bottom to top: {centre, distance}. */
export function fitted(points, direction, up, aspect, degrees) {
  const right = unit(cross(direction, up));
  const axes = [right, cross(right, direction), direction];
  const spans = axes.map((axis) => span(points, axis));
  const centre = [0, 1, 2].map((d) => axes.reduce((sum, axis, k) => sum + spans[k].middle * axis[d], 0));
  const tangent = Math.tan((degrees * Math.PI) / 360);
  const needed = Math.max(spans[1].half / tangent, spans[0].half / (tangent * aspect));
  return { centre, distance: 1.06 * (needed + spans[2].half) || 1 };
}
