// The three-dimensional view of a page: reads the scene and starts what shows it.
import { element } from './dom.js';
import { startReport } from './report.js';
import { readScene } from './scene.js';

function run() {
  const place = document.getElementById('view');
  const json = JSON.parse(document.getElementById('plastron-scene').textContent);
  if (!place || !json) return;
  const canvas = document.createElement('canvas');
  if (!canvas.getContext('webgl2')) {
    place.replaceChildren(element('p', { class: 'note' }, 'The three-dimensional view needs WebGL 2, which this browser does not offer. Open solution.pvd in ParaView.'));
    return;
  }
  startReport(place, readScene(json));
  place.dataset.ready = 'true';
}

run();
