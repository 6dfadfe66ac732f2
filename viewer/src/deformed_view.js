// The picture of report.html: the deformed shell, its undeformed mesh, obstacles, supports and contact boundaries.
import { directors, linesOnSurface, moved, tubes } from './shapes.js';
import { layer, normalsArray, View } from './view.js';

export class DeformedView extends View {
  constructor(container, scene) {
    super(container, scene);
    this.lines = linesOnSurface(scene);
    this.addLayers();
    this.setScale(0);
    this.resize();
  }

  addLayers() {
    const { renderer, scene, cells } = this;
    const flat = { lighting: false };
    this.obstacles = scene.obstacles.map((o) => {
      const polys = new Uint32Array((o.triangles.length / 3) * 4);
      for (let t = 0; 3 * t < o.triangles.length; ++t) polys.set([3, ...o.triangles.subarray(3 * t, 3 * t + 3)], 4 * t);
      return layer(renderer, o.points, { polys }, { opacity: 0.26, ambient: 0.6, diffuse: 0.4 });
    });
    this.ghost = layer(renderer, scene.position, { lines: cells.lines }, { ...flat, opacity: 0.45 });
    this.shell = this.addSurface({});
    this.edges = layer(renderer, this.points, { lines: cells.lines }, { ...flat, color: [1, 1, 1], opacity: 0.3 });
    this.contact = layer(renderer, new Float32Array(0), { polys: new Uint32Array(0) }, { ...flat });
    this.supports = layer(renderer, new Float32Array(0), { polys: new Uint32Array(0) }, { ...flat });
    this.addMark();
  }

  /** Colours of the page: {background, line, obstacle, contact, support}, each [r, g, b] from 0 to 1. */
  setTheme(theme) {
    this.obstacles.forEach((o) => o.actor.getProperty().setColor(...theme.obstacle));
    this.ghost.actor.getProperty().setColor(...theme.line);
    this.contact.actor.getProperty().setColor(...theme.contact);
    this.supports.actor.getProperty().setColor(...theme.support);
    super.setTheme(theme);
  }

  setColours(colours) {
    this.setSurfaceColours(this.shell, colours);
    this.render();
  }

  setScale(scale) {
    this.scale = scale;
    const { scene } = this;
    this.points = moved(scene.position, scale, scene.u, new Float32Array(scene.position.length));
    const normals = directors(scene, scale, new Float32Array(scene.position.length));
    this.shell.data.getPointData().setNormals(normalsArray(normals));
    this.shell.move(this.points);
    this.edges.move(this.points);
    this.drawLines(this.contact, this.lines);
    this.drawLines(this.supports, scene.supports);
    if (this.marked !== undefined) this.placeMark();
    this.render();
  }

  drawLines(target, lines) {
    const polylines = lines.map((l) => moved(l.points, this.scale, l.displacements, new Float32Array(l.points.length)));
    this.drawTubes(target, polylines, 0.0022 * this.size);
  }
}
