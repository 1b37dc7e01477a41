#version 330 core
// A picture at another exposure, or the difference of two. Both are what a camera would give: clipped at white first,
// exposed after that, so that what was clipped turns grey alike.
uniform sampler2D picture, other;
uniform vec2 size;        // of the target, pixels
uniform float factor;     // 2^stops
uniform bool difference;  // else the picture alone
uniform bool signed_difference;
uniform float gain;
out vec4 color;

vec3 to_linear(vec3 v) {
  return mix(v / 12.92, pow((v + 0.055) / 1.055, vec3(2.4)), greaterThan(v, vec3(0.04045)));
}

vec3 to_srgb(vec3 linear) {
  vec3 v = clamp(linear, 0.0, 1.0);
  return mix(12.92 * v, 1.055 * pow(v, vec3(1.0 / 2.4)) - 0.055, greaterThan(v, vec3(0.0031308)));
}

vec3 exposed(sampler2D image, vec2 at) {
  vec3 v = texture(image, at).rgb;
  return factor == 1.0 ? v : to_srgb(factor * to_linear(v));
}

void main() {
  vec2 at = gl_FragCoord.xy / size;
  vec3 shown = exposed(picture, at);
  if (difference) {
    vec3 change = gain * (shown - exposed(other, at));
    shown = signed_difference ? 0.5 + 0.5 * change : abs(change);
  }
  color = vec4(clamp(shown, 0.0, 1.0), 1.0);
}
