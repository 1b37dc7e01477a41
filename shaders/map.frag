#version 330 core
// One map as a picture. Row 0 of the target and of the map is the top.
uniform sampler2D map;
uniform int kind;  // 0: linear colour; 1: normals, as they are exported; 2: mean of two numbers; 3: heights
uniform float low, high;  // heights that are black and white
out vec4 color;

vec3 srgb(vec3 linear) {
  vec3 v = clamp(linear, 0.0, 1.0);
  return mix(12.92 * v, 1.055 * pow(v, vec3(1.0 / 2.4)) - 0.055, greaterThan(v, vec3(0.0031308)));
}

void main() {
  vec3 value = texelFetch(map, ivec2(gl_FragCoord.xy), 0).rgb;
  if (kind == 0) color.rgb = srgb(value);
  if (kind == 1) color.rgb = 0.5 * value + 0.5;
  if (kind == 2) color.rgb = vec3(0.5 * (value.x + value.y));
  if (kind == 3) color.rgb = vec3((value.x - low) / max(high - low, 1e-12));
  color.a = 1.0;
}
