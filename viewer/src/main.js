// The three-dimensional view of a page: reads the scene and starts what shows it.
import { element } from './dom.js';
import { startParts } from './parts.js';
import { startReport } from './report.js';
import { readParts, readScene } from './scene.js';

function run() {
  const place = document.getElementById('view');
  const json = JSON.parse(document.getElementById('plastron-scene').textContent);
  if (!place || !json) return;
  const isParts = json.kind === 'parts';
  const canvas = document.createElement('canvas');
  if (!canvas.getContext('webgl2')) {
    const instead = isParts ? '' : ' Open solution.pvd in ParaView.';
    place.replaceChildren(element('p', { class: 'note' }, `The three-dimensional view needs WebGL 2, which this browser does not offer.${instead}`));
    return;
  }
  if (isParts) startParts(place, readParts(json));
  else startReport(place, readScene(json));
  place.dataset.ready = 'true';
}

run();
