uniform vec4 base_colour;  // straight alpha; where lit, in the brightest band
#ifdef LIT
uniform vec3 shade;        // what the darkest band multiplies the colour by
uniform float last_band;   // bands - 1
#ifdef EVEN
flat in float level;       // the same at all corners
#elif defined(FINE)
in float brightness;       // 0 to bands
#else
uniform vec3 light;        // unit, towards the light, in the world
uniform float bands;
uniform bool flip_back_faces;
in vec3 world_normal;
#endif
#endif
#ifdef TEXTURED
uniform sampler2D base_texture;
in vec2 texture_position;
#endif
#ifdef VERTEX_COLOURS
in vec4 vertex_colour;
#endif
#ifdef MASKED
uniform float alpha_cutoff;
#endif
#ifdef FEATHER
in float coverage;
#endif

layout(location = 0) out vec4 fragment;

#if defined(LIT) && !defined(EVEN)
// floor(x), with each step smoothed over one pixel.
float banded(float x) {
  float nearest = floor(x + 0.5);
  return nearest - 0.5 + clamp((x - nearest) / max(fwidth(x), 1e-6), -0.5, 0.5);
}
#endif

void main() {
  vec4 colour = base_colour;
#ifdef COARSE
  colour.rgb = looked_up_colour(colour.rgb);
#endif
#ifdef VERTEX_COLOURS
  colour *= vertex_colour;
#endif
#ifdef TEXTURED
  colour *= texture(base_texture, texture_position);
#endif
#ifdef MASKED
  if (colour.a < alpha_cutoff) discard;
  colour.a = 1.0;
#endif
#ifdef LIT
#ifndef EVEN
#ifndef FINE
  vec3 n = normalize(world_normal);
#ifdef TWO_SIDED
  if (flip_back_faces && !gl_FrontFacing) n = -n;
#endif
  float brightness = (dot(n, light) * 0.5 + 0.5) * bands;
#endif
  float level = clamp(banded(brightness), 0.0, last_band);
#endif
  colour.rgb *= mix(shade, vec3(1.0), level / last_band);
#endif
#ifndef TRANSLUCENT
  colour.a = 1.0;
#endif
  fragment = vec4(colour.rgb * colour.a, colour.a);
#ifdef FEATHER
  fragment *= min(coverage, 1.0);
#endif
}
