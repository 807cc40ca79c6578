layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;

uniform mat4 clip_from_object;
uniform mat3 camera_from_normal;
out vec3 seen_normal;

void main() {
  gl_Position = clip_from_object * vec4(position, 1.0);
  seen_normal = camera_from_normal * normal;
}
