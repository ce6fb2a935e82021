// How pointers, the wheel and keys move the view: a drag turns; two fingers, the right button or Shift move; wheel and pinch come nearer.

// `hand` has camera, takeCamera() and change(), and pan(); where it has them, beginDrag(event) (true: it is no camera's), drag(event),
// endDrag(event) of such a drag, and tapped(event) of a press that did not move.
export function followPointers(view, hand) {
  const held = new Map(), { camera } = hand;
  let moved = 0, middle = null, gap = 0, taken = false;
  const around = () => {
    const points = [...held.values()], sum = points.reduce((a, p) => [a[0] + p[0], a[1] + p[1]], [0, 0]).map((x) => x / points.length);
    return [sum, points.length > 1 ? Math.hypot(points[0][0] - points[1][0], points[0][1] - points[1][1]) : 0];
  };
  const endTaken = (event) => {
    if (taken) hand.endDrag(event);
    taken = false;
  };
  view.addEventListener('pointerdown', (event) => {
    view.setPointerCapture(event.pointerId);
    held.set(event.pointerId, [event.offsetX, event.offsetY]);
    if (held.size === 1) {
      moved = 0;
      taken = Boolean(hand.beginDrag?.(event));
    } else {
      endTaken(event);
    }
    [middle, gap] = around();
  });
  view.addEventListener('pointermove', (event) => {
    if (!held.has(event.pointerId)) return;
    held.set(event.pointerId, [event.offsetX, event.offsetY]);
    if (taken) return hand.drag(event);
    const [now, wide] = around(), dx = now[0] - middle[0], dy = now[1] - middle[1];
    moved += Math.abs(dx) + Math.abs(dy) + Math.abs(wide - gap);
    if (moved < 4) return;
    hand.takeCamera();
    if (held.size > 1 || event.buttons & 6 || event.shiftKey) {
      hand.pan(-dx / view.clientHeight, dy / view.clientHeight);
      if (gap > 0 && wide > 0) camera.zoom(gap / wide);
    } else {
      camera.orbit(-dx * 0.006, dy * 0.006);
    }
    [middle, gap] = [now, wide];
    hand.change();
  });
  const release = (event) => {
    if (!held.delete(event.pointerId)) return;
    if (held.size > 0) [middle, gap] = around();
    const still = event.type === 'pointerup' && held.size === 0 && moved < 4 && event.button === 0 && !taken;
    endTaken(event);
    if (still) hand.tapped?.(event);
  };
  view.addEventListener('pointerup', release);
  view.addEventListener('pointercancel', release);
  view.addEventListener('contextmenu', (event) => event.preventDefault());
  view.addEventListener('wheel', (event) => {
    event.preventDefault();
    hand.takeCamera();
    camera.zoom(Math.exp(Math.max(-60, Math.min(60, event.deltaY * (event.deltaMode === 1 ? 16 : 1))) * 0.003));
    hand.change();
  }, { passive: false });
}

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }, ZOOMS = { '+': 0.88, '=': 0.88, '-': 1 / 0.88 };

// What a key does to the view, as a function; null: nothing. Arrow keys count where the view has the focus.
export function cameraKey(event, inView, hand) {
  const arrow = inView && ARROWS[event.key], zoom = ZOOMS[event.key];
  if (!arrow && !zoom) return null;
  return () => {
    const { camera } = hand;
    hand.takeCamera();
    if (zoom) camera.zoom(zoom);
    else if (event.shiftKey) hand.pan(0.04 * arrow[0], 0.04 * arrow[1]);
    else camera.orbit(0.08 * arrow[0], 0.08 * arrow[1]);
    hand.change();
  };
}
