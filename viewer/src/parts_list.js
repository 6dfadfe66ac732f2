// What stands beside the view of a mesh in space: regions and curves to choose, kinds of edges and other layers to show or hide.
import { checkbox, element } from './dom.js';

const css = (colour) => `rgb(${colour.join(' ')})`;

/** A list of buttons of which one or none is pressed: [{label, detail, swatches}]; action(number) or action(-1). */
class Choices {
  constructor(items, action) {
    this.action = action;
    this.buttons = items.map(({ label, detail, swatches }, k) => {
      const marks = swatches.map((colour) => element('span', { class: 'swatch', style: `background: ${colour}` }));
      const button = element('button', { type: 'button', 'aria-pressed': 'false' }, ...marks, element('span', { class: 'name' }, label), element('span', { class: 'detail' }, detail));
      button.addEventListener('click', () => this.choose(this.chosen === k ? -1 : k));
      return button;
    });
    this.chosen = -1;
    this.node = element('div', { class: 'choices' }, ...this.buttons);
  }

  choose(number) {
    this.chosen = number;
    this.buttons.forEach((button, k) => button.setAttribute('aria-pressed', String(k === number)));
    this.action(number);
  }
}

const counted = (number, one, several) => `${number} ${number === 1 ? one : several}`;

/** A list of regions; colours are [upper, lower]. */
export const regionChoices = (scene, colours, action) =>
  new Choices(scene.regions.map((region, k) => ({ label: region.name, detail: counted(region.cells, 'cell', 'cells'), swatches: colours[k].map(css) })), action);

export const curveChoices = (scene, action) =>
  new Choices(scene.curves.map((curve) => ({ label: curve.name, detail: curve.kinds || 'points', swatches: [`var(${kindVariable(firstKind(scene, curve))})`] })), action);

/** The variable of style.css with the colour of a kind of edges. */
export const kindVariable = (kind) => `--kind${kind}`;
export const firstKind = (scene, curve) => (curve.edges.length > 0 ? scene.edges.kind[curve.edges[0]] : 0);

/** Boxes for the kinds of edges that the mesh has. */
export function kindBoxes(scene, action) {
  const counts = scene.edges.kinds.map((_, k) => scene.edges.kind.reduce((sum, kind) => sum + (kind === k ? 1 : 0), 0));
  return scene.edges.kinds.flatMap((name, k) => (counts[k] > 0 ? [checkbox(`${name} (${counts[k]})`, true, (is) => action(k, is), kindVariable(k))] : []));
}

export const group = (title, ...nodes) => element('div', { class: 'group' }, element('h3', {}, title), ...nodes);
