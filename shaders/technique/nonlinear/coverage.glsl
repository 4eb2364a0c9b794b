// Where in the image a triangle is drawn: as it is where the lens leaves it straight, in a polygon around it where the
// lens allows, else in the squares that it reaches: leaves of the tree, and whole nodes that lie within it.
#include "technique/nonlinear/image_tile.glsl"
#ifdef PROJECTS
#include "common/camera.glsl"
#include "technique/nonlinear/outline.glsl"
#endif
#include "technique/nonlinear/forms.glsl"

// FORMS is a bit for each form that is drawn now.
uint form_of(Pyramid pyramid) {
#ifdef PROJECTS
  Outline outline;
  if (outline_of(pyramid.corner[0], pyramid.corner[1], pyramid.corner[2], pyramid.axis, pyramid.sine, pyramid.cosine,
                 outline) &&
      outline.bulge < FARTHEST_BULGE) {
    bool straight = outline.bulge < STRAIGHT_BULGE && outline.slip < STRAIGHT_SLIP && outline.angle < STRAIGHT_ANGLE;
    // Where the image is turned round the rasterizer would take the one side for the other.
    vec3 volume = cross(pyramid.corner[1] - pyramid.corner[0], pyramid.corner[2] - pyramid.corner[0]);
    bool turned = dot(pyramid.corner[0], volume) * outline_area(outline) <= 0.0;
#ifndef ALL_EXACT
    if (straight && !turned) return FORM_STRAIGHT;
#endif
    return FORM_OUTLINED;
  }
#endif
  return FORM_SQUARES;
}

// True when all of the node's square sees the triangle.
bool lies_within(int number, Node node, Pyramid pyramid) {
  if (!is_whole(number)) return false;
  float within = node.sine + LEEWAY;
  return dot(pyramid.side[0], node.axis) > within && dot(pyramid.side[1], node.axis) > within &&
         dot(pyramid.side[2], node.axis) > within;
}

// False when a leaf's square is beyond one of the triangle's edges.
bool may_reach_square(int node, Node leaf, Pyramid pyramid) {
  LinearRays rays = linear_rays(node);
  if (rays.off < 0.0) return true;
  float side = float(square_of(leaf.data).z), reach = 0.5 * side + SQUARE_MARGIN + 0.5;
  for (int i = 0; i < 3; ++i) {
    vec3 plane = pyramid.side[i];
    if (dot(plane, rays.middle) + side_leeway(rays, plane, side, reach) < 0.0) return false;
  }
  return true;
}

// The next node to draw, or OUTLINE, from `node` on and before `end`; NO_PIECE when there is none.
uint next_piece(Pyramid pyramid, inout int node, int end) {
  bool drawn = (FORMS >> pyramid.form & 1) != 0;
  if (!drawn || pyramid.form != FORM_SQUARES) {
    bool reached = drawn && node < end && may_reach(pyramid, node_of(node));
    node = end;
    return reached ? OUTLINE : NO_PIECE;
  }
  while (node < end) {
    Node next = node_of(node);
    if (!may_reach(pyramid, next)) {
      node = next.skip;
      continue;
    }
    if (next.piece == NO_PIECE && !lies_within(node, next, pyramid)) {
      ++node;
      continue;
    }
    uint found = uint(node);
    node = next.skip;
    if (next.piece == NO_PIECE || may_reach_square(int(found), next, pyramid)) return found;
  }
  return NO_PIECE;
}
