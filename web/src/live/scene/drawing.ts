// How this browser draws in three dimensions: without a graphics card it takes the time from the page that it is part of.

export type Drawing = "card" | "processor" | "nothing";

const IN_SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

export function drawingOf(canvas: HTMLCanvasElement): Drawing {
  const gl = canvas.getContext("webgl2");
  if (gl === null) return "nothing";
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const renderer = String(gl.getParameter(info === null ? gl.RENDERER : info.UNMASKED_RENDERER_WEBGL));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return IN_SOFTWARE.test(renderer) ? "processor" : "card";
}
