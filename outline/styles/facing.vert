layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 outline_normal;  // w: rim of a contour strip

uniform mat4 camera_from_object;
uniform mat3 camera_from_normal;
uniform vec2 offset_px;  // of the edge and of the rim
uniform float edge_coverage;
uniform bool feather;

out vec3 seen_normal;
out vec3 seen_from;
out float coverage;

void main() {
  vec4 clip = clip_from_object * vec4(position, 1.0);
  bool rim = feather && outline_normal.w > 0.5;
  clip = pushed(clip, outline_normal.xyz, rim ? offset_px.y : offset_px.x, feather ? 0.0 : 1.0);
  coverage = rim ? 0.0 : edge_coverage;
  // Before the body, which is drawn at the same place. Depth is near / Z.
  clip.z *= 1.0005;
  gl_Position = clip;
  seen_normal = camera_from_normal * normal;
  seen_from = (camera_from_object * vec4(position, 1.0)).xyz;
}
