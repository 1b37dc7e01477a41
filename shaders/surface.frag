#version 330 core
// Maps under the capture light, as engine/material/shading.h: camera and point light both at (0, 0, camera_cm),
//   L = light vignette c / d^2 (base_color / pi + sum over lobes of F0 D / (4 c^2)),  D: GGX with alpha = roughness^2.
// Row 0 of the target and of every map is the top.
uniform sampler2D base_color, normal;
uniform sampler2D lobe_normal_0, lobe_normal_1, lobe_normal_2, lobe_normal_3;
uniform sampler2D roughness_0, roughness_1, roughness_2, roughness_3;
uniform vec3 f0_0, f0_1, f0_2, f0_3;
uniform int lobe_count;
uniform float resolution;  // pixels a side
uniform float size_cm, camera_cm, vignette_sigma;
uniform float light;  // exposure included
uniform bool srgb;    // else the plain power 1/2.2
out vec4 color;

const float kPi = 3.14159265358979;
const float kLeastCosine = 1e-3;

// c F0 D / (4 c^2), D = 1 / (pi ax ay (hx^2/ax^2 + hy^2/ay^2 + hz^2)^2), with the half vector w in the frame of a normal
// whose tangent lies in the xz plane.
vec3 lobe(sampler2D normals, sampler2D roughnesses, vec3 f0, ivec2 pixel, vec3 w) {
  vec3 n = texelFetch(normals, pixel, 0).xyz;
  vec2 roughness = texelFetch(roughnesses, pixel, 0).rg;
  vec2 alpha = roughness * roughness;
  vec3 tangent = normalize(vec3(n.z, 0.0, -n.x));
  float hx = dot(w, tangent);
  float hy = dot(w, cross(n, tangent));
  float hz = clamp(dot(n, w), kLeastCosine, 1.0);
  // Where the cosine was clamped, the vector is kept at unit length; elsewhere 1 - hx^2 - hz^2 would lose digits.
  float square_hy = dot(n, w) > kLeastCosine ? hy * hy : max(1.0 - hx * hx - hz * hz, 0.0);
  float q = hx * hx / (alpha.x * alpha.x) + square_hy / (alpha.y * alpha.y) + hz * hz;
  return f0 / (4.0 * kPi * alpha.x * alpha.y * q * q * hz);
}

vec3 display(vec3 radiance) {
  vec3 v = clamp(radiance, 0.0, 1.0);
  if (!srgb) return pow(v, vec3(1.0 / 2.2));
  return mix(12.92 * v, 1.055 * pow(v, vec3(1.0 / 2.4)) - 0.055, greaterThan(v, vec3(0.0031308)));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec2 p = (gl_FragCoord.xy / resolution - 0.5) * size_cm;
  vec3 to_camera = vec3(-p.x, p.y, camera_cm);
  float d2 = dot(to_camera, to_camera);
  vec3 w = to_camera * inversesqrt(d2);

  float c = clamp(dot(texelFetch(normal, pixel, 0).xyz, w), kLeastCosine, 1.0);
  vec3 sum = texelFetch(base_color, pixel, 0).rgb * (c / kPi);
  if (lobe_count > 0) sum += lobe(lobe_normal_0, roughness_0, f0_0, pixel, w);
  if (lobe_count > 1) sum += lobe(lobe_normal_1, roughness_1, f0_1, pixel, w);
  if (lobe_count > 2) sum += lobe(lobe_normal_2, roughness_2, f0_2, pixel, w);
  if (lobe_count > 3) sum += lobe(lobe_normal_3, roughness_3, f0_3, pixel, w);

  float vignette = exp(-dot(p, p) / (2.0 * vignette_sigma * vignette_sigma));
  color = vec4(display(light * vignette / d2 * sum), 1.0);
}
