#version 330 core
// Dear ImGui's vertices, in its own units with y downwards, as in the picture that they are drawn into.
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 coordinate;
layout(location = 2) in vec4 color;
uniform vec2 origin;  // top left corner of the window
uniform vec2 extent;  // its size
out vec2 image_coordinate;
out vec4 tint;

void main() {
  gl_Position = vec4(2.0 * (position - origin) / extent - 1.0, 0.0, 1.0);
  image_coordinate = coordinate;
  tint = color;
}
