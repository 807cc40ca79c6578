// The surface that carries the painting.
layout(location = 0) in vec2 at;        // metres, in the surface's axes
layout(location = 1) in vec2 outwards;  // for the rim of a feather: which way it lies; else 0

uniform mat4 clip_from_surface;
uniform vec2 viewport_px;

invariant gl_Position;
out float coverage;

void main() {
  vec4 clip = clip_from_surface * vec4(at, 0.0, 1.0);
  bool rim = dot(outwards, outwards) > 0.0;
  if (rim) {
    // A pixel further on the screen.
    vec4 n = clip_from_surface * vec4(outwards, 0.0, 0.0);
    vec2 d = (n.xy * clip.w - clip.xy * n.w) * viewport_px;
    clip.xy += d / max(length(d), 1e-12) * 2.0 * abs(clip.w) / viewport_px;
  }
  gl_Position = clip;
  coverage = rim ? 0.0 : 1.0;
}
