// Colour maps that people with any colour vision can read, and that grow lighter evenly: viridis and cividis, tabulated, linear between.

const tables = {
  viridis:
    '440154 481567 482677 453781 404788 39568c 33638d 2d708e 287d8e 238a8d 1f968b 20a387 29af7f 3cbb75 55c667 73d055 95d840 b8de29 dce319 fde725',
  cividis: '00204d 00306f 2a406c 48526b 5e626e 727374 878479 9e9677 b6a971 d0be67 ead357 ffea46',
};

export const colourMaps = Object.fromEntries(
  Object.entries(tables).map(([name, table]) => [
    name,
    table.split(' ').map((hex) => [0, 2, 4].map((k) => parseInt(hex.slice(k, k + 2), 16))),
  ]),
);

/** Red, green, blue from 0 to 255 at t in [0, 1]. */
export function colourAt(map, t) {
  const place = Math.min(Math.max(t, 0), 1) * (map.length - 1);
  const k = Math.min(Math.floor(place), map.length - 2);
  return map[k].map((low, c) => low + (place - k) * (map[k + 1][c] - low));
}

/** As a CSS gradient. */
export const gradient = (map) => `linear-gradient(to right, ${map.map((c) => `rgb(${c})`).join(', ')})`;

const grey = [128, 128, 128];

/** Three bytes for each value; what is not finite is grey. */
export function coloured(values, [low, high], map) {
  const colours = new Uint8Array(3 * values.length);
  const width = high > low ? high - low : 1;
  const table = Array.from({ length: 1024 }, (_, i) => colourAt(map, i / 1023));
  for (let i = 0; i < values.length; ++i) {
    const t = high > low ? (values[i] - low) / width : 0.5;
    const colour = Number.isFinite(t) ? table[Math.round(Math.min(Math.max(t, 0), 1) * 1023)] : grey;
    colours.set(colour, 3 * i);
  }
  return colours;
}

// Light colours that can be told apart with any colour vision (Paul Tol's "light"), so that edges show on them.
const light = ['77aadd', 'ee8866', 'bbcc33', 'ffaabb', '44bb99', 'eedd88', '99ddff', 'aaaa00'];

const channels = (hex) => [0, 2, 4].map((k) => parseInt(hex.slice(k, k + 2), 16));

/** Hue in degrees, saturation and lightness from 0 to 1, as three numbers from 0 to 255. */
function fromHue(hue, saturation, lightness) {
  const a = saturation * Math.min(lightness, 1 - lightness);
  return [0, 8, 4].map((k) => {
    const t = (k + hue / 30) % 12;
    return Math.round(255 * (lightness - a * Math.max(-1, Math.min(t - 3, 9 - t, 1))));
  });
}

/** `count` colours; after the first ones hues that are far from the hues before. */
export const distinctColours = (count) =>
  Array.from({ length: count }, (_, k) => (k < light.length ? channels(light[k]) : fromHue((k * 137.508) % 360, 0.55, k % 2 ? 0.72 : 0.58)));

/** A colour with a part of another. */
export const mixed = (colour, other, part) => colour.map((c, k) => Math.round((1 - part) * c + part * other[k]));
