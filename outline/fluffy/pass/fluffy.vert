// A vertex of one layer of fluff. Indices are vertex * layers + layer.

struct FluffVertex {
  vec3 position;  // of the skin
  float u;
  vec3 growth;    // from the skin to the top layer
  float v;
  vec3 normal;
  uint colour;
};
layout(std430, binding = 0) readonly buffer Vertices { FluffVertex vertices[]; };

uniform mat4 clip_from_frame;
uniform vec3 eye;
uniform uint layers;
uniform uint step_between; // layers between drawn ones, counted from the top; every other one fades in
uniform float fresh;     // how far those have come, 0 to 1
uniform vec3 hang;       // how far the tips hang down, in lengths of the fluff
uniform vec4 own_colour; // instead of the body's where its alpha is 1
#ifdef RIM
uniform vec2 viewport_px;
uniform float rim_px;
#endif
#ifdef LIT
uniform vec3 light;      // unit, towards it
uniform float bands;
out float brightness;    // 0 to bands
#endif

out vec3 texture_position;
out float facing;        // the cosine between normal and line of sight
out float height;        // of the layer, 1 at the top
out float presence;      // of the layer
out vec3 tint;

void main() {
  uint id = uint(gl_VertexID);
  uint layer = id % layers;
  FluffVertex vertex = vertices[id / layers];
  height = float(layer + 1u) / float(layers);
  // Tips hang along the skin, as far as they may, and the more the farther out they are.
  float long_m = length(vertex.growth);
  vec3 along_skin = hang - vertex.normal * dot(hang, vertex.normal);
  vec3 position = vertex.position + vertex.growth * height + along_skin * (long_m * height * height);
  gl_Position = clip_from_frame * vec4(position, 1.0);
  gl_Position.z *= 1.0002;  // the lowest layer lies on the body. Depth is near / Z
#ifdef RIM
  // Outwards across the screen, so that there is room for the line around the tips.
  vec4 outwards = clip_from_frame * vec4(vertex.normal, 0.0);
  vec2 way = (outwards.xy * gl_Position.w - gl_Position.xy * outwards.w) * viewport_px;
  if (length(way) > 0.0) gl_Position.xy += normalize(way) * (rim_px * 2.0 * abs(gl_Position.w)) / viewport_px;
  gl_Position.z *= 0.9995;  // behind the fluff
#endif
  texture_position = vec3(vertex.u, vertex.v, float(layer));
  facing = dot(vertex.normal, normalize(eye - vertex.position));
  presence = (layers - 1u - layer) % (2u * step_between) == 0u ? 1.0 : fresh;
  tint = mix(unpackUnorm4x8(vertex.colour).rgb, own_colour.rgb, own_colour.a);
#ifdef LIT
  brightness = (dot(vertex.normal, light) * 0.5 + 0.5) * bands;
#endif
}
