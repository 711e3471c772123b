// View in the address of the page: "#view=3d&eye=1,2,3&to=4,5,6&level=4&id=12".

const round = (number) => Math.round(number * 10) / 10;
const numbers = (text) => text.split(',').map(Number);

// @param view fields and their values: numbers, lists of numbers or texts; null or undefined are left out
export function written(view) {
  const known = Object.entries(view).filter(([, value]) => value !== null && value !== undefined && value !== '');
  return '#' +
      known.map(([name, value]) => `${name}=${Array.isArray(value) ? value.map(round).join(',') : value}`).join('&');
}

// Returns the valid fields of an address, lists as numbers.
export function readView(hash) {
  const view = {};
  for (const part of hash.replace(/^#/, '').split('&')) {
    const [name, value] = part.split('=', 2);
    const lengths = {eye: 3, to: 3, middle: 3, height: 2, sun: 2};
    if (lengths[name] && numbers(value ?? '').length === lengths[name] && numbers(value).every(Number.isFinite))
      view[name] = numbers(value);
    else if ((name === 'id' || name === 'level') && /^[0-9]+$/.test(value))
      view[name] = Number(value);
    else if (name === 'view' && (value === '3d' || value === 'map'))
      view[name] = value;
    else if (name === 'of' && /^[a-z]+$/.test(value))
      view[name] = value;
  }
  return view;
}
