// The picture: vtk.js actors of shell, mesh, undeformed mesh, obstacles, supports and contact boundaries, and the camera. Knows no buttons.
import '@kitware/vtk.js/Rendering/OpenGL/Actor';
import '@kitware/vtk.js/Rendering/OpenGL/Camera';
import '@kitware/vtk.js/Rendering/OpenGL/PolyDataMapper';
import '@kitware/vtk.js/Rendering/OpenGL/Renderer';
import vtkActor from '@kitware/vtk.js/Rendering/Core/Actor';
import vtkDataArray from '@kitware/vtk.js/Common/Core/DataArray';
import vtkInteractor from '@kitware/vtk.js/Rendering/Core/RenderWindowInteractor';
import vtkMapper from '@kitware/vtk.js/Rendering/Core/Mapper';
import vtkOpenGLRenderWindow from '@kitware/vtk.js/Rendering/OpenGL/RenderWindow';
import vtkPolyData from '@kitware/vtk.js/Common/DataModel/PolyData';
import vtkRenderer from '@kitware/vtk.js/Rendering/Core/Renderer';
import vtkRenderWindow from '@kitware/vtk.js/Rendering/Core/RenderWindow';
import vtkTrackball from '@kitware/vtk.js/Interaction/Style/InteractorStyleTrackballCamera';

import { cellArrays } from './cells.js';
import { fitted } from './camera.js';
import { pickedPoint } from './pick.js';
import { boundsOf, diagonal, directors, linesOnSurface, moved, tubes } from './shapes.js';

/** A layer of the picture. `cells` sets polys or lines; `look` its property. */
function layer(renderer, points, cells, look) {
  const data = vtkPolyData.newInstance();
  data.getPoints().setData(points, 3);
  if (cells.polys) data.getPolys().setData(cells.polys);
  if (cells.lines) data.getLines().setData(cells.lines);
  const mapper = vtkMapper.newInstance({ scalarVisibility: false });
  mapper.setInputData(data);
  // Lines that lie on the surface are drawn before it.
  mapper.setResolveCoincidentTopology(true);
  if (cells.lines) mapper.setRelativeCoincidentTopologyLineOffsetParameters(-1, -3);
  else mapper.setRelativeCoincidentTopologyPolygonOffsetParameters(1, 1);
  const actor = vtkActor.newInstance();
  actor.setMapper(mapper);
  actor.getProperty().set(look);
  renderer.addActor(actor);
  return {
    data,
    mapper,
    actor,
    move(newPoints) {
      data.getPoints().setData(newPoints, 3);
      data.getPoints().modified();
      data.modified();
    },
  };
}

function sphere(renderer, colour) {
  const points = [];
  const polys = [];
  const rows = 8;
  const columns = 16;
  for (let i = 0; i <= rows; ++i)
    for (let j = 0; j < columns; ++j) {
      const [a, b] = [(Math.PI * i) / rows, (2 * Math.PI * j) / columns];
      points.push(Math.sin(a) * Math.cos(b), Math.sin(a) * Math.sin(b), Math.cos(a));
      const [p, q] = [columns * i + j, columns * i + ((j + 1) % columns)];
      if (i < rows) polys.push(4, p, q, q + columns, p + columns);
    }
  return layer(renderer, Float32Array.from(points), { polys: Uint32Array.from(polys) }, { color: colour });
}

/** The window in `container`, which has a size. */
function openWindow(container) {
  const renderer = vtkRenderer.newInstance();
  renderer.setTwoSidedLighting(true);
  const renderWindow = vtkRenderWindow.newInstance();
  renderWindow.addRenderer(renderer);
  const glWindow = vtkOpenGLRenderWindow.newInstance();
  glWindow.setContainer(container);
  renderWindow.addView(glWindow);
  const interactor = vtkInteractor.newInstance();
  interactor.setView(glWindow);
  interactor.initialize();
  interactor.setContainer(container);
  interactor.setInteractorStyle(vtkTrackball.newInstance());
  const style = interactor.getInteractorStyle();
  style.handleKeyPress = () => {}; // keys are ours (keys.js)
  return { renderer, renderWindow, glWindow };
}

export class View {
  constructor(container, scene) {
    this.container = container;
    this.scene = scene;
    Object.assign(this, openWindow(container));
    this.points = new Float32Array(scene.position.length);
    this.normals = new Float32Array(scene.position.length);
    this.cells = cellArrays(scene.shape, scene.subdivisions, scene.cells);
    this.lines = linesOnSurface(scene);
    this.size = diagonal(boundsOf(scene.position)) || 1;
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
    this.shell = layer(renderer, this.points, { polys: cells.polys }, { ambient: 0.5, diffuse: 0.5, specular: 0.08, specularPower: 20 });
    this.edges = layer(renderer, this.points, { lines: cells.lines }, { ...flat, color: [1, 1, 1], opacity: 0.3 });
    this.contact = layer(renderer, new Float32Array(0), { polys: new Uint32Array(0) }, { ...flat });
    this.supports = layer(renderer, new Float32Array(0), { polys: new Uint32Array(0) }, { ...flat });
    this.mark = sphere(renderer, [1, 1, 1]);
    this.mark.actor.setVisibility(false);
    this.shell.mapper.setColorModeToDirectScalars();
    this.shell.mapper.setScalarVisibility(true);
  }

  /** Colours of the page: {background, line, obstacle, contact, support}, each [r, g, b] from 0 to 1. */
  setTheme(theme) {
    this.renderer.setBackground(...theme.background);
    this.obstacles.forEach((o) => o.actor.getProperty().setColor(...theme.obstacle));
    this.ghost.actor.getProperty().setColor(...theme.line);
    this.contact.actor.getProperty().setColor(...theme.contact);
    this.supports.actor.getProperty().setColor(...theme.support);
    this.mark.actor.getProperty().setColor(...theme.line);
    this.render();
  }

  setColours(colours) {
    this.shell.data.getPointData().setScalars(vtkDataArray.newInstance({ numberOfComponents: 3, values: colours }));
    this.shell.data.modified();
    this.render();
  }

  setScale(scale) {
    this.scale = scale;
    const { scene } = this;
    this.points = moved(scene.position, scale, scene.u, new Float32Array(scene.position.length));
    this.normals = directors(scene, scale, new Float32Array(scene.position.length));
    this.shell.data.getPointData().setNormals(vtkDataArray.newInstance({ numberOfComponents: 3, values: this.normals }));
    this.shell.move(this.points);
    this.edges.move(this.points);
    this.drawLines(this.contact, this.lines);
    this.drawLines(this.supports, scene.supports);
    if (this.marked !== undefined) this.placeMark();
    this.render();
  }

  drawLines(target, lines) {
    const polylines = lines.map((l) => moved(l.points, this.scale, l.displacements, new Float32Array(l.points.length)));
    const { points, polys } = tubes(polylines, 0.0022 * this.size);
    target.data.getPolys().setData(polys);
    target.move(points);
  }

  /** 'edges', 'ghost', 'obstacles', 'contact' or 'supports'. */
  show(name, isVisible) {
    for (const { actor } of [this[name]].flat()) actor.setVisibility(isVisible);
    this.render();
  }

  /** Looks at all of the shell along a direction of length 1; `up` points upwards. */
  look(direction, up) {
    const camera = this.renderer.getActiveCamera();
    const { width, height } = this.container.getBoundingClientRect();
    const { centre, distance } = fitted(this.points, direction, up, width / height, camera.getViewAngle());
    camera.setFocalPoint(...centre);
    camera.setPosition(...centre.map((c, d) => c - distance * direction[d]));
    camera.setViewUp(...up);
    this.render();
  }

  turn(azimuth, elevation) {
    const camera = this.renderer.getActiveCamera();
    camera.azimuth(azimuth);
    camera.elevation(elevation);
    camera.orthogonalizeViewUp();
    this.renderer.resetCameraClippingRange();
    this.render();
  }

  zoom(factor) {
    this.renderer.getActiveCamera().dolly(factor);
    this.renderer.resetCameraClippingRange();
    this.render();
  }

  /** The point of the shell under a place in the container [CSS px]; -1 where there is none. */
  pick(x, y) {
    const [width, height] = this.glWindow.getSize();
    const box = this.container.getBoundingClientRect();
    const px = (x / box.width) * width;
    const py = (1 - y / box.height) * height;
    const near = this.glWindow.displayToWorld(px, py, 0, this.renderer);
    const far = this.glWindow.displayToWorld(px, py, 1, this.renderer);
    return pickedPoint(this.points, this.cells.polys, near, far.map((value, d) => value - near[d]));
  }

  setMark(point) {
    this.marked = point;
    this.mark.actor.setVisibility(point >= 0);
    if (point >= 0) this.placeMark();
    this.render();
  }

  placeMark() {
    if (this.marked < 0) return;
    this.mark.actor.setPosition(...this.points.subarray(3 * this.marked, 3 * this.marked + 3));
    this.mark.actor.setScale(...Array(3).fill(0.008 * this.size));
  }

  resize() {
    const { width, height } = this.container.getBoundingClientRect();
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    this.glWindow.setSize(Math.max(1, Math.floor(width * ratio)), Math.max(1, Math.floor(height * ratio)));
    if (width > 0 && height > 0) this.keepWidth(width / height);
    this.render();
  }

  /** Steps back where the picture grows narrow, as when a phone is turned: what was in it stays in it. */
  keepWidth(aspect) {
    const room = Math.min(aspect, 1.8);
    if (this.room) this.renderer.getActiveCamera().dolly(room / this.room);
    this.room = room;
  }

  render() {
    this.renderer.resetCameraClippingRange();
    this.renderWindow.render();
  }

  /** Calls action([right, up]) with the camera's directions, now and whenever they change. */
  onTurn(action) {
    const camera = this.renderer.getActiveCamera();
    const tell = () => {
      const m = camera.getViewMatrix(); // row by row
      action([m.slice(0, 3), m.slice(4, 7)]);
    };
    camera.onModified(tell);
    tell();
  }

  /** The canvas, just drawn: its pixels last until the browser shows the next frame. */
  drawnCanvas() {
    this.render();
    return this.glWindow.getCanvas();
  }
}
