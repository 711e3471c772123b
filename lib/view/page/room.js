// Part of the window that is free of panels, in CSS pixels: left, top, right, bottom.

const boxOf = (id) => document.getElementById(id).getBoundingClientRect();
const gap = 12;

export function freeRoom() {
  const head = boxOf('head');
  if (head.right < window.innerWidth / 2)  // panels form a column
    return [head.right + gap, gap, window.innerWidth - gap, window.innerHeight - gap];
  const isOpen = document.getElementById('legend').open;
  const below = Math.min(boxOf('levels').top, isOpen ? Infinity : boxOf('legend').top);
  return [gap, head.bottom + gap, window.innerWidth - gap, Math.max(below - gap, head.bottom + 2 * gap)];
}
