// The picture of report.html: the deformed shell, its undeformed mesh, obstacles, supports and contact boundaries.
import { arrows, dashes, directors, linesOnSurface, moved, nearest, normalsOf, placed } from './shapes.js';
import { layer, normalsArray, View } from './view.js';

/** The vectors of some points, next to each other. */
const valuesAt = (vectors, points) => Float32Array.from(points.flatMap((p) => [...vectors.subarray(3 * p, 3 * p + 3)]));

export class DeformedView extends View {
  constructor(container, scene) {
    super(container, scene);
    this.lines = linesOnSurface(scene);
    this.nearest = (scene.frames.length + scene.modes.length > 1 ? scene.supports : []).map((line) => Array.from({ length: line.points.length / 3 }, (_, i) => nearest(scene.position, line.points.subarray(3 * i, 3 * i + 3))));
    this.frame = scene.frames.at(-1);
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
    this.loads = layer(renderer, new Float32Array(0), { polys: new Uint32Array(0) }, { ambient: 0.6, diffuse: 0.4 });
    this.addMark();
  }

  /** Colours of the page: {background, line, obstacle, contact, support, load}, each [r, g, b] from 0 to 1. */
  setTheme(theme) {
    this.obstacles.forEach((o) => o.actor.getProperty().setColor(...theme.obstacle));
    this.ghost.actor.getProperty().setColor(...theme.line);
    this.contact.actor.getProperty().setColor(...theme.contact);
    this.supports.actor.getProperty().setColor(...theme.support);
    this.loads.actor.getProperty().setColor(...theme.load);
    super.setTheme(theme);
  }

  setColours(colours) {
    this.setSurfaceColours(this.shell, colours);
    this.render();
  }

  /** Shows an instant of the steps or a mode. Contact boundaries are those of the last one. */
  setFrame(frame) {
    this.frame = frame;
    this.scene.obstacles.forEach((o, k) => this.obstacles[k].move(frame.obstacles ? placed(o.points, frame.obstacles[k]) : o.points));
    this.setScale(this.scale);
  }

  setScale(scale) {
    this.scale = scale;
    const { scene, frame } = this;
    this.points = moved(scene.position, scale, frame.u, new Float32Array(scene.position.length));
    const normals = frame.r ? directors(scene.normal, scale, frame.r, new Float32Array(scene.position.length)) : normalsOf(this.points, this.cells.polys);
    this.shell.data.getPointData().setNormals(normalsArray(normals));
    this.shell.move(this.points);
    this.edges.move(this.points);
    const isLast = frame === scene.frames.at(-1);
    this.drawLines(this.contact, isLast ? this.lines : []);
    this.drawLines(this.supports, isLast ? scene.supports : scene.supports.map((line, k) => ({ ...line, displacements: valuesAt(frame.u, this.nearest[k]) })));
    this.drawLoads(isLast);
    if (this.marked !== undefined) this.placeMark();
    this.render();
  }

  /** Arrows that end on the shell. They are those of the last instant. */
  drawLoads(isLast) {
    const { places, displacements, directions } = this.scene.loads;
    const length = 0.07 * this.size;
    const ends = moved(places, this.scale, displacements, new Float32Array(places.length));
    const all = isLast ? Array.from({ length: places.length / 3 }, (_, k) => 3 * k) : [];
    const along = all.map((k) => [...directions.subarray(k, k + 3)]);
    const { points, polys } = arrows(all.map((k, i) => along[i].map((n, d) => ends[k + d] - length * n)), along, length);
    this.loads.data.getPolys().setData(polys);
    this.loads.move(points);
  }

  /** Supports on which the shell may turn are dashed. */
  drawLines(target, lines) {
    const polylines = lines.flatMap((l) => {
      const line = moved(l.points, this.scale, l.displacements, new Float32Array(l.points.length));
      return l.clamped === false ? dashes(line, 0.02 * this.size) : [line];
    });
    this.drawTubes(target, polylines, 0.0022 * this.size);
  }
}
