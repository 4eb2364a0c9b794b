// How straight a triangle's edges are in the image of a lens, and a polygon around it. Matches
// technique/nonlinear/lens_curvature.cpp.

// Bend, change and speed of each cell: level after level, face after face, in rows.
layout(binding = 22) uniform samplerBuffer curvature_texels;
const int CELLS_A_SIDE = 24;
const int LEVELS = 5;
const float FIRST_REACH = 1.0 / 48.0;  // radians; of each next level twice as far

const float FARTHEST_BULGE = 0.5;  // px; what bulges more is drawn in squares of the image

uniform float formula_max_angle;  // radians: triangles at the edge of the field of view have corners beyond it

bool formula_project(vec3 direction, out vec2 pixel) {
  return camera_project_within(formula_max_angle, direction, pixel);
}

// A triangle's corners in the image, and how far its edges may lie from straight ones, px.
struct Outline {
  vec2 corner[3];  // px
  float bulge;     // across the edge
  float slip;      // along it
  float angle;     // radians, of the longest edge
};

// Of what is within an angle (by its cosine and sine) of a direction. False where the lens is not smooth there.
bool curvature_around(vec3 direction, float sine, float cosine, out vec3 curvature) {
  curvature = vec3(0.0);
  int level = 0;
  float angle = atan(sine, cosine);
  while (angle > FIRST_REACH * float(1 << level)) {
    if (++level == LEVELS) return false;
  }
  vec3 size = abs(direction);
  int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  vec3 turned = axis == 0 ? direction.xyz : axis == 1 ? direction.yzx : direction.zxy;
  int face = 2 * axis + int(turned.x < 0.0);
  ivec2 at = clamp(ivec2(floor((turned.yz / abs(turned.x) + 1.0) * (0.5 * float(CELLS_A_SIDE)))), ivec2(0),
                   ivec2(CELLS_A_SIDE - 1));
  curvature = texelFetch(curvature_texels, ((level * 6 + face) * CELLS_A_SIDE + at.y) * CELLS_A_SIDE + at.x).xyz;
  return !isinf(curvature.y);
}

// False where a triangle's image may not be what its three corners and bulging edges enclose.
bool outline_of(vec3 a, vec3 b, vec3 c, vec3 axis, float sine, float cosine, out Outline outline) {
  vec3 curvature;
  if (!curvature_around(axis, sine, cosine, curvature)) return false;
  vec3 ua = normalize(a), ub = normalize(b), uc = normalize(c);
  float chord = max(distance(ua, ub), max(distance(ub, uc), distance(uc, ua)));
  outline.angle = 2.0 * asin(min(1.0, 0.5 * chord));
  float turn = curvature.x * outline.angle / curvature.z;  // of the edge in the image, radians
  // An edge that turns farther might leave its chord beyond the chord's ends.
  if (!(turn < 0.5)) return false;
  outline.slip = curvature.y * outline.angle * outline.angle / 8.0;
  outline.bulge = min(1.0, turn) * outline.slip + curvature.x * outline.angle * outline.angle / 8.0;
  if (!formula_project(ua, outline.corner[0]) || !formula_project(ub, outline.corner[1]) ||
      !formula_project(uc, outline.corner[2])) {
    return false;
  }
  // Of edges without a direction no side is the outer one.
  const float least = 1e-3;
  return distance(outline.corner[0], outline.corner[1]) > least && distance(outline.corner[1], outline.corner[2]) > least &&
         distance(outline.corner[2], outline.corner[0]) > least;
}

float outline_area(Outline outline) {
  vec2 ab = outline.corner[1] - outline.corner[0], ac = outline.corner[2] - outline.corner[0];
  return ab.x * ac.y - ab.y * ac.x;
}

// A corner of the hexagon around the triangle and all within `margin` of its edges: of each of the triangle's corners
// two, where its sides, moved outwards, are cut off.
vec2 hexagon_corner(Outline outline, float margin, int number) {
  int i = number >> 1;
  vec2 at = outline.corner[i], before = outline.corner[(i + 2) % 3], after = outline.corner[(i + 1) % 3];
  vec2 in_way = at - before, out_way = after - at;
  float side = outline_area(outline) < 0.0 ? -1.0 : 1.0;
  float in_length = length(in_way), out_length = length(out_way);
  in_way = in_length > 1e-6 ? in_way / in_length : vec2(0.0);
  out_way = out_length > 1e-6 ? out_way / out_length : vec2(0.0);
  // The tip points away from both neighbours; the cut lies across it, `margin` beyond the corner.
  vec2 tip = in_way - out_way;
  float tip_length = length(tip);
  vec2 way = (number & 1) == 0 ? in_way : out_way;
  vec2 outwards = side * vec2(way.y, -way.x);
  if (tip_length < 1e-3) return at + margin * outwards;
  tip /= tip_length;
  // Along the moved side, out to where the cut meets it: dot(margin * outwards + t * way, tip) = margin.
  float along = dot(way, tip);
  return at + margin * (outwards + way * ((1.0 - dot(outwards, tip)) / along));
}
