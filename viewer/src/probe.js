// The table of all fields at one point of the shell.
import { element } from './dom.js';
import { shown } from './quantities.js';

export class Probe {
  constructor(scene) {
    this.scene = scene;
    this.node = element('div', { class: 'probe', 'aria-live': 'polite' });
    this.show(-1);
  }

  show(point) {
    if (point < 0) {
      this.node.replaceChildren(element('p', { class: 'note' }, 'Click on the shell to see all values at the nearest point.'));
      return;
    }
    const rows = this.scene.fields.map((field) =>
      element(
        'tr',
        { title: field.meaning, 'data-key': field.key },
        element('td', { class: 'word' }, field.arrays.join(', ')),
        element('td', {}, field.rows.map((row) => shown(row[point])).join(', ')),
        element('td', { class: 'word' }, field.unit === '1' ? '' : field.unit),
      ),
    );
    this.node.replaceChildren(element('div', { class: 'wide' }, element('table', {}, element('tbody', {}, ...rows))));
  }
}
