// Names at places of the view: elements over the stage that follow the camera. A name that would cover another is left out; what the surface
// hides is pale.
import { element } from './dom.js';

const rest = 150; // ms without a turn, after which hidden places are found
const mostTests = 3e7; // triangles times places

export class Labels {
  /** `items`: [{text, kind, places, colour, owner}], the important ones first. A name stands at the first of its places that is not hidden. */
  constructor(view, items) {
    this.view = view;
    this.node = element('div', { class: 'labels', 'aria-hidden': 'true' });
    this.items = items.map((item) => {
      const node = element('span', { class: 'label3d' }, element('span', { class: 'swatch', style: `background: ${item.colour}` }), ` ${item.text}`);
      this.node.append(node);
      return { ...item, node, place: item.places[0], isHidden: false };
    });
    this.isShown = { region: true, curve: true };
    this.first = null;
  }

  /** Labels of the chosen owner are placed before all others. */
  choose(owner) {
    this.first = owner;
    this.place();
  }

  show(kind, is) {
    this.isShown[kind] = is;
    this.place();
  }

  /** Called when the camera or the size has changed. */
  follow() {
    if (!this.frame) this.frame = requestAnimationFrame(() => this.place());
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.findHidden(), rest);
  }

  place() {
    this.frame = undefined;
    const { width, height } = this.view.container.getBoundingClientRect();
    const taken = [];
    const isChosen = (item) => item.owner === this.first;
    const order = [...this.items].sort((a, b) => isChosen(b) - isChosen(a) || a.isHidden - b.isHidden);
    for (const item of order) {
      const { node } = item;
      if (!this.isShown[item.kind] && !isChosen(item)) {
        node.hidden = true;
        continue;
      }
      node.hidden = false;
      item.size ??= { width: node.offsetWidth, height: node.offsetHeight };
      const [x, y] = this.view.project(item.place);
      const box = { left: x - item.size.width / 2, top: y - item.size.height - 7, ...item.size };
      const isFree = taken.every((b) => box.left > b.left + b.width || box.left + box.width < b.left || box.top > b.top + b.height || box.top + box.height < b.top);
      node.hidden = !(isFree && x > 0 && x < width && y > 0 && y < height);
      if (node.hidden) continue;
      taken.push(box);
      node.style.transform = `translate(${Math.round(box.left)}px, ${Math.round(box.top)}px)`;
      node.classList.toggle('chosen', isChosen(item));
    }
  }

  findHidden() {
    const places = this.items.reduce((sum, item) => sum + item.places.length, 0);
    if (places * (this.view.cells.polys.length / 4) > mostTests) return;
    for (const item of this.items) {
      // A name stays where it is while it can be seen.
      const seen = [item.place, ...item.places].find((place) => !this.view.hides(place));
      item.isHidden = !seen;
      item.place = seen ?? item.places[0];
      item.node.classList.toggle('hidden3d', item.isHidden);
    }
    this.place();
  }

  /** On a saved picture, `scale` times as large as the stage. */
  draw(context, scale, colour) {
    const stage = this.node.getBoundingClientRect();
    context.save();
    context.font = `600 ${12 * scale}px system-ui, sans-serif`;
    context.textAlign = 'left';
    context.textBaseline = 'middle';
    for (const { node, text, isHidden } of this.items) {
      if (node.hidden) continue;
      const box = node.getBoundingClientRect();
      const [left, top] = [scale * (box.left - stage.left), scale * (box.top - stage.top)];
      context.globalAlpha = isHidden ? 0.45 : 1;
      context.fillStyle = getComputedStyle(node).backgroundColor;
      context.fillRect(left, top, scale * box.width, scale * box.height);
      context.fillStyle = getComputedStyle(node.firstChild).backgroundColor;
      context.fillRect(left + 5 * scale, top + (scale * box.height) / 2 - 4 * scale, 8 * scale, 8 * scale);
      context.fillStyle = colour;
      context.fillText(text, left + 17 * scale, top + (scale * box.height) / 2);
    }
    context.restore();
  }
}
