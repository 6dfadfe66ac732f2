// What is known of a cell of a mesh in space and of its edges.
import { element } from './dom.js';
import { shown } from './quantities.js';

const places = (v) => `(${v.map((x) => shown(x, 5)).join(', ')})`;

const row = (key, label, ...content) => element('tr', { 'data-key': key }, element('td', { class: 'word' }, label), element('td', { class: 'word' }, ...content));

export class PartsProbe {
  constructor(view) {
    this.view = view;
    this.scene = view.scene;
    this.curvesOf = new Map(); // of an edge: its curves
    this.scene.curves.forEach((curve) => curve.edges.forEach((edge) => this.curvesOf.set(edge, [...(this.curvesOf.get(edge) ?? []), curve])));
    this.node = element('div', { class: 'probe', 'aria-live': 'polite' });
    this.show(-1);
  }

  /** Of the cell that has a point; -1: none. */
  show(point) {
    this.node.replaceChildren();
    if (point < 0) return;
    const { scene, view } = this;
    const cell = Math.floor(point / view.perCell);
    const region = scene.regions[scene.region[cell]];
    const line = scene.line[cell] > 0 ? `, line ${scene.line[cell]} of the file` : '';
    const rows = [
      row('region', 'region', element('strong', {}, region.name), ...(region.is_name ? [' in a case: ', element('code', {}, `region = ${JSON.stringify(region.name)}`)] : [])),
      row('cell', 'cell', `element ${scene.number[cell]}${line}${scene.turned[cell] ? '; turned round: in the file its normal is the opposite' : ''}`),
      row('normal', 'normal a3 in its middle', places(view.middleOfCell(cell).normal)),
      row('place', `nearest drawn point [${scene.length}]`, places(view.pointAt(point).map((x, d) => x + scene.origin[d]))),
      ...this.edgeRows(cell),
    ];
    this.node.append(element('table', {}, element('tbody', {}, ...rows)));
  }

  edgeRows(cell) {
    const { edges, shape } = this.scene;
    const corners = shape === 'triangle' ? 3 : 4;
    const drawn = [...edges.sides.subarray(corners * cell, corners * (cell + 1))].filter((edge) => edge > 0).map((edge) => edge - 1);
    return drawn.map((edge) => {
      const curves = (this.curvesOf.get(edge) ?? []).filter((curve) => curve.is_name);
      const angle = edges.kind[edge] === 0 ? '' : ` at ${shown(edges.angle[edge], 3)} degrees`;
      const names = curves.flatMap((curve, k) => [k > 0 ? ', ' : ' in a case: ', element('code', {}, `boundary = ${JSON.stringify(curve.name)}`)]);
      return row('edge', 'edge', `${edges.kinds[edges.kind[edge]]}${angle}${edges.doubtful[edge] ? ', doubtful' : ''}`, ...names);
    });
  }
}
