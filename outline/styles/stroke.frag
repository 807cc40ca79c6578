uniform vec3 colour;
uniform float opacity;
uniform float taper_px;       // at a line's ends
uniform bool opaque;          // only what covers its pixel whole; else only the rest
uniform bool outside;         // what makes the line thinner takes from its outer side only
uniform vec4 strokes;         // their length in pixels (0: unbroken), the gap's part, pressure, dryness
uniform float dash_px;        // above 0: only what is hidden, dashed
uniform float thickness_m;    // what of the object lies so far before the line hides it
uniform float near_m;
uniform sampler2D own_depth;
uniform ivec2 origin;
uniform ivec2 last_pixel;
#ifdef BRUSH
uniform sampler2D brush;      // how much ink: along the stroke, across it
uniform float brush_px;       // the length that one brush image takes
#endif

in vec2 along;
in float half_px;
in float to_end_px;
in float strength_here;
in float shown;
in float middle_depth;
layout(location = 0) out vec4 fragment;

float random(vec2 at) {
  uvec2 q = uvec2(ivec2(at)) * uvec2(1597334673u, 3812015801u);
  uint n = (q.x ^ q.y) * 1597334673u;
  n ^= n >> 15;
  n *= 2246822519u;
  return float((n ^ (n >> 13)) & 0xffffu) / 65535.0;
}
float grain(vec2 at) {
  vec2 low = floor(at), t = at - low;
  t = t * t * (3.0 - 2.0 * t);
  return mix(mix(random(low), random(low + vec2(1, 0)), t.x), mix(random(low + vec2(0, 1)), random(low + 1.0), t.x), t.y);
}

void main() {
  float full = half_px;
  float ink = strength_here;
  float pressed = 1.0;
  if (strokes.x > 0.0) {
    float at = along.x / strokes.x;
    float number = floor(at);
    // No two strokes are the same.
    float gap = strokes.y * (0.4 + 1.2 * random(vec2(number, 3.0)));
    float t = (at - number) / (1.0 - gap);
    float past_px = (t - 1.0) * (1.0 - gap) * strokes.x;
    // Put down quickly, lifted slowly.
    float profile = smoothstep(0.0, 0.12, t) * (1.0 - smoothstep(0.45, 1.0, t) * 0.85);
    pressed *= mix(1.0, profile, strokes.z);
    ink *= clamp(0.5 - past_px, 0.0, 1.0);
  }
  if (taper_px > 0.0) pressed *= clamp(to_end_px / taper_px, 0.0, 1.0);
  float half_here = full * pressed;
  float middle = outside ? half_here - full : 0.0;
  float across = along.y - middle;
  float coverage = clamp(half_here + 0.5 - abs(across), 0.0, 1.0) * min(2.0 * half_here, 1.0);
#ifdef BRUSH
  // Of thin lines nobody sees the bristles.
  float trace = texture(brush, vec2(along.x / brush_px, 0.5 + 0.5 * across / max(half_here, 0.5))).a;
  ink *= mix(1.0, trace, smoothstep(0.5, 2.5, half_here));
#endif
  if (strokes.w > 0.0) {
    // The less pressure, the more of the paper's hollows stay bare; stretched along the stroke, as the brush runs.
    float paper = 0.6 * grain(along * vec2(0.11, 0.8)) + 0.4 * grain(along * vec2(0.45, 0.55) + 17.0);
    float bare = strokes.w * (1.15 - 0.6 * pressed);
    ink *= smoothstep(bare - 0.14, bare + 0.14, paper + 0.08);
  }
  float seen = smoothstep(0.0, 1.0, shown);
  float depth = middle_depth;
  if (dash_px > 0.0) {
    float phase = abs(fract(along.x / dash_px) - 0.5) * dash_px;
    seen = (1.0 - seen) * clamp(0.3 * dash_px - phase + 0.5, 0.0, 1.0);
  }
  ivec2 here = clamp(ivec2(gl_FragCoord.xy) - origin, ivec2(0), last_pixel);
  float own = texelFetch(own_depth, here, 0).x;
  if (dash_px > 0.0) {
    depth = max(depth, own);
  } else if (!outside && own > depth) {
    // Over the surface that the line belongs to, but under what lies before that.
    if (near_m / depth - near_m / own > thickness_m) discard;
    depth = own;
  }
  float strength = coverage * ink * seen * opacity;
  if (strength <= 0.0 || (outside && opaque != (strength >= 0.999))) discard;
  // Outside the contour a little farther than the body, whose soft edge lies over the line's; else a little before it.
  gl_FragDepth = outside ? depth * 0.9998 : min(depth * 1.002, 1.0);
  fragment = vec4(colour, 1.0) * strength;
}
