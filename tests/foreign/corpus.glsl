// Each construct of a shader once, in words that GLSL and C++ share: the test compiles this file by both and compares bits.
// a 0 1 0.3
// b 0 1 0.6

float sums(float a, float b) { return a + b - a * b / (a + float(1.0)); }

float a_constant(float a, float b) {
  const float third = float(1.0) / float(3.0);
  return third * a + float(0.1) * b;
}

float a_branch(float a, float b) {
  if (a < b) return a * a;
  return b / (a + b);
}

float both_sides(float a, float b) {
  float x;
  if (a + b > float(1.0)) {
    x = a - b;
  } else {
    x = a * b;
    if (b > float(0.5)) x = x + a;
  }
  return x * float(2.0);
}

float a_choice(float a, float b) { return a >= b ? a / (b + float(1.0)) : b - a; }

float logic(float a, float b) {
  bool low = a <= float(0.25) || b <= float(0.25);
  bool near = !(a > b) && b != float(0.5);
  return low && near ? a : (low ? b : a + b);
}

float a_loop(float a, float b) {
  float s = float(0.0);
  for (int i = 0; i < 5; ++i) s = s * a + b;
  return s;
}

float a_way_out(float a, float b) {
  float s = float(0.0);
  float t = float(1.0);
  for (int i = 1; i <= 12; ++i) {
    s = s + t;
    t = t * a / float(i);
    if (t < float(0.01) * b) break;
  }
  return s;
}

float left_over(float a, float b) {
  float s = a;
  for (int i = 0; i < 4; ++i) {
    if (i == 2) continue;
    if (s > float(2.0)) return s * b;
    s = s + b;
  }
  return s;
}

float a_float_counter(float a, float b) {
  float s = float(0.0);
  for (float y = float(0.0); y < float(1.0); y += float(0.25)) s += a * y + b;
  return s;
}

float a_table(float a, float b) {
  float s = float(0.0);
  vec3 weights = vec3(float(0.25), float(0.5), float(0.25));
  for (int i = 0; i < 3; ++i) s += weights[i] * (a + float(i) * b);
  return s;
}

float roots(float a, float b) { return sqrt(a) + inversesqrt(b + float(0.5)) - abs(a - b); }

float steps(float a, float b) {
  return floor(a * float(7.0)) + fract(b * float(3.0)) + step(a, b) + smoothstep(float(0.2), float(0.9), a) + sign(a - b);
}

float bounds(float a, float b) {
  return clamp(a * float(3.0) - float(1.0), float(0.0), float(1.0)) + min(a, b) * max(b, float(0.5)) + mix(a, b, float(0.3));
}

float halves(float a, float b) {
  return roundEven(floor(a * float(16.0)) * float(0.5)) + roundEven(b * float(9.0)) * float(32.0) + roundEven(-floor(b * float(5.0)) * float(0.5));
}

float remainders(float a, float b) { return mod(a * float(5.0), b + float(0.25)); }

float curves(float a, float b) { return exp(-a) + log(b + float(1.0)) + sin(a) * cos(b) + atan(a, b + float(0.1)); }

float angles_of(float a, float b) { return acos(a) + asin(b) + atan(a); }

float helper(float x) { return x * x + float(1.0); }
float calls(float a, float b) { return helper(a) * helper(helper(b)); }

float by_reference(float a, float b) {
  float x = a;
  x += b;
  x *= x;
  x -= a;
  x /= b + float(1.0);
  return -x;
}

vec3 of_vectors(vec3 L, vec3 V, vec3 N, float a) {
  vec3 H = normalize(L + V);
  float NoH = dot(N, H);
  vec3 R = reflect(-L, N);
  return cross(L, V) * a + H * NoH + R / float(3.0) - vec3(a) * length(L - V);
}

vec3 parts_of_vectors(vec3 L, vec3 V, vec3 N, float a) {
  vec3 c = L;
  c.x = V.y;
  c.z += a;
  vec3 d = max(c, vec3(float(0.1))) * min(V, vec3(a));
  return mix(c.zxy, d, a) + vec3(dot(c, d), c.y, dot(N, d));
}
