// The slider that scales the displacements.
import { button, element } from './dom.js';
import { shown } from './quantities.js';

/** 1, 2 or 5 times a power of ten, not above x. */
function roundNumber(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  return [5, 2, 1].find((k) => k * power <= x * (1 + 1e-12)) * power;
}

/** Part of the shell's size that a displacement must have to be seen well. */
const visible = 0.05;

function largestOf(vectors) {
  let largest = 0;
  for (let i = 0; i < vectors.length; i += 3) largest = Math.max(largest, Math.hypot(vectors[i], vectors[i + 1], vectors[i + 2]));
  return largest;
}

/** {start, most}: 1 where displacements can be seen as they are, else as large as a twentieth of the shell. */
export function scalesFor(scene, size) {
  const largest = largestOf(scene.u);
  if (!(largest > 0)) return { start: 1, most: 2 };
  const start = largest > 0.01 * size ? 1 : Math.max(1, roundNumber((visible * size) / largest));
  return { start, most: Math.max(2, roundNumber((0.25 * size) / largest)) };
}

/** The frame of a mode with displacements that can be seen at a scale: those of a mode have no size of their own. */
export function visibleMode(mode, size, scale) {
  const factor = (visible * size) / (scale * (largestOf(mode.u) || 1));
  return { ...mode, u: mode.u.map((value) => factor * value) };
}

export function deformationSlider({ start, most }, action) {
  const slider = element('input', { type: 'range', min: '0', max: String(most), step: 'any', 'aria-label': 'Scale of the displacements' });
  const shownScale = element('output', {});
  const set = (scale) => {
    slider.value = String(scale);
    shownScale.textContent = `× ${shown(scale)}`;
    action(scale);
  };
  slider.addEventListener('input', () => set(Number(slider.value)));
  const choices = [...new Set([0, 1, start])];
  const buttons = choices.map((scale) => button(`× ${shown(scale)}`, scale === 0 ? 'Undeformed' : `Displacements times ${shown(scale)}`, () => set(scale)));
  const node = element('div', { class: 'slider' }, element('span', {}, 'Deformation'), slider, shownScale, ...buttons);
  return { node, reset: () => set(start) };
}
