// Colours of the object drawn at a fraction of the resolution.

uniform sampler2D coarse_colour, band_colour;  // of surfaces, and of bands along the contour; premultiplied
uniform sampler2D coarse_depth, band_depth;    // near / Z
uniform vec3 coarse_from_pixel;                // to be added to a pixel's place, and texels a pixel
uniform float depth_tolerance;                 // relative: what differs by less is the same surface

// 1 for this pixel's own surface, falling with the fourth power beyond the tolerance. `bend`: what the depth of the plane
// that this pixel lies in has changed by, there.
vec4 alike(vec4 depth, vec4 bend) {
  vec4 apart = abs(depth - gl_FragCoord.z);
#ifndef FEATHER
  // Triangles that are smaller than a texel, and seen from the side, tell little of their surroundings.
  apart = min(apart, abs(depth - gl_FragCoord.z - bend));
#endif
  apart /= gl_FragCoord.z;
#ifdef FEATHER
  // At a contour the own surface bends towards the eye, and what lies behind is another.
  apart *= mix(vec4(1.0), vec4(0.25), greaterThan(depth, vec4(gl_FragCoord.z)));
#endif
  apart /= depth_tolerance;
  vec4 near = 1.0 / (1.0 + apart * apart);
  return near * near;
}

// The colour at this pixel: that of the texels around it which lie at its depth. `otherwise` where there are none.
vec3 looked_up_colour(vec3 otherwise) {
  vec2 at = (gl_FragCoord.xy + coarse_from_pixel.xy) * coarse_from_pixel.z;
  vec2 first = floor(at - 0.5);
  vec2 f = at - 0.5 - first;
  // None is 0: the texel right below may be another surface's.
  vec4 near = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y) + 1e-3;
  ivec2 t = ivec2(first), band = ivec2(at);
  vec4 depth = vec4(texelFetch(coarse_depth, t, 0).x, texelFetch(coarse_depth, t + ivec2(1, 0), 0).x,
                    texelFetch(coarse_depth, t + ivec2(0, 1), 0).x, texelFetch(coarse_depth, t + ivec2(1, 1), 0).x);
  vec2 slope = vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z)) / coarse_from_pixel.z;
  vec4 bend = slope.x * (vec4(0.0, 1.0, 0.0, 1.0) - f.x) + slope.y * (vec4(0.0, 0.0, 1.0, 1.0) - f.y);
  vec4 weight = near * alike(depth, bend);
  float band_weight = 1e-2 * alike(vec4(texelFetch(band_depth, band, 0).x), vec4(0.0)).x;  // only where nothing else is alike
  vec4 sum = weight.x * texelFetch(coarse_colour, t, 0) + weight.y * texelFetch(coarse_colour, t + ivec2(1, 0), 0) +
             weight.z * texelFetch(coarse_colour, t + ivec2(0, 1), 0) +
             weight.w * texelFetch(coarse_colour, t + ivec2(1, 1), 0) + band_weight * texelFetch(band_colour, band, 0);
  return sum.a > 0.0 ? sum.rgb / sum.a : otherwise;
}
