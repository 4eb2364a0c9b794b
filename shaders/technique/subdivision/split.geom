// One pass: a triangle goes to those that are done, to those that a border runs through, or in two, three or four parts
// to the next pass, as one, two or three of its edges are split.
#include "technique/subdivision/candidate.glsl"
#include "technique/subdivision/edge.glsl"

layout(points) in;
layout(points, max_vertices = 5) out;

in CANDIDATE candidate[];

#ifdef SORTED
// All in one, in their order; a second stream only counts what was split.
layout(stream = 0, xfb_buffer = 0, xfb_offset = 0, xfb_stride = 96) flat out uvec4 kept[RECORD_TEXELS];
layout(stream = 1) flat out uint was_split;
#else
layout(stream = 0, xfb_buffer = 0, xfb_offset = 0, xfb_stride = 96) flat out uvec4 straight[RECORD_TEXELS];
layout(stream = 1, xfb_buffer = 1, xfb_offset = 0, xfb_stride = 96) flat out uvec4 next[RECORD_TEXELS];
layout(stream = 2, xfb_buffer = 2, xfb_offset = 0, xfb_stride = 96) flat out uvec4 border[RECORD_TEXELS];
// Of the scene's triangles: an index buffer in which those that are not drawn as they are have no extent.
layout(stream = 3, xfb_buffer = 3, xfb_offset = 0, xfb_stride = 12) flat out uvec3 plain_corners;
#endif

uniform bool is_part;      // not a whole triangle of the scene
uniform vec3 field_axis;   // unit, camera frame
uniform vec2 field_angle;  // cosine and sine of how far from it the image reaches

// False when a triangle is further outside than it is large.
bool is_in_field(Record r) {
  float nearest = 1.0, size2 = 0.0;
  vec3 ray[3] = vec3[3](normalize(r.position[0]), normalize(r.position[1]), normalize(r.position[2]));
  for (int i = 0; i < 3; ++i) {
    nearest = min(nearest, dot(field_axis, ray[i]));
    vec3 edge = ray[(i + 1) % 3] - ray[i];
    size2 = max(size2, dot(edge, edge));
  }
  // Cosine and sine of the longest edge's angle from its chord.
  float cosine = 1.0 - 0.5 * size2, sine = sqrt(max(0.0, size2 * (1.0 - 0.25 * size2)));
  return cosine <= -field_angle.x || nearest >= field_angle.x * cosine - field_angle.y * sine - 1e-5;
}

// The middle of the edge from corner i.
void halve(Record r, int i, out vec3 position, out vec2 pixel, out vec2 weight) {
  int j = (i + 1) % 3;
  position = middle(r.position[i], r.position[j]);
  pixel = on_grid(pixel_of(position));
  weight = mix(r.weight[i], r.weight[j], middle_share(r.position[i], r.position[j]));
}

#ifdef TESSELLATED
// What is decided of the line between two of the six points of emit_parts: an edge, half of one, or within.
uint decided_of_line(uvec3 decided, int p, int q) {
  for (int edge = 0; edge < 3; ++edge) {
    bool p_ends = p == edge || p == (edge + 1) % 3, q_ends = q == edge || q == (edge + 1) % 3;
    if (p_ends && q_ends) return decided[edge];
    bool is_half = (p_ends && q == 3 + edge) || (q_ends && p == 3 + edge);
    if (is_half) return max(decided[edge], 1u) - 1u;
  }
  return 0u;
}
#endif

void emit_parts(Record r, bvec3 split) {
  int count = int(split.x) + int(split.y) + int(split.z);
  // Six points: the corners and the middles of the edges that follow them, turned so that of one or two edges the first
  // are split.
  int turn = count == 1 ? (split.x ? 0 : split.y ? 1 : 2) : count == 2 ? (!split.z ? 0 : !split.x ? 1 : 2) : 0;
  vec3 position[6];
  vec2 pixel[6], weight[6];
  uvec3 decided;
  for (int i = 0; i < 3; ++i) {
    int corner = (i + turn) % 3;
    decided[i] = r.decided[corner];
    position[i] = r.position[corner];
    pixel[i] = r.pixel[corner];
    weight[i] = r.weight[corner];
  }
  for (int i = 0; i < count; ++i) halve(r, (i + turn) % 3, position[3 + i], pixel[3 + i], weight[3 + i]);
  ivec3 part[4];
  if (count == 1) {
    part = ivec3[4](ivec3(0, 3, 2), ivec3(3, 1, 2), ivec3(0), ivec3(0));
  } else if (count == 2) {
    bool across = distance(normalize(position[0]), normalize(position[4])) < distance(normalize(position[3]), normalize(position[2]));
    part = across ? ivec3[4](ivec3(3, 1, 4), ivec3(0, 3, 4), ivec3(0, 4, 2), ivec3(0))
                  : ivec3[4](ivec3(3, 1, 4), ivec3(0, 3, 2), ivec3(3, 4, 2), ivec3(0));
  } else {
    part = ivec3[4](ivec3(0, 3, 5), ivec3(3, 1, 4), ivec3(5, 4, 2), ivec3(3, 4, 5));
  }
  for (int k = 0; k <= count; ++k) {
    Record child;
    for (int i = 0; i < 3; ++i) {
      child.position[i] = position[part[k][i]];
      child.pixel[i] = pixel[part[k][i]];
      child.weight[i] = weight[part[k][i]];
    }
    child.whose = r.whose;
    child.broken = 0u;
    child.decided = uvec3(0u);
#ifdef TESSELLATED
    for (int i = 0; i < 3; ++i) child.decided[i] = decided_of_line(decided, part[k][i], part[k][(i + 1) % 3]);
#endif
#ifdef SORTED
    kept = pack_record(child);
    EmitStreamVertex(0);
#else
    next = pack_record(child);
    EmitStreamVertex(1);
#endif
  }
}

void main() {
  Record r = unpack_record(candidate[0].texel);
  bool drawn = candidate[0].faces != 0u && is_in_field(r);
  ivec3 state = ivec3(BROKEN);
  for (bool look = drawn; look; look = false) {
    for (int i = 0; i < 3; ++i) {
      int j = (i + 1) % 3;
      state[i] = r.decided[i] > 0u ? int(r.decided[i]) - 1
                                   : edge_state(r.position[i], r.position[j], r.pixel[i], r.pixel[j]);
    }
  }
  bvec3 split = equal(state, ivec3(SPLIT)), broken = equal(state, ivec3(BROKEN));
#ifdef TESSELLATED
  // The tessellation unit halves edges only of triangles that are whole, and in no order.
  bvec3 halved = greaterThan(state, ivec3(STRAIGHT));
#ifdef SORTED
  bool halves = any(halved) && !any(split);
#else
  bool halves = any(halved) && !any(split) && any(broken);
#endif
  if (halves) split = halved;
  if (halves || !any(split)) r.decided = uvec3(max(state + 1, 0));
#endif
  bool done = drawn && !any(split) && (beyond(r.pixel[0]) & beyond(r.pixel[1]) & beyond(r.pixel[2])) == 0;
  r.broken = uint(broken.x) | uint(broken.y) << 1 | uint(broken.z) << 2;
#ifdef SORTED
  if (done) {
    kept = pack_record(r);
    EmitStreamVertex(0);
  }
#else
  bool is_straight = done && r.broken == 0u;
#ifdef TESSELLATED
  bool as_it_is = !is_part && !any(halved);
#else
  bool as_it_is = !is_part;
#endif
  if (is_straight && !as_it_is) {
    straight = pack_record(r);
    EmitStreamVertex(0);
  }
  is_straight = is_straight && as_it_is;
  if (!is_part) {
    plain_corners = is_straight ? candidate[0].corners : uvec3(candidate[0].corners.x);
    EmitStreamVertex(3);
  }
  for (bool go = done && r.broken != 0u; go; go = false) {
    border = pack_record(r);
    EmitStreamVertex(2);
  }
#endif
  for (bool go = drawn && any(split); go; go = false) {
#ifdef SORTED
    was_split = 1u;
    EmitStreamVertex(1);
#endif
    emit_parts(r, split);
  }
}
