#version 330 core
// A scatter plot's points, in pixels from the top left corner of the target (whose row 0 is the top).
layout(location = 0) in vec2 position;
layout(location = 1) in vec4 color;
uniform vec2 extent;     // of the target, pixels
uniform float diameter;  // of a point, pixels
flat out vec4 point_color;

void main() {
  gl_Position = vec4(2.0 * position / extent - 1.0, 0.0, 1.0);
  gl_PointSize = diameter + 1.0;  // room for the soft edge
  point_color = color;
}
