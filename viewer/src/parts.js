// The view of `plastron parts --page`: a mesh in space, its regions and curves beside.
import { checkbox, element } from './dom.js';
import { Labels } from './labels.js';
import { curveChoices, firstKind, group, kindBoxes, kindVariable, regionChoices } from './parts_list.js';
import { PartsProbe } from './parts_probe.js';
import { PartsView, underOf } from './parts_view.js';
import { Stage } from './stage.js';

const variables = {
  background: '--stage', line: '--line3d', doubtful: '--doubtful', chosen: '--chosen', turned: '--turned', arrows: '--arrows',
  ...Object.fromEntries([0, 1, 2, 3, 4].map((k) => [`kind${k}`, kindVariable(k)])),
};
const css = (colour) => `rgb(${colour.join(' ')})`;
const mostRegionNames = 12; // more names than these would hide the part

/**
 * Places for the name of a region: the cell that is nearest to its middle, and the nearest ones that face each direction of the
 * axes, as a closed region may hide the first one.
 */
function placesIn(middles) {
  const mean = [0, 1, 2].map((d) => middles.reduce((sum, { place }) => sum + place[d], 0) / middles.length);
  const away = ({ place }) => Math.hypot(...place.map((x, d) => x - mean[d]));
  const nearest = (some) => some.reduce((best, other) => (away(other) < away(best) ? other : best)).place;
  const facing = [0, 1, 2].flatMap((d) => [1, -1].map((side) => middles.filter(({ normal }) => side * normal[d] > 0.7)));
  return [middles, ...facing].filter((some) => some.length > 0).map(nearest);
}

/** The names to write: curves at the middles of their pieces, and regions. */
function labelsOf(scene, view) {
  const curves = scene.curves.flatMap((curve, k) =>
    [...curve.marks].map((mark) => ({ text: curve.name, kind: 'curve', owner: `curve ${k}`, places: [view.pointAt(mark)], colour: `var(${kindVariable(firstKind(scene, curve))})` })),
  );
  const cells = scene.regions.map(() => []);
  scene.region.forEach((region, cell) => cells[region].push(view.middleOfCell(cell)));
  const regions = scene.regions.flatMap((region, k) => {
    if (cells[k].length === 0 || !region.is_name) return [];
    return [{ text: region.name, kind: 'region', owner: `region ${k}`, places: placesIn(cells[k]), colour: css(view.colours[k]) }];
  });
  return [...curves, ...regions];
}

/** What stands on a saved picture: the regions with their colours, and the names. */
class PictureKey {
  constructor(scene, view, labels) {
    Object.assign(this, { scene, view, labels });
  }

  draw(context, height, unit, colour) {
    const lines = this.scene.regions.slice(0, 20);
    context.font = `${unit}px system-ui, sans-serif`;
    context.textAlign = 'left';
    lines.forEach((region, k) => {
      const base = height - (lines.length - k) * 1.5 * unit + 0.3 * unit;
      context.fillStyle = css(this.view.colours[k]);
      context.fillRect(unit, base - 0.8 * unit, unit, unit);
      context.fillStyle = colour;
      context.fillText(region.name, 2.5 * unit, base);
    });
    this.labels.draw(context, context.canvas.width / this.view.container.clientWidth, colour);
    context.font = `${unit}px system-ui, sans-serif`;
    context.fillStyle = colour;
  }
}

function sidesNote(scene) {
  const rest = scene.subdivisions < scene.degree ? ` A cell of order ${scene.degree} is drawn with ${scene.subdivisions} facets a side: a page holds no more.` : '';
  return `Bright colours are the upper side, to which a3 points, as the arrows do. The lower side is dark.${rest}`;
}

export function startParts(place, scene) {
  const stage = new Stage('The mesh.', 'region, cell and normal');
  const list = element('div', { class: 'list3d' });
  place.replaceChildren(element('p', { class: 'note' }, sidesNote(scene)), element('div', { class: 'beside' }, stage.frame, list), stage.actions, stage.help);

  const view = new PartsView(stage.stage, scene);
  const labels = new Labels(view, labelsOf(scene, view));
  const probe = new PartsProbe(view);
  stage.frame.append(labels.node, probe.node);
  const curves = curveChoices(scene, (k) => {
    view.choose(k);
    labels.choose(k < 0 ? null : `curve ${k}`);
  });
  const regions = regionChoices(scene, view.colours.map((colour) => [colour, underOf(colour)]), (k) => {
    view.paint(k);
    labels.choose(k < 0 ? null : `region ${k}`);
  });
  const turned = scene.turned.reduce((sum, is) => sum + is, 0);
  const doubtful = scene.edges.doubtful.reduce((sum, is) => sum + is, 0);
  const boxes = kindBoxes(scene, (k, is) => {
    view.kinds[k].actor.setVisibility(is);
    view.render();
  });
  if (doubtful > 0) boxes.push(checkbox(`doubtful (${doubtful})`, true, (is) => view.show('doubtful', is), '--doubtful'));
  const areRegionsNamed = scene.regions.length <= mostRegionNames;
  const layers = [
    checkbox('normals a3', true, (is) => view.show('arrows', is), '--arrows'),
    ...(turned > 0 ? [checkbox(`turned cells (${turned})`, true, (is) => view.show('turned', is), '--turned')] : []),
    checkbox('mesh', true, (is) => view.show('edges', is)),
    checkbox('names of regions', areRegionsNamed, (is) => labels.show('region', is)),
    checkbox('names of curves', true, (is) => labels.show('curve', is)),
    checkbox('see through', false, (is) => view.seeThrough(is)),
  ];
  list.append(group('Regions', regions.node));
  if (scene.curves.length > 0) list.append(group('Curves and folds', curves.node));
  list.append(group('Edges', element('div', { class: 'checks' }, ...boxes), element('p', { class: 'note' }, 'Thick edges have a name.')));
  stage.actions.append(...layers);

  labels.show('region', areRegionsNamed);
  stage.start(view, {
    variables,
    key: new PictureKey(scene, view, labels),
    probe: (x, y) => {
      const point = view.pick(x, y);
      view.setMark(point);
      probe.show(point);
    },
  });
  view.onTurn(() => labels.follow());
  new ResizeObserver(() => labels.follow()).observe(stage.stage);
}
