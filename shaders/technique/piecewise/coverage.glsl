// Which pieces a triangle reaches: a tree of cones over the pieces, then the separating planes of the triangle's and
// the piece's pyramids, which for two convex pyramids with one apex decide exactly.
#include "technique/piecewise/pieces.glsl"
#include "technique/piecewise/scene_triangle.glsl"

struct NodeRecord {
  vec4 cone;   // axis; sine of the half angle, 2 where that is a right angle or more
  uvec4 link;  // the node after this one's descendants, its piece or NO_PIECE, the half angle's cosine as bits
};

const uint NO_PIECE = 0xffffffffu;

// In the order of a walk that visits a node before its children, which come one after another.
layout(std430, binding = 3) readonly buffer NodeBlock { NodeRecord nodes[]; };

uniform int node_count;

// A triangle as a pyramid from the camera's centre, and the cone around it.
struct Pyramid {
  vec3 corner[3];
  vec3 side[3];  // unit, pointing inwards
  vec3 axis;
  float cosine, sine;
};

// False when the triangle faces away (where that hides it) or has the camera in its plane.
bool pyramid_of(vec3 a, vec3 b, vec3 c, float cull_sign, out Pyramid pyramid) {
  // The same to the last bit in whichever stage: a triangle seen edge on must not be there for one variant only.
  precise vec3 ab = b - a, ac = c - a;
  precise float volume = dot(a, cross(ab, ac));
  if (volume == 0.0 || cull_sign * volume > 0.0) return false;
  float turn = volume < 0.0 ? -1.0 : 1.0;
  pyramid.corner = vec3[3](a, b, c);
  // b x c, c x a and a x b, by differences: small triangles far away keep their directions.
  pyramid.side = vec3[3](turn * normalize(cross(b, c - b)), turn * normalize(cross(ac, a)), turn * normalize(cross(a, ab)));
  vec3 ua = normalize(a), ub = normalize(b), uc = normalize(c);
  pyramid.axis = normalize(ua + ub + uc);
  pyramid.cosine = min(dot(pyramid.axis, ua), min(dot(pyramid.axis, ub), dot(pyramid.axis, uc)));
  pyramid.sine = sqrt(max(0.0, 1.0 - pyramid.cosine * pyramid.cosine));
  return true;
}

const float LEEWAY = 1e-5;  // radians; for rounding, on the side of drawing too much

// False when two cones, given by the cosines and sines of their half angles, are apart.
bool cones_meet(vec3 axis, float cosine, float sine, NodeRecord node) {
  float node_cosine = uintBitsToFloat(node.link.z);
  return node.cone.w > 1.0 || cosine <= 0.0 ||
         dot(axis, node.cone.xyz) > cosine * node_cosine - sine * node.cone.w - LEEWAY;
}

bool may_reach(Pyramid pyramid, NodeRecord node) {
  float beyond = -node.cone.w - LEEWAY;
  return dot(pyramid.side[0], node.cone.xyz) > beyond && dot(pyramid.side[1], node.cone.xyz) > beyond &&
         dot(pyramid.side[2], node.cone.xyz) > beyond &&
         cones_meet(pyramid.axis, pyramid.cosine, pyramid.sine, node);
}

bool reaches(Pyramid pyramid, uint piece) {
  PieceRecord record = pieces[piece];
  for (int k = 0; k < 4; ++k) {
    vec3 plane = record.plane[k].xyz;
    if (dot(plane, pyramid.corner[0]) < 0.0 && dot(plane, pyramid.corner[1]) < 0.0 &&
        dot(plane, pyramid.corner[2]) < 0.0) {
      return false;
    }
  }
  for (int i = 0; i < 3; ++i) {
    vec3 side = pyramid.side[i];
    if (dot(side, record.ray[0].xyz) < -LEEWAY && dot(side, record.ray[1].xyz) < -LEEWAY &&
        dot(side, record.ray[2].xyz) < -LEEWAY && dot(side, record.ray[3].xyz) < -LEEWAY) {
      return false;
    }
  }
  return true;
}

// The next piece that the triangle reaches, from `node` on and before `end`; NO_PIECE when there is none.
uint next_piece(Pyramid pyramid, inout int node, int end) {
  while (node < end) {
    NodeRecord record = nodes[node];
    if (!may_reach(pyramid, record)) {
      node = int(record.link.x);
      continue;
    }
    ++node;
    if (record.link.y != NO_PIECE && reaches(pyramid, record.link.y)) return record.link.y;
  }
  return NO_PIECE;
}

// The nodes that triangles within a cone can reach: those from `node` up to `end`.
void narrow(vec3 axis, float cosine, float sine, out int node, out int end) {
  node = 0;
  end = node_count;
  for (;;) {
    // Goes down as long as only one child meets the cone.
    int found = -1;
    int child = node + 1;
    if (node >= end || nodes[node].link.y != NO_PIECE) return;
    for (; child < end; child = int(nodes[child].link.x)) {
      if (!cones_meet(axis, cosine, sine, nodes[child])) continue;
      if (found >= 0) return;
      found = child;
    }
    if (found < 0) {
      end = node;
      return;
    }
    node = found;
    end = int(nodes[found].link.x);
  }
}
