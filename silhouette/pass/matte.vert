layout(location = 0) in vec3 position;

uniform mat4 clip_from_local;

invariant gl_Position;

void main() { gl_Position = clip_from_local * vec4(position, 1.0); }
