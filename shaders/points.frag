#version 330 core
// A disc with an edge one pixel soft; premultiplied.
uniform float diameter;
flat in vec4 point_color;
out vec4 color;

void main() {
  float distance_to_edge = 0.5 * diameter - length(gl_PointCoord - 0.5) * (diameter + 1.0);
  float alpha = point_color.a * clamp(distance_to_edge + 0.5, 0.0, 1.0);
  color = vec4(point_color.rgb * alpha, alpha);
}
