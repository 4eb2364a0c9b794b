// From a triangle's corners in the camera frame to what its fragments are given.
#include "technique/nonlinear/exact_triangle.glsl"
#include "technique/nonlinear/forms.glsl"

out EXACT_TRIANGLE exact;

// The plane of an edge as both of its triangles see it, to the last bit: from the corner that comes first in some order
// of places. `turned` where that is not p.
vec3 edge_plane(vec3 p, vec3 q, out bool turned) {
  turned = p.x != q.x ? q.x < p.x : p.y != q.y ? q.y < p.y : q.z < p.z;
  precise vec3 from = turned ? q : p, along = turned ? p - q : q - p;
  precise vec3 plane = vec3(from.y * along.z - from.z * along.y, from.z * along.x - from.x * along.z,
                            from.x * along.y - from.y * along.x);
  return plane;
}

// hit: the triangle's id, its instance.
void write_exact(uvec2 hit, vec3 a, vec3 b, vec3 c) {
  vec3 normal = cross(b - a, c - a);
  float volume = dot(a, normal);
  bvec3 turned;
  vec3 plane[3] = vec3[3](edge_plane(b, c, turned.x), edge_plane(c, a, turned.y), edge_plane(a, b, turned.z));
  // Inwards, for either winding. Of two triangles on the two sides of an edge one sees the plane as it was formed.
  bvec3 outwards = volume < 0.0 ? not(turned) : turned;
  exact.number = uvec3(hit, 0u);
  for (int i = 0; i < 3; ++i) {
    exact.plane[i] = outwards[i] ? -plane[i] : plane[i];
    if (!outwards[i]) exact.number.z |= 1u << i;
  }
  exact.inverse_distance = vec4(normal, volume);
#ifdef SOME_ARE_STRAIGHT
  // Decided by the edge alone, whatever the other triangle is.
  vec3 ua = normalize(a), ub = normalize(b), uc = normalize(c);
  vec3 chord = vec3(distance(ub, uc), distance(uc, ua), distance(ua, ub));
  for (int i = 0; i < 3; ++i) {
    if (chord[i] < 1.01 * STRAIGHT_ANGLE) exact.number.z |= 8u << i;
  }
#endif
}

float distance_to_edge(vec3 p, vec3 q) {
  vec3 along = q - p;
  return length(p + along * clamp(-dot(p, along) / max(dot(along, along), 1e-30), 0.0, 1.0));
}

// A depth that no point of the triangle exceeds.
float nearest_depth(vec3 a, vec3 b, vec3 c) {
  vec3 normal = cross(b - a, c - a);
  float volume = dot(a, normal);
  // The foot of the perpendicular, where that lies within the triangle.
  vec3 foot = volume < 0.0 ? -normal : normal;
  bool within = volume * dot(cross(b, c), foot) >= 0.0 && volume * dot(cross(c, a), foot) >= 0.0 &&
                volume * dot(cross(a, b), foot) >= 0.0;
  float nearest = within ? abs(volume) / length(normal)
                         : min(distance_to_edge(a, b), min(distance_to_edge(b, c), distance_to_edge(c, a)));
  nearest = 0.999 * nearest - 1e-6 * max(length(a), max(length(b), length(c)));
  return nearest > NEAR ? NEAR / nearest : 1.0;
}
