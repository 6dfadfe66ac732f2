// The axes X, Y, Z as the camera sees them, in a corner of the view.

const names = ['X', 'Y', 'Z'];
const size = 64;

function svg(name, attributes) {
  const node = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  return node;
}

export class Triad {
  constructor() {
    this.node = svg('svg', { class: 'triad', width: size, height: size, viewBox: `${-size / 2} ${-size / 2} ${size} ${size}`, 'aria-hidden': 'true' });
    this.axes = names.map((name) => {
      const axis = { line: svg('line', { x1: 0, y1: 0 }), text: svg('text', {}) };
      axis.text.textContent = name;
      this.node.append(axis.line, axis.text);
      return axis;
    });
  }

  /** The camera's directions right and up; axis d goes to component d of both. */
  turn([right, up]) {
    this.axes.forEach(({ line, text }, d) => {
      const [x, y] = [20 * right[d], -20 * up[d]];
      line.setAttribute('x2', x);
      line.setAttribute('y2', y);
      text.setAttribute('x', 1.35 * x);
      text.setAttribute('y', 1.35 * y);
    });
  }
}
