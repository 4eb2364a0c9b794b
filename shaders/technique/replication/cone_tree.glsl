// Triangles against a tree of cones over the image: what lies in none of a node's rays lies in none of its children's.
#include "technique/replication/scene_triangle.glsl"

struct Node {
  vec3 axis;
  float sine, cosine;  // of the half angle; the sine is 2 where that is a right angle or more
  int skip;            // the node after this one's descendants
  uint piece;          // or NO_PIECE
  uint data;           // what the tree has to say of it
};

const uint NO_PIECE = 0xffffffffu;

// In the order of a walk that visits a node before its children, which come one after another.
layout(binding = 18) uniform usamplerBuffer node_texels;

uniform int node_count;

Node node_of(int number) {
  vec4 cone = uintBitsToFloat(texelFetch(node_texels, 2 * number));
  uvec4 link = texelFetch(node_texels, 2 * number + 1);
  return Node(cone.xyz, cone.w, uintBitsToFloat(link.z), int(link.x), link.y, link.w);
}

// A triangle as a pyramid from the camera's centre, and the cone around it.
struct Pyramid {
  vec3 corner[3];
  vec3 side[3];  // unit, pointing inwards
  vec3 axis;
  float cosine, sine;
#ifdef TRIANGLE_FORMS
  uint form;  // what COVERAGE's form_of makes of it
#endif
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
bool cones_meet(vec3 axis, float cosine, float sine, Node node) {
  return node.sine > 1.0 || cosine <= 0.0 || dot(axis, node.axis) > cosine * node.cosine - sine * node.sine - LEEWAY;
}

bool may_reach(Pyramid pyramid, Node node) {
  float beyond = -node.sine - LEEWAY;
  return dot(pyramid.side[0], node.axis) > beyond && dot(pyramid.side[1], node.axis) > beyond &&
         dot(pyramid.side[2], node.axis) > beyond &&
         cones_meet(pyramid.axis, pyramid.cosine, pyramid.sine, node);
}

// The nodes that triangles within a cone can reach: those from `node` up to `end`.
void narrow(vec3 axis, float cosine, float sine, out int node, out int end) {
  node = 0;
  end = node_count;
  // Goes down as long as only one child meets the cone.
  while (node < end && node_of(node).piece == NO_PIECE) {
    int found = -1, found_end = 0;
    for (int child = node + 1; child < end;) {
      Node next = node_of(child);
      if (cones_meet(axis, cosine, sine, next)) {
        if (found >= 0) return;
        found = child;
        found_end = next.skip;
      }
      child = next.skip;
    }
    node = max(found, 0);
    end = found_end;
  }
}
