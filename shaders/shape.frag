#version 330 core
// Maps on a shape under a distant light, as strong as the capture light at the sample's middle, and a faint even light:
//   L = light / d^2 (c_l base_color / pi + sum over lobes of F D G / (4 c_v)) + even light
// GGX D with alpha = roughness^2 as in surface.frag; where the light is no longer beside the camera, Schlick's F and
// Smith's G (correlated heights; Heitz 2014) matter, too. At normal incidence from the camera they are F0 and 1.
uniform sampler2D base_color, normal;
uniform sampler2D lobe_normal_0, lobe_normal_1, lobe_normal_2, lobe_normal_3;
uniform sampler2D roughness_0, roughness_1, roughness_2, roughness_3;
uniform vec3 f0_0, f0_1, f0_2, f0_3;
uniform int lobe_count;
uniform bool mirrored;  // every other copy of the maps is a mirror image
uniform float light;    // irradiance of a surface that faces the light, exposure included
uniform vec3 eye, to_light;
in vec3 world, world_normal, world_tangent;
in vec2 place;
out vec4 color;

const float kPi = 3.14159265358979;
const float kLeastCosine = 1e-3;
const float kEven = 0.06;  // of the light comes from everywhere

vec3 map_normal(sampler2D normals) {
  vec3 n = texture(normals, place).xyz;
  if (mirrored) n.xy *= 1.0 - 2.0 * mod(floor(place), 2.0) * vec2(1.0);
  return normalize(n);
}

float masked(vec2 alpha, vec3 w) {
  vec2 spread = alpha * w.xy;
  return 0.5 * (sqrt(1.0 + dot(spread, spread) / (w.z * w.z)) - 1.0);
}

// c_l F D G / (4 c_l c_v) of a lobe, with l, v and h in the frame of its normal, whose tangent lies in the xz plane.
vec3 lobe(sampler2D normals, sampler2D roughnesses, vec3 f0, vec3 l, vec3 v) {
  vec3 n = map_normal(normals);
  vec3 tangent = normalize(vec3(n.z, 0.0, -n.x));
  mat3 frame = mat3(tangent, cross(n, tangent), n);
  l = l * frame;
  v = v * frame;
  if (l.z <= 0.0) return vec3(0.0);
  v.z = max(v.z, kLeastCosine);
  vec2 roughness = texture(roughnesses, place).rg;
  vec2 alpha = max(roughness * roughness, 1e-3);
  vec3 h = normalize(l + v);
  vec2 stretched = h.xy / alpha;
  float q = dot(stretched, stretched) + h.z * h.z;
  float d = 1.0 / (kPi * alpha.x * alpha.y * q * q);
  float g = 1.0 / (1.0 + masked(alpha, l) + masked(alpha, v));
  vec3 f = f0 + (1.0 - f0) * pow(1.0 - clamp(dot(v, h), 0.0, 1.0), 5.0);
  return f * (d * g / (4.0 * v.z));
}

vec3 display(vec3 radiance) {
  vec3 v = clamp(radiance, 0.0, 1.0);
  return mix(12.92 * v, 1.055 * pow(v, vec3(1.0 / 2.4)) - 0.055, greaterThan(v, vec3(0.0031308)));
}

void main() {
  vec3 to_eye = normalize(eye - world), n = normalize(world_normal);
  vec3 t = normalize(world_tangent - n * dot(n, world_tangent));
  mat3 frame = mat3(t, cross(n, t), n);
  vec3 l = to_light * frame, v = to_eye * frame;
  if (v.z < 0.0) {  // the back of a cloth: the same surface, seen from behind
    l.z = -l.z;
    v.z = -v.z;
  }
  vec3 sum = texture(base_color, place).rgb * (max(dot(map_normal(normal), l), 0.0) / kPi);
  if (lobe_count > 0) sum += lobe(lobe_normal_0, roughness_0, f0_0, l, v);
  if (lobe_count > 1) sum += lobe(lobe_normal_1, roughness_1, f0_1, l, v);
  if (lobe_count > 2) sum += lobe(lobe_normal_2, roughness_2, f0_2, l, v);
  if (lobe_count > 3) sum += lobe(lobe_normal_3, roughness_3, f0_3, l, v);
  float shown = smoothstep(-0.02, 0.06, l.z);  // the shape's own shadow
  vec3 even = kEven * (texture(base_color, place).rgb + 0.5 * (f0_0 + f0_1 + f0_2 + f0_3)) / kPi;
  color = vec4(display(light * (shown * sum + even)), 1.0);
}
