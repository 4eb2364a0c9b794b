// Shapes that enclose a triangle's image in a lens with radial symmetry: Gascuel, Holzschuch, Fournier, Péroche 2008,
// Fast Non-Linear Projections using Graphics Hardware, sections 3.3, 3.4 and 4.
//
// Written like a lens file (models/language.h) for C++ and GLSL, and after the lens: LENS_PROJECT is its project. The
// optical frame (x right, y down, z forward) and the model's plane throughout. What encloses is measured by support:
// of a set of points, the largest extent along a direction. A shape whose sides lie at the support of all three curved
// edges encloses the triangle, whatever the edges do.

// What lines of space become in the plane.
const int LINES_STRAIGHT = 0;  // perspective
const int LINES_ELLIPSES = 1;  // cosine sphere, section 4.1
const int LINES_CIRCLES = 2;   // paraboloid, 4.2
const int LINES_CONVEX = 3;    // curves that bend around the axis, 4.3 to 4.6
const int LINES_ANY = 4;       // the radius grows with the angle, and that is all

struct LensBound {
  int lines;         // one of LINES_*
  real cosine;       // of the angle from the axis beyond which the image shows nothing
  real radius;       // of the plane's point there
  real margin;       // added to every side, plane units: for rounding, and pixels' samples
  bool within_half;  // the image shows nothing behind the plane z = 0
};

// An edge's image.
struct EdgeImage {
  vec3 from, to, normal;  // normal: of the plane through the centre, unit
  vec2 a, b;              // where the ends come to lie; on the circle of `radius` when they are not seen
  vec2 a_side, b_side;    // the ends' meridians, unit
  vec2 middle;            // the meridian between them, unit
  real cos_half;          // of half the angle between them
  real low, high;         // the edge's least and largest radius
  int lines;              // as what its support is measured
};

// A convex part of the plane.
struct BoundPart {
  vec2 corner[4];
  int corners;  // 3 or 4, in order around the part
};

struct BoundParts {
  BoundPart part[4];
  int count;  // together they have four triangles at most
};

struct BoundPolygon {
  vec3 at[4];
  int count;
};

// Section 3.3.2: what lies ahead of the plane z = 0, three or four corners, or nothing.
LENS_FUNCTION BoundPolygon clip_ahead(vec3 a, vec3 b, vec3 c) {
  vec3 corner[3];
  corner[0] = a;
  corner[1] = b;
  corner[2] = c;
  BoundPolygon polygon;
  polygon.count = 0;
  for (int i = 0; i < 3; ++i) {
    vec3 here = corner[i], next = corner[(i + 1) % 3];
    if (here.z >= real(0.0)) polygon.at[polygon.count++] = here;
    if ((here.z >= real(0.0)) != (next.z >= real(0.0))) {
      vec3 crossing = here + (next - here) * (here.z / (here.z - next.z));
      polygon.at[polygon.count++] = vec3(crossing.x, crossing.y, real(0.0));
    }
  }
  return polygon;
}

LENS_FUNCTION bool is_seen(LensBound bound, vec3 direction) { return direction.z >= bound.cosine * length(direction); }

// The plane's point of a direction; of one that is not seen, the point of the border in its meridian.
LENS_FUNCTION vec2 bounded_project(Params params, LensBound bound, vec3 direction) {
  vec2 plane;
  if (is_seen(bound, direction) && LENS_PROJECT(params, direction, plane)) return plane;
  vec2 across = vec2(direction.x, direction.y);
  real rho = length(across);
  return rho > real(0.0) ? across * (bound.radius / rho) : vec2(bound.radius, real(0.0));
}

LENS_FUNCTION bool is_between(EdgeImage edge, vec3 direction) {
  return dot(cross(edge.from, direction), edge.normal) >= real(0.0) &&
         dot(cross(direction, edge.to), edge.normal) >= real(0.0);
}

LENS_FUNCTION real bounded_radius(Params params, LensBound bound, vec3 direction) {
  return length(bounded_project(params, bound, direction));
}

LENS_FUNCTION EdgeImage edge_image(Params params, LensBound bound, vec3 from, vec3 to) {
  EdgeImage edge;
  edge.from = from;
  edge.to = to;
  // By the difference: of a short edge the cross product of its ends keeps no digit.
  vec3 normal = cross(from, to - from);
  real size = length(normal);
  edge.normal = size > real(0.0) ? normal / size : vec3(real(0.0));
  edge.a = bounded_project(params, bound, from);
  edge.b = bounded_project(params, bound, to);
  edge.lines = LINES_STRAIGHT;
  if (!(size > real(0.0))) return edge;

  // The closed forms hold where nothing lies near what the formula sends to infinity.
  real least = bound.lines == LINES_STRAIGHT ? bound.cosine : real(-0.9);
  bool finite = from.z >= least * length(from) && to.z >= least * length(to);
  vec3 n = edge.normal;
  // The points of the whole circle that lie nearest to the axis and farthest from it.
  vec3 nearest = vec3(real(0.0), real(0.0), real(1.0)) - n * n.z;
  bool level = dot(nearest, nearest) < real(1e-10);  // the angle from the axis is the same everywhere
  bool passes_farthest = !level && is_between(edge, -nearest);
  bool closed = bound.lines < LINES_CONVEX && finite && (bound.lines != LINES_CIRCLES || !passes_farthest);
  edge.lines = closed ? bound.lines : max(bound.lines, LINES_CONVEX);
  if (closed) {
    // Not the border's points, but the formula's: those that closed forms are of.
    LENS_PROJECT(params, from, edge.a);
    LENS_PROJECT(params, to, edge.b);
    return edge;
  }

  vec2 from_across = vec2(from.x, from.y), to_across = vec2(to.x, to.y);
  real from_rho = length(from_across), to_rho = length(to_across);
  vec2 right = vec2(real(1.0), real(0.0));
  edge.a_side = from_rho > real(0.0) ? from_across / from_rho : to_rho > real(0.0) ? to_across / to_rho : right;
  edge.b_side = to_rho > real(0.0) ? to_across / to_rho : edge.a_side;
  vec2 sum = edge.a_side + edge.b_side, difference = edge.b_side - edge.a_side;
  // Of meridians that are nearly opposite, the side on which the edge passes the axis.
  vec2 across = n.z >= real(0.0) ? vec2(difference.y, -difference.x) : vec2(-difference.y, difference.x);
  edge.middle = normalize(dot(edge.a_side, edge.b_side) > real(0.0) ? sum : across);
  edge.cos_half = dot(edge.middle, edge.a_side);

  // Along an edge the angle from the axis falls up to the nearest point and grows from there.
  real a_radius = length(edge.a), b_radius = length(edge.b);
  edge.high = passes_farthest ? bounded_radius(params, bound, -nearest) : max(a_radius, b_radius);
  edge.low = !level && is_between(edge, nearest) ? bounded_radius(params, bound, nearest) : min(a_radius, b_radius);
  return edge;
}

// The largest extent of the edge's image along a unit direction.
LENS_FUNCTION real edge_support(EdgeImage edge, vec2 along) {
  real ends = max(dot(edge.a, along), dot(edge.b, along));
  if (edge.lines == LINES_STRAIGHT) return ends;
  vec3 n = edge.normal;
  vec3 wanted = vec3(along.x, along.y, real(0.0));
  real across = n.x * along.y - n.y * along.x;
  if (edge.lines == LINES_ELLIPSES) {
    // The plane's point is the ray's x and y: its extent is largest where the circle's is, in space.
    vec3 top = cross(cross(n, wanted), n);
    return is_between(edge, top) ? max(ends, sqrt(n.z * n.z + across * across)) : ends;
  }
  if (edge.lines == LINES_CIRCLES) {
    // The circle touches the line at extent v where 2 dot(ray, wanted) = v (1 + z) has one solution.
    vec3 up = n.z < real(0.0) ? -n : n;
    if (up.z == real(0.0)) return ends;
    real tilt = up.x * along.x + up.y * along.y;
    // 1 + tilt, where it cancels by the other components.
    real rise = tilt < real(0.0) ? (across * across + up.z * up.z) / (real(1.0) - tilt) : real(1.0) + tilt;
    real extent = real(2.0) * rise / up.z;
    vec3 top = real(2.0) * (wanted + up) - vec3(real(0.0), real(0.0), extent);
    return is_between(edge, top) ? max(ends, extent) : ends;
  }
  // Within the arc of the largest radius (section 4.6), and on the outer side of the chord where lines bend around the
  // axis; elsewhere of the arc of the least radius.
  real a = dot(edge.a_side, along), b = dot(edge.b_side, along);
  real nearer = max(a, b);
  if (edge.lines == LINES_ANY) {
    // What passes the axis closely does so on either side.
    if (edge.cos_half < real(1e-4)) return edge.high;
    ends = max(ends, nearer * edge.low);
  }
  return max(ends, edge.high * (dot(edge.middle, along) >= edge.cos_half ? real(1.0) : nearer));
}

// Whether a triangle encloses the direction that is opposite to the axis, or passes it closely.
LENS_FUNCTION bool encloses_antipode(vec3 a, vec3 b, vec3 c) {
  const real close = real(1e-4);
  vec3 ab = cross(a, b - a), bc = cross(b, c - b), ca = cross(c, a - c);
  real volume = dot(ab, c);
  vec3 height = vec3(ab.z / max(length(ab), real(1e-30)), bc.z / max(length(bc), real(1e-30)),
                     ca.z / max(length(ca), real(1e-30)));
  bool thin = abs(volume) <= real(1e-6) * length(a) * length(b) * length(c);
  bool below = max(max(height.x, height.y), height.z) <= close;
  bool above = min(min(height.x, height.y), height.z) >= -close;
  return volume > real(0.0) ? below || (thin && above) : above || (thin && below);
}

LENS_FUNCTION BoundPart no_part() {
  BoundPart part;
  part.corners = 0;
  return part;
}

// min x, min y, max x, max y.
LENS_FUNCTION BoundPart box_part(vec4 box) {
  BoundPart part = no_part();
  part.corners = 4;
  part.corner[0] = vec2(box.x, box.y);
  part.corner[1] = vec2(box.z, box.y);
  part.corner[2] = vec2(box.z, box.w);
  part.corner[3] = vec2(box.x, box.w);
  return part;
}

LENS_FUNCTION real part_area(BoundPart part) {
  real twice = real(0.0);
  for (int i = 0; i < part.corners; ++i) {
    vec2 here = part.corner[i] - part.corner[0], next = part.corner[(i + 1) % part.corners] - part.corner[0];
    twice += here.x * next.y - here.y * next.x;
  }
  return real(0.5) * abs(twice);
}

LENS_FUNCTION vec4 edge_box(EdgeImage edge) {
  return vec4(-edge_support(edge, vec2(real(-1.0), real(0.0))), -edge_support(edge, vec2(real(0.0), real(-1.0))),
              edge_support(edge, vec2(real(1.0), real(0.0))), edge_support(edge, vec2(real(0.0), real(1.0))));
}

LENS_FUNCTION vec4 box_union(vec4 a, vec4 b) {
  return vec4(min(a.x, b.x), min(a.y, b.y), max(a.z, b.z), max(a.w, b.w));
}

// What can be seen of a box, with its margin.
LENS_FUNCTION vec4 box_within(LensBound bound, vec4 box) {
  return vec4(max(box.x, -bound.radius) - bound.margin, max(box.y, -bound.radius) - bound.margin,
              min(box.z, bound.radius) + bound.margin, min(box.w, bound.radius) + bound.margin);
}

// Where two lines meet that lie at these extents along two unit directions. `origin`: a point nearby, that extents are
// taken from: of lines that are nearly parallel they would otherwise cancel.
LENS_FUNCTION vec2 meeting_point(vec2 origin, vec2 u, real u_extent, vec2 v, real v_extent) {
  real u_beyond = u_extent - dot(u, origin), v_beyond = v_extent - dot(v, origin);
  return origin + vec2(u_beyond * v.y - v_beyond * u.y, v_beyond * u.x - u_beyond * v.x) / (u.x * v.y - u.y * v.x);
}

// Three lines parallel to the chords (section 3.3). No part where the chords' triangle is turned round, which is where
// the curved one has an angle larger than pi.
LENS_FUNCTION BoundPart three_lines(LensBound bound, EdgeImage edge[3], real turn) {
  BoundPart part = no_part();
  vec2 outward[3];
  real extent[3];
  vec2 ab = edge[0].b - edge[0].a, ac = edge[2].a - edge[0].a;
  if (!(turn * (ab.x * ac.y - ab.y * ac.x) > real(0.0))) return part;
  for (int i = 0; i < 3; ++i) {
    vec2 chord = edge[i].b - edge[i].a;
    outward[i] = normalize(vec2(chord.y, -chord.x) * turn);
    extent[i] = bound.margin + max(max(edge_support(edge[0], outward[i]), edge_support(edge[1], outward[i])),
                                   edge_support(edge[2], outward[i]));
  }
  part.corners = 3;
  for (int i = 0; i < 3; ++i) {
    int before = (i + 2) % 3;
    vec2 u = outward[before], v = outward[i];
    if (turn * (u.x * v.y - u.y * v.x) < real(1e-4)) return no_part();  // so thin that roundings turn it round
    part.corner[i] = meeting_point(edge[i].a, u, extent[before], v, extent[i]);
    vec2 place = part.corner[i];
    // A tip so far out that rasterizers round it visibly.
    if (max(abs(place.x), abs(place.y)) > real(16.0) * bound.radius) return no_part();
  }
  return part;
}

// The chord's square length.
LENS_FUNCTION real chord2(EdgeImage edge) { return dot(edge.b - edge.a, edge.b - edge.a); }

// A triangle that is clipped already as one triangle or two, or as a box where that is smaller. `side`: a plane that
// all parts have.
LENS_FUNCTION BoundParts enclose_clipped(Params params, LensBound bound, vec3 a, vec3 b, vec3 c) {
  EdgeImage edge[3];
  edge[0] = edge_image(params, bound, a, b);
  edge[1] = edge_image(params, bound, b, c);
  edge[2] = edge_image(params, bound, c, a);
  real turn = dot(cross(a, b - a), c) < real(0.0) ? real(-1.0) : real(1.0);
  vec4 box = box_union(box_union(edge_box(edge[0]), edge_box(edge[1])), edge_box(edge[2]));
  BoundParts parts;
  parts.count = 1;
  parts.part[0] = box_part(box_within(bound, box));
  real area = part_area(parts.part[0]);
  BoundPart whole = three_lines(bound, edge, turn);
  if (whole.corners == 3) {
    if (part_area(whole) <= area) parts.part[0] = whole;
  } else {
    // Split at the vertex that lies opposite to the longest chord: the one with the large angle (section 3.3.3).
    int longest = 0;
    if (chord2(edge[1]) > chord2(edge[longest])) longest = 1;
    if (chord2(edge[2]) > chord2(edge[longest])) longest = 2;
    vec3 from = edge[longest].from, to = edge[longest].to, apex = edge[(longest + 1) % 3].to;
    vec3 middle = normalize(from) + normalize(to);
    EdgeImage cut = edge_image(params, bound, middle, apex);
    EdgeImage back = edge_image(params, bound, apex, middle);
    EdgeImage first[3];
    first[0] = edge_image(params, bound, from, middle);
    first[1] = cut;
    first[2] = edge[(longest + 2) % 3];
    EdgeImage second[3];
    second[0] = edge_image(params, bound, middle, to);
    second[1] = edge[(longest + 1) % 3];
    second[2] = back;
    BoundPart one = three_lines(bound, first, turn), other = three_lines(bound, second, turn);
    if (one.corners == 3 && other.corners == 3 && part_area(one) + part_area(other) <= area) {
      parts.part[0] = one;
      parts.part[1] = other;
      parts.count = 2;
    }
  }
  return parts;
}

// The whole border's box: of a triangle that encloses the direction opposite to the axis all of the border may be seen.
LENS_FUNCTION BoundPart border_part(LensBound bound) {
  return box_part(box_within(bound, vec4(-bound.radius, -bound.radius, bound.radius, bound.radius)));
}

// Section 3.4: one quad, the union of the edges' boxes; no corners where nothing is seen. Corners relative to the
// lens's centre.
LENS_FUNCTION BoundPart bounding_quad(Params params, LensBound bound, vec3 a, vec3 b, vec3 c) {
  BoundPolygon polygon;
  polygon.at[0] = a;
  polygon.at[1] = b;
  polygon.at[2] = c;
  polygon.count = 3;
  if (bound.within_half) {
    polygon = clip_ahead(a, b, c);
    if (polygon.count < 3) return no_part();
  } else if (encloses_antipode(a, b, c)) {
    return border_part(bound);
  }
  vec4 box = edge_box(edge_image(params, bound, polygon.at[polygon.count - 1], polygon.at[0]));
  for (int i = 1; i < polygon.count; ++i) {
    box = box_union(box, edge_box(edge_image(params, bound, polygon.at[i - 1], polygon.at[i])));
  }
  return box_part(box_within(bound, box));
}

// Section 3.3: up to four triangles, which may overlap.
LENS_FUNCTION BoundParts bounding_triangles(Params params, LensBound bound, vec3 a, vec3 b, vec3 c) {
  BoundParts parts;
  BoundPolygon polygon;
  polygon.count = 3;
  if (bound.within_half) {
    polygon = clip_ahead(a, b, c);
  } else if (encloses_antipode(a, b, c)) {
    parts.part[0] = border_part(bound);
    parts.count = 1;
    return parts;
  } else {
    polygon.at[0] = a;
    polygon.at[1] = b;
    polygon.at[2] = c;
  }
  parts.count = 0;
  if (polygon.count < 3) return parts;
  parts = enclose_clipped(params, bound, polygon.at[0], polygon.at[1], polygon.at[2]);
  if (polygon.count == 3) return parts;
  BoundParts others = enclose_clipped(params, bound, polygon.at[0], polygon.at[2], polygon.at[3]);
  for (int i = 0; i < others.count; ++i) parts.part[parts.count++] = others.part[i];
  real area = real(0.0);
  for (int i = 0; i < parts.count; ++i) area += part_area(parts.part[i]);
  BoundPart quad = bounding_quad(params, bound, a, b, c);
  if (part_area(quad) <= area) {
    parts.part[0] = quad;
    parts.count = 1;
  }
  return parts;
}
