// A picture of cells: the window, layers of vtk.js actors, and the camera. Knows no buttons. Pages add their layers (deformed_view.js,
// parts_view.js).
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
import { isHidden, pickedPoint } from './pick.js';
import { boundsOf, diagonal, tubes } from './shapes.js';

export const normalsArray = (values) => vtkDataArray.newInstance({ numberOfComponents: 3, values });

/** A layer of the picture. `cells` sets polys or lines; `look` its property. */
export function layer(renderer, points, cells, look) {
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
    this.points = scene.position;
    this.cells = cellArrays(scene.shape, scene.subdivisions, scene.cells);
    this.size = diagonal(boundsOf(scene.position)) || 1;
  }

  /** A layer of all cells, whose points have colours. */
  addSurface(look) {
    const surface = layer(this.renderer, this.points, { polys: this.cells.polys }, { ambient: 0.5, diffuse: 0.5, specular: 0.08, specularPower: 20, ...look });
    surface.mapper.setColorModeToDirectScalars();
    surface.mapper.setScalarVisibility(true);
    return surface;
  }

  addMark() {
    this.mark = sphere(this.renderer, [1, 1, 1]);
    this.mark.actor.setVisibility(false);
  }

  /** Colours of the page: {background, line, ...}, each [r, g, b] from 0 to 1. */
  setTheme(theme) {
    this.renderer.setBackground(...theme.background);
    this.mark.actor.getProperty().setColor(...theme.line);
    this.render();
  }

  /** Three bytes for each point. */
  setSurfaceColours(surface, colours) {
    surface.data.getPointData().setScalars(vtkDataArray.newInstance({ numberOfComponents: 3, values: colours }));
    surface.data.modified();
  }

  drawTubes(target, polylines, radius) {
    const { points, polys } = tubes(polylines, radius);
    target.data.getPolys().setData(polys);
    target.move(points);
  }

  /** The name of a layer, or of a list of layers. */
  show(name, isVisible) {
    for (const { actor } of [this[name]].flat()) actor.setVisibility(isVisible);
    this.render();
  }

  /** Points that look() brings into the picture. */
  outline() {
    return this.points;
  }

  /** Looks at all of the shell along a direction of length 1; `up` points upwards. */
  look(direction, up) {
    const camera = this.renderer.getActiveCamera();
    const { width, height } = this.container.getBoundingClientRect();
    const { centre, distance } = fitted(this.outline(), direction, up, width / height, camera.getViewAngle());
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

  /** The place of a point of space in the container [CSS px]. */
  project(point) {
    const [width, height] = this.glWindow.getSize();
    const box = this.container.getBoundingClientRect();
    const [x, y] = this.glWindow.worldToDisplay(...point, this.renderer);
    return [(x / width) * box.width, (1 - y / height) * box.height];
  }

  /** Whether the surface hides a point. */
  hides(point) {
    return isHidden(this.points, this.cells.polys, this.renderer.getActiveCamera().getPosition(), point);
  }

  pointAt(number) {
    return Array.from(this.points.subarray(3 * number, 3 * number + 3));
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
