// What the pages share: the stage that shows a view, with its buttons, keys and clicks.
import { button, element } from './dom.js';
import { help, listenToKeys } from './keys.js';
import { savePicture } from './picture.js';
import { Triad } from './triad.js';

const slanted = [[-0.507, 0.676, -0.535], [0, 0, 1]];
const standardViews = { X: [[-1, 0, 0], [0, 0, 1]], Y: [[0, 1, 0], [0, 0, 1]], Z: [[0, 0, -1], [0, 1, 0]], '-Z': [[0, 0, 1], [0, 1, 0]] };

/** The page's own colours, light or dark, by the names of its variables: {background: '--stage', ...}. */
function themeOf(node, variables) {
  const style = getComputedStyle(node);
  const colour = (name) => {
    const hex = style.getPropertyValue(name).trim();
    return [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16) / 255);
  };
  return Object.fromEntries(Object.entries(variables).map(([key, name]) => [key, colour(name)]));
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

export class Stage {
  /** `shows`: what a screen reader says of it; `probed`: what a click shows. */
  constructor(shows, probed) {
    this.stage = element('div', { class: 'stage', tabindex: '0', role: 'application', 'aria-label': `${shows} ${help(probed)}` });
    this.triad = new Triad();
    this.frame = element('div', { class: 'frame3d' }, this.stage, this.triad.node);
    this.actions = element('div', { class: 'options' });
    this.help = element('p', { class: 'note' }, help(probed));
  }

  /**
   * Shows a view of this.stage, which is on the page. `variables` name the colours of view.setTheme(). `probe(x, y)` is
   * called for a click. `key` draws itself on saved pictures.
   */
  start(view, { variables, probe, key }) {
    const { stage, frame, actions } = this;
    const setTheme = () => view.setTheme(themeOf(frame, variables));
    const reset = () => view.look(...slanted);
    view.onTurn((directions) => this.triad.turn(directions));
    actions.append(element('span', { class: 'gap' }), button('Reset view', 'The first view again (key 0)', reset));
    for (const [name, look] of Object.entries(standardViews)) actions.append(button(name, `Seen from ${name}`, () => view.look(...look)));
    actions.append(button('Save picture', 'The view as a PNG file', () => savePicture(view, key, document.title, getComputedStyle(frame).color)));
    onClick(stage, probe);
    leaveWheelToPage(stage);
    listenToKeys(stage, { view, reset, probe });
    new ResizeObserver(() => view.resize()).observe(stage);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', setTheme);
    setTheme();
    reset();
  }
}
