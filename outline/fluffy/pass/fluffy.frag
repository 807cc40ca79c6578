uniform sampler2DArray transmission;  // premultiplied
uniform float sine;        // of half the band's width
uniform float fade_from;   // the part of the band about its middle in which fluff is as opaque as it gets
uniform float foot_shade;  // what the colour is multiplied by at the skin
#ifdef RIM
uniform vec4 rim_colour;
uniform float rim_px;
#endif
#ifdef LIT
uniform vec3 shade;        // what the darkest band multiplies the colour by
uniform float last_band;   // bands - 1
in float brightness;
#endif

in vec3 texture_position;
in float facing;
in float height;
in float presence;
in vec3 tint;

layout(location = 0) out vec4 fragment;

#ifdef LIT
// floor(x), with each step smoothed over one pixel.
float banded(float x) {
  float nearest = floor(x + 0.5);
  return nearest - 0.5 + clamp((x - nearest) / max(fwidth(x), 1e-6), -0.5, 0.5);
}
#endif

// The level of detail between what a texel's long side and its area ask for: layers are seen on edge, and would be a
// blur by the long side alone.
float level_of_detail(vec2 place) {
  vec2 texels = vec2(textureSize(transmission, 0).xy);
  vec2 dx = dFdx(place) * texels, dy = dFdy(place) * texels;
  float area = abs(dx.x * dy.y - dx.y * dy.x);
  float longest = max(dot(dx, dx), dot(dy, dy));
  return max(0.5 * log2(max(mix(area, longest, 0.1), 1e-8)), 0.0);
}

#ifdef RIM
// The most of the tufts' opacity around a place, as far as the line is wide.
float widened(vec3 place, float lod) {
  vec2 along_x = dFdx(place.xy) * rim_px, along_y = dFdy(place.xy) * rim_px;
  float most = textureLod(transmission, place, lod).a;
  for (int k = 0; k < 5; ++k) {
    vec2 step = vec2(cos(1.2566 * float(k)), sin(1.2566 * float(k)));
    most = max(most, textureLod(transmission, vec3(place.xy + along_x * step.x + along_y * step.y, place.z), lod).a);
  }
  return most;
}
#endif

void main() {
#ifdef RIM
  // Only of tufts that may stand against what is behind the object.
  float seen = presence * (1.0 - smoothstep(0.0, 0.5, facing / sine)) * (1.0 - smoothstep(fade_from, 1.0, -facing / sine));
  fragment = rim_colour * (widened(texture_position, level_of_detail(texture_position.xy)) * seen);
#else
  float opacity = presence * (1.0 - smoothstep(fade_from, 1.0, abs(facing) / sine));
  vec4 colour = textureLod(transmission, texture_position, level_of_detail(texture_position.xy)) * opacity;
  colour.rgb *= tint * mix(foot_shade, 1.0, height);
#ifdef LIT
  float level = clamp(banded(brightness), 0.0, last_band);
  colour.rgb *= mix(shade, vec3(1.0), level / last_band);
#endif
  fragment = colour;
#endif
}
