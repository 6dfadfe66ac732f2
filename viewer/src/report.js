// report.html's three-dimensional view: the deformed shell and its controls.
import { checkbox, choice, element } from './dom.js';
import { colourMaps, coloured } from './colours.js';
import { deformationSlider, scalesFor, visibleMode } from './deformation.js';
import { DeformedView } from './deformed_view.js';
import { Probe } from './probe.js';
import { defaultQuantity, quantitiesOf, rangeInFrames, rangeOf } from './quantities.js';
import { ScaleBar } from './scale_bar.js';
import { Stage } from './stage.js';
import { stepSlider } from './steps.js';

const variables = { background: '--stage', line: '--line3d', obstacle: '--obstacle', contact: '--contact', support: '--support', load: '--arrows' };

function drawnNote(scene) {
  const parts = [];
  if (scene.merged > 1) parts.push(`Each drawn cell is a block of ${scene.merged} x ${scene.merged} cells of the mesh, of which there are ${scene.mesh_cells}: a page holds no more. All points are in solution.vtu.`);
  else if (scene.subdivisions < scene.degree) parts.push(`Each cell, of degree ${scene.degree}, is drawn with ${scene.subdivisions + 1} points a side: a page holds no more. All points are in solution.vtu.`);
  return parts.join(' ');
}

export function startReport(place, scene) {
  const stage = new Stage('The deformed shell.', 'values');
  const bar = new ScaleBar();
  const probe = new Probe(scene);
  const options = element('div', { class: 'options' });
  stage.frame.append(bar.node);
  place.replaceChildren(options, stage.frame, stage.actions, stage.help, probe.node);
  const note = drawnNote(scene);
  if (note) place.append(element('p', { class: 'note drawn' }, note));

  const view = new DeformedView(stage.stage, scene);
  const quantities = quantitiesOf(scene);
  const last = scene.frames.at(-1);
  const state = { quantity: defaultQuantity(scene), map: 'viridis', frame: last };
  const paint = () => {
    const quantity = quantities.find((q) => q.id === state.quantity);
    const values = quantity.values(state.frame);
    bar.set(quantity.label, quantity.values(scene.frames[0]) ? rangeInFrames(quantity, scene.frames) : rangeOf(values), colourMaps[state.map]);
    view.setColours(coloured(values, bar.range, bar.map));
  };
  const showPoint = (point) => {
    view.setMark(point);
    probe.show(point);
  };
  const showValues = (x, y) => showPoint(state.frame === last ? view.pick(x, y) : -1);
  const slider = deformationSlider(scalesFor(scene, view.size), (scale) => {
    view.setScale(scale);
    place.dataset.scale = String(scale);
  });

  const colours = choice('Colours', quantities, state.quantity, (id) => {
    state.solutionQuantity = undefined;
    setQuantity(id);
  });
  // Frames before the last one hold u, r and eta. Another quantity brings back the last frame, and an earlier frame brings back a quantity that it has.
  const setQuantity = (id) => {
    state.quantity = id;
    colours.querySelector('select').value = id;
    if (!quantities.find((q) => q.id === id).values(state.frame)) steps.reset();
    paint();
  };
  const steps = stepSlider(scene.frames, (frame) => {
    state.frame = frame;
    place.dataset.time = String(frame.time);
    if (frame !== last) showPoint(-1);
    shapes.querySelector('select').value = '';
    if (state.solutionQuantity) [state.quantity, state.solutionQuantity] = [state.solutionQuantity, undefined];
    colours.querySelector('select').value = state.quantity;
    if (!quantities.find((q) => q.id === state.quantity).values(frame)) setQuantity('u:length');
    view.setFrame(frame);
    paint();
  });
  // A mode has the colours of its own displacement: others bring back the solution, in its former colours (state.solutionQuantity).
  const shapes = choice('Shape', [{ id: '', label: 'solution' }, ...scene.modes.map(({ key }) => ({ id: key, label: key }))], '', (key) => {
    steps.reset();
    if (!key) return;
    state.solutionQuantity = state.quantity;
    if (view.scale === 0) slider.reset();
    state.frame = visibleMode(scene.modes.find((mode) => mode.key === key), view.size, view.scale);
    showPoint(-1);
    view.setFrame(state.frame);
    setQuantity(`${key}:length`);
    shapes.querySelector('select').value = key;
  });
  options.append(
    colours,
    choice('Map', Object.keys(colourMaps).map((id) => ({ id, label: id })), state.map, (id) => paint((state.map = id))),
    slider.node,
  );
  if (scene.modes.length > 0) options.append(shapes);
  if (scene.frames.length > 1) options.append(steps.node);
  const layers = [['mesh', 'edges', true], ['undeformed', 'ghost', false]];
  if (scene.obstacles.length > 0) layers.push(['obstacles', 'obstacles', true, '--obstacle']);
  if (scene.lines.length > 0) layers.push(['contact boundary', 'contact', true, '--contact']);
  const isDashed = scene.supports.some((line) => line.clamped === false);
  if (scene.supports.length > 0) layers.push([isDashed ? 'supports (dashed: may turn)' : 'supports', 'supports', true, '--support']);
  if (scene.loads.places.length > 0) layers.push(['loads', 'loads', false, '--arrows']);
  for (const [label, name, isVisible, sample] of layers) {
    stage.actions.append(checkbox(label, isVisible, (is) => view.show(name, is), sample));
    view.show(name, isVisible);
  }
  paint();
  slider.reset();
  stage.start(view, { variables, probe: showValues, key: bar });
}
