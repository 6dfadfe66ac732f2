// The picture of a mesh in space: its upper and lower side in the colours of the regions, edges by kind, turned cells, normals.
import { middleOf, pointsPerCell } from './cells.js';
import { distinctColours, mixed } from './colours.js';
import { arrows, discs } from './shapes.js';
import { layer, normalsArray, View } from './view.js';

const flat = { lighting: false };
const nothing = () => ({ polys: new Uint32Array(0) });
const shadow = [58, 62, 70]; // of the lower side
const faded = [205, 209, 214]; // regions that are not chosen

/** Lines of many cells would hide the colours. */
const meshOpacity = (cells) => Math.min(0.3, Math.max(0.06, 0.3 * Math.sqrt(4000 / cells)));

export const underOf = (colour) => mixed(colour, shadow, 0.5);

export class PartsView extends View {
  constructor(container, scene) {
    super(container, scene);
    this.perCell = pointsPerCell(scene.shape, scene.subdivisions);
    this.middle = middleOf(scene.shape, scene.subdivisions);
    this.colours = distinctColours(scene.regions.length);
    this.thick = 0.0022 * this.size;
    this.addLayers();
    this.paint(-1);
    this.resize();
  }

  addLayers() {
    const { renderer, scene, cells } = this;
    const lit = { ambient: 0.68, diffuse: 0.36, specular: 0 }; // a slanted upper side stays lighter than the lower one
    this.upper = this.addSurface({ ...lit, backfaceCulling: true });
    this.under = this.addSurface({ ...lit, frontfaceCulling: true });
    this.surface = [this.upper, this.under];
    for (const side of this.surface) side.data.getPointData().setNormals(normalsArray(scene.normal));
    this.edges = layer(renderer, this.points, { lines: cells.lines }, { ...flat, opacity: meshOpacity(scene.cells) });
    this.kinds = scene.edges.kinds.map(() => layer(renderer, new Float32Array(0), nothing(), { ...flat }));
    this.doubtful = layer(renderer, new Float32Array(0), nothing(), { ...flat });
    this.chosen = layer(renderer, new Float32Array(0), nothing(), { ...flat });
    this.turned = layer(renderer, new Float32Array(0), nothing(), { ...flat });
    this.arrows = layer(renderer, new Float32Array(0), nothing(), { ambient: 0.6, diffuse: 0.4 });
    this.addMark();
    this.drawEdges();
    this.drawTurned();
    this.drawArrows();
  }

  /** Colours of the page, each [r, g, b] from 0 to 1; `kinds` in the order of the scene's. */
  setTheme(theme) {
    this.edges.actor.getProperty().setColor(...theme.line);
    this.kinds.forEach((kind, k) => kind.actor.getProperty().setColor(...theme[`kind${k}`]));
    for (const name of ['doubtful', 'chosen', 'turned', 'arrows']) this[name].actor.getProperty().setColor(...theme[name]);
    super.setTheme(theme);
  }

  /** Points of an edge, one after the other. */
  edgeLine(edge) {
    const n = this.scene.subdivisions + 1;
    const line = new Float32Array(3 * n);
    for (let k = 0; k < n; ++k) line.set(this.points.subarray(3 * this.scene.edges.places[n * edge + k]).subarray(0, 3), 3 * k);
    return line;
  }

  /** Edges with a name that a case can have are thicker. */
  drawEdges() {
    const { kind, doubtful } = this.scene.edges;
    const named = new Uint8Array(kind.length);
    for (const curve of this.scene.curves) if (curve.is_name) for (const edge of curve.edges) named[edge] = 1;
    const all = [...kind.keys()];
    this.kinds.forEach((target, k) => {
      const edges = all.filter((edge) => kind[edge] === k);
      this.drawTubes(target, edges.map((edge) => this.edgeLine(edge)), edges.map((edge) => (named[edge] ? 1.3 : 0.75) * this.thick));
    });
    this.drawTubes(this.doubtful, all.filter((edge) => doubtful[edge]).map((edge) => this.edgeLine(edge)), 1.8 * this.thick);
  }

  /** The edges of a curve, thicker than the others; none: -1. */
  choose(curve) {
    const edges = curve < 0 ? [] : [...this.scene.curves[curve].edges];
    this.drawTubes(this.chosen, edges.map((edge) => this.edgeLine(edge)), 2.6 * this.thick);
    this.render();
  }

  /** The drawn middle of a cell and a3 there. */
  middleOfCell(cell) {
    const sum = (values) => [0, 1, 2].map((d) => this.middle.reduce((s, [point, weight]) => s + weight * values[3 * (cell * this.perCell + point) + d], 0));
    const normal = sum(this.scene.normal);
    const length = Math.hypot(...normal) || 1;
    return { place: sum(this.points), normal: normal.map((x) => x / length) };
  }

  drawTurned() {
    const cells = [...this.scene.turned.keys()].filter((cell) => this.scene.turned[cell]);
    const middles = cells.map((cell) => this.middleOfCell(cell));
    const radii = cells.map((cell, k) => {
      let nearest = Infinity;
      for (let i = 0; i < this.perCell; ++i) {
        const away = this.pointAt(cell * this.perCell + i).map((x, d) => x - middles[k].place[d]);
        if (Math.hypot(...away) > 1e-9 * this.size) nearest = Math.min(nearest, Math.hypot(...away) * Math.max(1, this.scene.subdivisions / 2));
      }
      return Math.min(0.22 * nearest, 0.01 * this.size);
    });
    this.setShape(this.turned, discs(middles.map((m) => m.place), middles.map((m) => m.normal), radii, 0.0012 * this.size));
  }

  /** An arrow for each region in each box of a grid, at the cell that is nearest to the middle of the box. */
  drawArrows() {
    const width = this.size / 9;
    const taken = new Map();
    for (let cell = 0; cell < this.scene.cells; ++cell) {
      const middle = this.middleOfCell(cell);
      const box = middle.place.map((x) => Math.floor(x / width + 0.37));
      const away = Math.hypot(...middle.place.map((x, d) => x / width + 0.37 - box[d] - 0.5));
      const key = `${this.scene.region[cell]} ${box}`;
      if (!(taken.get(key)?.away <= away)) taken.set(key, { ...middle, away });
    }
    const middles = [...taken.values()];
    const lifted = middles.map((m) => m.place.map((x, d) => x + 0.002 * this.size * m.normal[d])); // hidden from below
    this.setShape(this.arrows, arrows(lifted, middles.map((m) => m.normal), 0.05 * this.size));
  }

  outline() {
    const tips = this.arrows.data.getPoints().getData();
    const all = new Float32Array(this.points.length + tips.length);
    all.set(this.points);
    all.set(tips, this.points.length);
    return all;
  }

  setShape(target, { points, polys }) {
    target.data.getPolys().setData(polys);
    target.move(points);
  }

  /** Colours the regions; with a chosen one the others are grey. */
  paint(region) {
    const { scene, perCell } = this;
    for (const [side, toShade] of [[this.upper, (c) => c], [this.under, underOf]]) {
      const colours = new Uint8Array(3 * perCell * scene.cells);
      const shades = this.colours.map((colour, k) => toShade(region < 0 || region === k ? colour : faded));
      for (let cell = 0; cell < scene.cells; ++cell)
        for (let i = 0; i < perCell; ++i) colours.set(shades[scene.region[cell]], 3 * (cell * perCell + i));
      this.setSurfaceColours(side, colours);
    }
    this.render();
  }

  seeThrough(is) {
    for (const { actor } of this.surface) actor.getProperty().setOpacity(is ? 0.35 : 1);
    this.render();
  }
}
