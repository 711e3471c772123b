// Detects if 3D is drawn by a graphics card or, slowly, by the processor.

// Returns the only context of a canvas; null without WebGL. Created here instead of by three.js, because three.js would
// log errors. Still pictures are supersampled instead of antialiased.
export function contextOf(canvas) {
  return canvas.getContext('webgl', {alpha: false, antialias: false, stencil: false, preserveDrawingBuffer: true});
}

export function isProcessor(context) {
  const info = context.getExtension('WEBGL_debug_renderer_info');
  const name = info ? context.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}
