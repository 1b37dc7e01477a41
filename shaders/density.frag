#version 330 core
// Counts of points per cell as colour: smoothed, on a logarithmic scale, along a path of even lightness steps. Premultiplied.
uniform sampler2D counts;
uniform float cell;  // side of a cell, pixels
uniform float peak;  // count at the top of the scale
out vec4 color;

float count_at(ivec2 at) {
  return texelFetch(counts, clamp(at, ivec2(0), textureSize(counts, 0) - 1), 0).r;
}

// The quadratic B-spline through the cells around a point: smooth, sums to the counts, never negative.
float smooth_count(vec2 at) {
  vec2 nearest = floor(at);
  vec2 t = at - nearest - 0.5;  // from the cell's centre, in [-1/2, 1/2]
  vec2 below = 0.5 * (0.5 - t) * (0.5 - t), above = 0.5 * (0.5 + t) * (0.5 + t), mid = 1.0 - below - above;
  ivec2 c = ivec2(nearest);
  vec3 rows;
  for (int r = -1; r <= 1; ++r) {
    rows[r + 1] = below.x * count_at(c + ivec2(-1, r)) + mid.x * count_at(c + ivec2(0, r)) +
                  above.x * count_at(c + ivec2(1, r));
  }
  return dot(rows, vec3(below.y, mid.y, above.y));
}

// From deep blue over green to pale yellow, lightness linear in t: a path through Oklab (Ottosson 2020).
vec3 ramp(float t) {
  float lightness = mix(0.42, 0.96, t), hue = mix(4.6, 1.85, t), chroma = 0.115;
  float a = chroma * cos(hue), b = chroma * sin(hue);
  vec3 lms = lightness + vec3(0.3963377774 * a + 0.2158037573 * b, -0.1055613458 * a - 0.0638541728 * b,
                              -0.0894841775 * a - 1.2914855480 * b);
  lms = lms * lms * lms;
  vec3 linear = vec3(dot(lms, vec3(4.0767416621, -3.3077115913, 0.2309699292)),
                     dot(lms, vec3(-1.2684380046, 2.6097574011, -0.3413193965)),
                     dot(lms, vec3(-0.0041960863, -0.7034186147, 1.7076147010)));
  linear = clamp(linear, 0.0, 1.0);
  return mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, greaterThan(linear, vec3(0.0031308)));
}

void main() {
  float count = smooth_count(gl_FragCoord.xy / cell);
  if (count <= 0.0) {
    color = vec4(0.0);
    return;
  }
  float alpha = min(1.0, 2.0 * count);  // a lone point is seen as a soft dot
  color = vec4(ramp(clamp(log(1.0 + count) / log(1.0 + peak), 0.0, 1.0)) * alpha, alpha);
}
