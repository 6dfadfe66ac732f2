// report.html's three-dimensional view: reads the scene, puts the controls on the page and keeps both together.
import { button, checkbox, choice, element } from './dom.js';
import { colourMaps, coloured } from './colours.js';
import { deformationSlider, scalesFor } from './deformation.js';
import { help, listenToKeys } from './keys.js';
import { Probe } from './probe.js';
import { Triad } from './triad.js';
import { defaultQuantity, quantitiesOf, rangeOf } from './quantities.js';
import { readScene } from './scene.js';
import { savePicture } from './picture.js';
import { ScaleBar } from './scale_bar.js';
import { View } from './view.js';

const slanted = [[-0.507, 0.676, -0.535], [0, 0, 1]];
const standardViews = { X: [[-1, 0, 0], [0, 0, 1]], Y: [[0, 1, 0], [0, 0, 1]], Z: [[0, 0, -1], [0, 1, 0]], '-Z': [[0, 0, 1], [0, 1, 0]] };

/** The page's own colours, light or dark. */
function theme(node) {
  const style = getComputedStyle(node);
  const colour = (name) => {
    const hex = style.getPropertyValue(name).trim();
    return [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16) / 255);
  };
  return { background: colour('--stage'), line: colour('--line3d'), obstacle: colour('--obstacle'), contact: colour('--contact'), support: colour('--support') };
}

/** A click that does not turn the view. */
function onClick(stage, action) {
  let start = null;
  stage.addEventListener('pointerdown', (event) => {
    start = [event.clientX, event.clientY];
    stage.focus({ preventScroll: true });
  });
  stage.addEventListener('pointerup', (event) => {
    if (!start || event.button !== 0 || Math.hypot(event.clientX - start[0], event.clientY - start[1]) > 4) return;
    const box = stage.getBoundingClientRect();
    action(event.clientX - box.left, event.clientY - box.top);
  });
}

/** The wheel scrolls the page until the view has the focus. */
function leaveWheelToPage(stage) {
  const guard = (event) => (document.activeElement === stage ? event.preventDefault() : event.stopPropagation());
  stage.addEventListener('wheel', guard, { capture: true, passive: false });
}

function drawnNote(scene) {
  const parts = [];
  if (scene.merged > 1) parts.push(`Each drawn cell is a block of ${scene.merged} x ${scene.merged} cells of the mesh, of which there are ${scene.mesh_cells}: a page holds no more. All points are in solution.vtu.`);
  else if (scene.subdivisions < scene.degree) parts.push(`Each cell, of degree ${scene.degree}, is drawn with ${scene.subdivisions + 1} points a side: a page holds no more. All points are in solution.vtu.`);
  return parts.join(' ');
}

function start(place, scene) {
  const stage = element('div', { class: 'stage', tabindex: '0', role: 'application', 'aria-label': `The deformed shell. ${help}` });
  const bar = new ScaleBar();
  const triad = new Triad();
  const probe = new Probe(scene);
  const options = element('div', { class: 'options' });
  const actions = element('div', { class: 'options' });
  const frame = element('div', { class: 'frame3d' }, stage, triad.node, bar.node);
  place.replaceChildren(options, frame, actions, element('p', { class: 'note' }, help), probe.node);
  const note = drawnNote(scene);
  if (note) place.append(element('p', { class: 'note drawn' }, note));

  const view = new View(stage, scene);
  view.onTurn((directions) => triad.turn(directions));
  const quantities = quantitiesOf(scene);
  const state = { quantity: defaultQuantity(scene), map: 'viridis' };
  const paint = () => {
    const quantity = quantities.find((q) => q.id === state.quantity);
    const values = quantity.values();
    bar.set(quantity.label, rangeOf(values), colourMaps[state.map]);
    view.setColours(coloured(values, bar.range, bar.map));
  };
  const setTheme = () => view.setTheme(theme(frame));
  const showValues = (x, y) => {
    const point = view.pick(x, y);
    view.setMark(point);
    probe.show(point);
  };
  const slider = deformationSlider(scalesFor(scene, view.size), (scale) => {
    view.setScale(scale);
    place.dataset.scale = String(scale);
  });
  const reset = () => view.look(...slanted);

  options.append(
    choice('Colours', quantities, state.quantity, (id) => paint((state.quantity = id))),
    choice('Map', Object.keys(colourMaps).map((id) => ({ id, label: id })), state.map, (id) => paint((state.map = id))),
    slider.node,
  );
  const layers = [['mesh', 'edges', true], ['undeformed', 'ghost', false]];
  if (scene.obstacles.length > 0) layers.push(['obstacles', 'obstacles', true, '--obstacle']);
  if (scene.lines.length > 0) layers.push(['contact boundary', 'contact', true, '--contact']);
  if (scene.supports.length > 0) layers.push(['supports', 'supports', true, '--support']);
  for (const [label, name, isVisible, sample] of layers) {
    actions.append(checkbox(label, isVisible, (is) => view.show(name, is), sample));
    view.show(name, isVisible);
  }
  actions.append(element('span', { class: 'gap' }), button('Reset view', 'The first view again (key 0)', reset));
  for (const [name, look] of Object.entries(standardViews)) actions.append(button(name, `Seen from ${name}`, () => view.look(...look)));
  actions.append(button('Save picture', 'The view as a PNG file', () => savePicture(view, bar, document.title, getComputedStyle(frame).color)));

  onClick(stage, showValues);
  leaveWheelToPage(stage);
  listenToKeys(stage, { view, reset, probe: showValues });
  new ResizeObserver(() => view.resize()).observe(stage);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', setTheme);
  setTheme();
  paint();
  slider.reset();
  reset();
  place.dataset.ready = 'true';
}

function run() {
  const place = document.getElementById('view');
  const json = JSON.parse(document.getElementById('plastron-scene').textContent);
  if (!place || !json) return;
  const canvas = document.createElement('canvas');
  if (!canvas.getContext('webgl2')) {
    place.replaceChildren(element('p', { class: 'note' }, 'The three-dimensional view needs WebGL 2, which this browser does not offer. Open solution.pvd in ParaView.'));
    return;
  }
  start(place, readScene(json));
}

run();
