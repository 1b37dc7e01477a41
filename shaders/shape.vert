#version 330 core
// A shape that wears the maps. Row 0 of the target is the top, so y is turned over.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 tangent;
layout(location = 3) in vec2 map_place;
uniform mat4 projection;
out vec3 world, world_normal, world_tangent;
out vec2 place;

void main() {
  world = position;
  world_normal = normal;
  world_tangent = tangent;
  place = map_place;
  vec4 clip = projection * vec4(position, 1.0);
  gl_Position = vec4(clip.x, -clip.y, clip.zw);
}
