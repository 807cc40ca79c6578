// For each pixel: where within it an edge runs (xy, 0 to 1), how strong it is (z), and the nearest depth there (w, near
// / Z). The textures are twice as fine as the pixels.
uniform sampler2D surface;
uniform sampler2D surface_depth;
uniform ivec2 last_texel;
uniform float depth_step_m;   // a larger step in depth is an edge
uniform float cos_normal;     // normals farther apart are one
uniform float contrast;       // a larger step between colours is one
uniform float near_m;

layout(location = 0) out vec4 edge;

vec4 colour_at(ivec2 t) {
  return any(lessThan(t, ivec2(0))) || any(greaterThan(t, last_texel)) ? vec4(0.0) : texelFetch(surface, t, 0);
}
float depth_at(ivec2 t) {
  return any(lessThan(t, ivec2(0))) || any(greaterThan(t, last_texel)) ? 0.0 : texelFetch(surface_depth, t, 0).x;
}

void main() {
  ivec2 base = 2 * ivec2(gl_FragCoord.xy);
  vec3 sum = vec3(0.0);  // of weighted places, and of weights
  float strongest = 0.0, nearest = 0.0;
#ifdef LAPLACIAN
  vec4 colours[16];
  for (int i = 0; i < 16; ++i) {
    ivec2 t = base + ivec2(i & 3, i >> 2) - 1;
    colours[i] = colour_at(t);
    nearest = max(nearest, depth_at(t));
  }
  for (int i = 0; i < 4; ++i) {
    ivec2 at = ivec2(i & 1, i >> 1);
    int c = (at.y + 1) * 4 + at.x + 1;
    vec4 l = 8.0 * colours[c] - colours[c - 5] - colours[c - 4] - colours[c - 3] - colours[c - 1] - colours[c + 1] -
             colours[c + 3] - colours[c + 4] - colours[c + 5];
    l = abs(l) / 3.0;  // along a straight edge that is the step
    float strength = smoothstep(0.5 * contrast, 1.5 * contrast, max(max(l.r, l.g), max(l.b, l.a)));
    strongest = max(strongest, strength);
    sum += strength * vec3(0.5 * vec2(at) + 0.25, 1.0);
  }
#else
  // From each of the four texels to the right and down.
  float covered[25], depths[25];
  vec3 normals[25];
  for (int i = 0; i < 25; ++i) {
    ivec2 t = base + ivec2(i % 5, i / 5) - 1;
    depths[i] = depth_at(t);
    covered[i] = depths[i] > 0.0 ? 1.0 : 0.0;
#ifdef DEPTH_NORMALS
    normals[i] = 2.0 * colour_at(t).xyz - 1.0;
#endif
  }
  for (int i = 0; i < 8; ++i) {
    ivec2 at = ivec2(i & 1, (i >> 1) & 1);
    bool down = i >= 4;
    int a = (at.y + 1) * 5 + at.x + 1, step = down ? 5 : 1;
    int b = a + step;
    bool is_edge = covered[a] != covered[b];
#ifdef DEPTH_NORMALS
    if (covered[a] * covered[b] > 0.0) {
      // near / Z is linear across a plane, so what misses both continuations is a step.
      float from_a = abs(depths[b] - 2.0 * depths[a] + depths[a - step]);
      float from_b = abs(depths[a] - 2.0 * depths[b] + depths[b + step]);
      float jump = min(min(from_a, from_b), abs(depths[a] - depths[b]));
      is_edge = jump * near_m > depth_step_m * depths[a] * depths[b] ||
                dot(normals[a], normals[b]) < cos_normal * length(normals[a]) * length(normals[b]);
    }
#endif
    if (!is_edge) continue;
    vec2 place = 0.5 * vec2(at) + (down ? vec2(0.25, 0.5) : vec2(0.5, 0.25));
    sum += vec3(place, 1.0);
    strongest = 1.0;
    nearest = max(nearest, max(depths[a], depths[b]));
  }
#endif
  edge = sum.z > 0.0 ? vec4(sum.xy / sum.z, strongest, nearest) : vec4(0.0);
}
