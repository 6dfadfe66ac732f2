// The bar that says which colour is which value, on the page and in saved pictures.
import { element } from './dom.js';
import { colourAt, gradient } from './colours.js';
import { shown } from './quantities.js';

const ticks = ([low, high]) => (high > low ? [0, 0.25, 0.5, 0.75, 1].map((t) => low + t * (high - low)) : [low]);

/** Every second tick where texts of this width, in px, would meet on a bar of `length` px. */
const withRoom = (values, widest, length) => (values.length > 1 && widest * 1.7 > length / (values.length - 1) ? values.filter((_, k) => k % 2 === 0) : values);

export class ScaleBar {
  constructor() {
    this.title = element('div', { class: 'bar-title' });
    this.bar = element('div', { class: 'bar-colours' });
    this.labels = element('div', { class: 'bar-labels' });
    this.node = element('div', { class: 'bar' }, this.title, this.bar, this.labels);
  }

  set(label, range, map) {
    Object.assign(this, { label, range, map });
    this.title.textContent = label;
    this.bar.style.background = gradient(map);
    this.labels.replaceChildren(...ticks(range).map((value) => element('span', {}, shown(value, 3))));
  }

  /** Draws itself at the lower left of a picture whose texts have `unit` px. */
  draw(context, height, unit, colour) {
    const [left, width, thick] = [unit, 22 * unit, unit];
    const top = height - 3.2 * unit;
    for (let i = 0; i < width; ++i) {
      context.fillStyle = `rgb(${colourAt(this.map, i / (width - 1))})`;
      context.fillRect(left + i, top, 1, thick);
    }
    context.fillStyle = colour;
    context.font = `${unit}px system-ui, sans-serif`;
    context.textAlign = 'left';
    context.fillText(this.label, left, top - 0.5 * unit);
    const all = ticks(this.range);
    const widest = Math.max(...all.map((value) => context.measureText(shown(value, 3)).width));
    const values = withRoom(all, widest, width);
    values.forEach((value, k) => {
      const t = values.length > 1 ? k / (values.length - 1) : 0;
      context.textAlign = t === 0 ? 'left' : t === 1 ? 'right' : 'center';
      context.fillText(shown(value, 3), left + t * width, top + thick + 1.2 * unit);
    });
  }
}
