// The slider of the instants of the steps, and the button that plays them.
import { button, element } from './dom.js';
import { shown } from './quantities.js';

const pause = 300; // ms between instants

export function stepSlider(frames, action) {
  const slider = element('input', { type: 'range', min: '0', max: String(frames.length - 1), step: '1', value: String(frames.length - 1), 'aria-label': 'Instant of the steps' });
  const timeOf = (frame) => `time ${shown(frame.time)}`;
  const time = element('output', {}, timeOf(frames.at(-1)));
  let timer;
  const stop = () => {
    clearInterval(timer);
    timer = undefined;
    play.textContent = 'Play';
  };
  const set = (number) => {
    slider.value = String(number);
    time.textContent = timeOf(frames[number]);
    action(frames[number]);
  };
  const play = button('Play', 'Shows the instants one after the other', () => {
    if (timer) return stop();
    let number = Number(slider.value) === frames.length - 1 ? 0 : Number(slider.value);
    set(number);
    play.textContent = 'Stop';
    timer = setInterval(() => {
      set((number += 1));
      if (number === frames.length - 1) stop();
    }, pause);
  });
  slider.addEventListener('input', () => {
    stop();
    set(Number(slider.value));
  });
  const node = element('div', { class: 'slider' }, element('span', {}, 'Steps'), slider, time, play);
  const reset = () => {
    stop();
    set(frames.length - 1);
  };
  return { node, reset };
}
