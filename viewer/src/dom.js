// Elements of the page. Texts are set as texts, never as HTML.

/** element('button', {type: 'button'}, 'Reset', child...) */
export function element(name, attributes = {}, ...children) {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes))
    if (key in node && typeof value !== 'string') node[key] = value;
    else node.setAttribute(key, value);
  node.append(...children);
  return node;
}

export function button(label, title, action) {
  const node = element('button', { type: 'button', title }, label);
  node.addEventListener('click', action);
  return node;
}

/** `sample`: a colour of the page that stands for what the box shows. */
export function checkbox(label, isChecked, action, sample) {
  const box = element('input', { type: 'checkbox' });
  box.checked = isChecked;
  box.addEventListener('change', () => action(box.checked));
  const swatch = sample ? [' ', element('span', { class: 'swatch', style: `background: var(${sample})` })] : [];
  return element('label', { class: 'check' }, box, ...swatch, ` ${label}`);
}

/** A drop-down list of [{id, group, label}]. */
export function choice(label, options, selected, action) {
  const select = element('select');
  const groups = new Map();
  for (const { id, group, label: text } of options) {
    if (group && !groups.has(group)) groups.set(group, select.appendChild(element('optgroup', { label: group })));
    (groups.get(group) ?? select).append(element('option', { value: id }, text));
  }
  select.value = selected;
  select.addEventListener('change', () => action(select.value));
  return element('label', { class: 'choice' }, element('span', {}, label), select);
}
