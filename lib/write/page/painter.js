// Who draws 3D here: a graphics card, or the processor, slowly.

// The one context of a canvas; null where there is no WebGL. It is asked for here and not by three.js, which would
// complain in the console. Still pictures are finer than the screen instead of smoothed.
export function contextOf(canvas) {
  return canvas.getContext('webgl', {alpha: false, antialias: false, stencil: false, preserveDrawingBuffer: true});
}

export function isProcessor(context) {
  const info = context.getExtension('WEBGL_debug_renderer_info');
  const name = info ? context.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}
