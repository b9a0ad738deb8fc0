// alpha 0.05 1 0.3
// f0 0 1 0.04
// kd 0 1 0.5
const float PI = 3.14159265358979;

float D_GGX(float NoH, float alpha) {
  float a2 = alpha * alpha;
  float d = NoH * NoH * (a2 - 1.0) + 1.0;
  return a2 / (PI * d * d);
}

float V_Smith(float NoL, float NoV, float alpha) {
  float a2 = alpha * alpha;
  return 0.5 / (NoV * sqrt(NoL * NoL * (1.0 - a2) + a2) + NoL * sqrt(NoV * NoV * (1.0 - a2) + a2));
}

vec3 brdf(float NoL, float NoV, float NoH, float VoH, float alpha, vec3 f0, vec3 kd) {
  vec3 F = f0 + (1.0 - f0) * pow(1.0 - VoH, 5.0);
  return kd / PI + D_GGX(NoH, alpha) * V_Smith(NoL, NoV, alpha) * F;
}
