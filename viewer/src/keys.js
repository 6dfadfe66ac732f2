// The view from the keyboard, once it has the focus.

/** `probed`: what a click shows. */
export const help = (probed) => `Drag: turn. Shift and drag: move. Wheel or pinch: closer. Click: ${probed}. Keys: arrows turn, + and - zoom, 0 resets, P is a click in the middle.`;

export function listenToKeys(stage, { view, reset, probe }) {
  const actions = {
    ArrowLeft: () => view.turn(10, 0),
    ArrowRight: () => view.turn(-10, 0),
    ArrowUp: () => view.turn(0, -10),
    ArrowDown: () => view.turn(0, 10),
    '+': () => view.zoom(1.15),
    '=': () => view.zoom(1.15),
    '-': () => view.zoom(1 / 1.15),
    0: reset,
    p: () => probe(stage.clientWidth / 2, stage.clientHeight / 2),
    P: () => probe(stage.clientWidth / 2, stage.clientHeight / 2),
  };
  stage.addEventListener('keydown', (event) => {
    const action = actions[event.key];
    if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    action();
  });
}
