// Part of the window that is free of panels, in CSS pixels: left, top, right, bottom.

const boxOf = (id) => document.getElementById(id).getBoundingClientRect();
const gap = 12;

export function freeRoom() {
  const head = boxOf('head');
  if (head.right < window.innerWidth / 2)  // panels form a column
    return [head.right + gap, gap, window.innerWidth - gap, window.innerHeight - gap];
  // Cards that the user opens may lie over the picture.
  const isOpen = (id) => document.getElementById(id).open;
  const below = Math.min(
      isOpen('levels') ? window.innerHeight : boxOf('levels').top, isOpen('legend') ? Infinity : boxOf('legend').top);
  return [gap, head.bottom + gap, window.innerWidth - gap, Math.max(below - gap, head.bottom + 2 * gap)];
}
