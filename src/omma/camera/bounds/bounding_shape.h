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

// GLSL compilers inline every call: what is costly is called at one place in a loop.

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

// The plane's point of a direction; of one that is not seen the formula's where `formula` says so, else that of the
// border in its meridian.
LENS_FUNCTION vec2 bounded_project(Params params, LensBound bound, vec3 direction, bool formula) {
  vec2 plane;
  bool valid = LENS_PROJECT(params, direction, plane);
  if (formula || (valid && is_seen(bound, direction))) return plane;
  vec2 across = vec2(direction.x, direction.y);
  real rho = length(across);
  return rho > real(0.0) ? across * (bound.radius / rho) : vec2(bound.radius, real(0.0));
}

LENS_FUNCTION bool is_between(EdgeImage edge, vec3 direction) {
  return dot(cross(edge.from, direction), edge.normal) >= real(0.0) &&
         dot(cross(direction, edge.to), edge.normal) >= real(0.0);
}

LENS_FUNCTION EdgeImage edge_image(Params params, LensBound bound, vec3 from, vec3 to) {
  EdgeImage edge;
  edge.from = from;
  edge.to = to;
  // By the difference: of a short edge the cross product of its ends keeps no digit.
  vec3 normal = cross(from, to - from);
  real size = length(normal);
  vec3 n = size > real(0.0) ? normal / size : vec3(real(0.0));
  edge.normal = n;

  // The points of the whole circle that lie nearest to the axis and farthest from it.
  vec3 nearest = vec3(real(0.0), real(0.0), real(1.0)) - n * n.z;
  bool level = dot(nearest, nearest) < real(1e-10);  // the angle from the axis is the same everywhere
  bool passes_nearest = !level && is_between(edge, nearest);
  bool passes_farthest = !level && is_between(edge, -nearest);

  // The closed forms hold where nothing lies near what the formula sends to infinity.
  real least = bound.lines == LINES_STRAIGHT ? bound.cosine : real(-0.9);
  bool finite = from.z >= least * length(from) && to.z >= least * length(to);
  bool closed = bound.lines < LINES_CONVEX && finite && (bound.lines != LINES_CIRCLES || !passes_farthest);
  edge.lines = closed ? bound.lines : max(bound.lines, LINES_CONVEX);

  // Along an edge the angle from the axis falls up to the nearest point and grows from there.
  vec3 places[4];
  places[0] = from;
  places[1] = to;
  places[2] = passes_nearest ? nearest : from;
  places[3] = passes_farthest ? -nearest : to;
  vec2 images[4];
  for (int i = 0; i < 4; ++i) images[i] = bounded_project(params, bound, places[i], closed);
  edge.a = images[0];
  edge.b = images[1];
  real a_radius = length(edge.a), b_radius = length(edge.b);
  edge.low = passes_nearest ? length(images[2]) : min(a_radius, b_radius);
  edge.high = passes_farthest ? length(images[3]) : max(a_radius, b_radius);
  if (!(size > real(0.0))) edge.lines = LINES_STRAIGHT;

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

// Extents along seven directions: the axes both ways, and those that a triangle's sides face.
const int BOX_DIRECTIONS = 4;
const int ALL_DIRECTIONS = 7;
struct Extents {
  vec2 along[ALL_DIRECTIONS];
  real far[ALL_DIRECTIONS];
  int count;  // those that are wanted: the first four or all
};

LENS_FUNCTION Extents no_extents(int count) {
  Extents extents;
  extents.count = count;
  for (int k = 0; k < ALL_DIRECTIONS; ++k) {
    extents.along[k] = vec2(real(0.0));
    extents.far[k] = real(-1e30);
  }
  extents.along[0] = vec2(real(-1.0), real(0.0));
  extents.along[1] = vec2(real(0.0), real(-1.0));
  extents.along[2] = vec2(real(1.0), real(0.0));
  extents.along[3] = vec2(real(0.0), real(1.0));
  return extents;
}

LENS_FUNCTION Extents widened(Extents extents, EdgeImage edge) {
  for (int k = 0; k < extents.count; ++k) {
    extents.far[k] = max(extents.far[k], edge_support(edge, extents.along[k]));
  }
  return extents;
}

LENS_FUNCTION vec4 box_of(Extents extents) {
  return vec4(-extents.far[0], -extents.far[1], extents.far[2], extents.far[3]);
}

// Three lines parallel to the chords of a triangle (section 3.3), where they make one: not where it is so thin that
// roundings turn it round, nor where a tip lies so far out that rasterizers round it visibly.
LENS_FUNCTION BoundPart three_lines(LensBound bound, Extents extents, vec2 corner[3], real turn) {
  BoundPart part = no_part();
  for (int i = 0; i < 3; ++i) {
    int here = BOX_DIRECTIONS + i, before = BOX_DIRECTIONS + (i + 2) % 3;
    vec2 u = extents.along[before], v = extents.along[here];
    if (turn * (u.x * v.y - u.y * v.x) < real(1e-4)) return no_part();
    vec2 place = meeting_point(corner[i], u, extents.far[before] + bound.margin, v, extents.far[here] + bound.margin);
    if (max(abs(place.x), abs(place.y)) > real(16.0) * bound.radius) return no_part();
    part.corner[i] = place;
  }
  part.corners = 3;
  return part;
}

LENS_FUNCTION BoundPolygon polygon_of(vec3 a, vec3 b, vec3 c) {
  BoundPolygon polygon;
  polygon.at[0] = a;
  polygon.at[1] = b;
  polygon.at[2] = c;
  polygon.at[3] = c;
  polygon.count = 3;
  return polygon;
}

// The whole border's box: of a triangle that encloses the direction opposite to the axis all of the border may be seen.
LENS_FUNCTION BoundPart border_part(LensBound bound) {
  return box_part(box_within(bound, vec4(-bound.radius, -bound.radius, bound.radius, bound.radius)));
}

// Section 3.4: one quad, the union of the edges' boxes; no corners where nothing is seen. Corners relative to the
// lens's centre.
LENS_FUNCTION BoundPart bounding_quad(Params params, LensBound bound, vec3 a, vec3 b, vec3 c) {
  if (!bound.within_half && encloses_antipode(a, b, c)) return border_part(bound);
  BoundPolygon polygon = polygon_of(a, b, c);
  if (bound.within_half) polygon = clip_ahead(a, b, c);
  if (polygon.count < 3) return no_part();
  Extents extents = no_extents(BOX_DIRECTIONS);
  for (int i = 0; i < polygon.count; ++i) {
    EdgeImage edge = edge_image(params, bound, polygon.at[i], polygon.at[(i + 1) % polygon.count]);
    extents = widened(extents, edge);
  }
  return box_part(box_within(bound, box_of(extents)));
}

// Section 3.3: up to four triangles, which may overlap. A box instead, which is two, where that is smaller.
LENS_FUNCTION BoundParts bounding_triangles(Params params, LensBound bound, vec3 a, vec3 b, vec3 c) {
  BoundParts parts;
  parts.count = 0;
  if (!bound.within_half && encloses_antipode(a, b, c)) {
    parts.part[0] = border_part(bound);
    parts.count = 1;
    return parts;
  }
  BoundPolygon polygon = polygon_of(a, b, c);
  if (bound.within_half) polygon = clip_ahead(a, b, c);
  if (polygon.count < 3) return parts;

  // The triangles to enclose: the polygon's, then halves of those.
  BoundPolygon todo[6];
  todo[0] = polygon_of(polygon.at[0], polygon.at[1], polygon.at[2]);
  todo[1] = polygon_of(polygon.at[0], polygon.at[2], polygon.at[3]);
  int whole = polygon.count - 2, count = whole;
  vec4 box = vec4(real(1e30), real(1e30), real(-1e30), real(-1e30));
  real area = real(0.0);
  int triangles = 0;
  for (int t = 0; t < count; ++t) {
    vec3 corner[3];
    vec2 image[3];
    for (int i = 0; i < 3; ++i) corner[i] = todo[t].at[i];
    real turn = dot(cross(corner[0], corner[1] - corner[0]), corner[2]) < real(0.0) ? real(-1.0) : real(1.0);
    Extents extents = no_extents(ALL_DIRECTIONS);
    EdgeImage edge[3];
    for (int i = 0; i < todo[t].count; ++i) {
      edge[i] = edge_image(params, bound, corner[i], corner[(i + 1) % 3]);
      image[i] = edge[i].a;
      vec2 chord = edge[i].b - edge[i].a;
      extents.along[BOX_DIRECTIONS + i] =
          dot(chord, chord) > real(0.0) ? normalize(vec2(chord.y, -chord.x) * turn) : vec2(real(1.0), real(0.0));
    }
    for (int i = 0; i < todo[t].count; ++i) extents = widened(extents, edge[i]);
    vec4 own_box = box_of(extents);
    if (t < whole) box = box_union(box, own_box);

    vec2 ab = image[1] - image[0], ac = image[2] - image[0];
    bool turned_round = !(turn * (ab.x * ac.y - ab.y * ac.x) > real(0.0));
    if (turned_round && t < whole) {
      // An angle is larger than pi: split at its vertex, which lies opposite to the longest chord (section 3.3.3).
      int longest = 0;
      vec2 chord;
      real length2 = real(-1.0);
      for (int i = 0; i < 3; ++i) {
        chord = image[(i + 1) % 3] - image[i];
        if (dot(chord, chord) > length2) longest = i;
        length2 = max(length2, dot(chord, chord));
      }
      vec3 from = corner[longest], to = corner[(longest + 1) % 3], apex = corner[(longest + 2) % 3];
      vec3 middle = normalize(from) + normalize(to);
      todo[count++] = polygon_of(from, middle, apex);
      todo[count++] = polygon_of(middle, to, apex);
      continue;
    }
    BoundPart part = box_part(box_within(bound, own_box));
    BoundPart lines = three_lines(bound, extents, image, turn);
    if (!turned_round && lines.corners == 3 && part_area(lines) <= part_area(part)) part = lines;
    area += part_area(part);
    triangles += part.corners - 2;
    parts.part[parts.count++] = part;
  }
  BoundPart quad = box_part(box_within(bound, box));
  if (parts.count > 1 && (triangles > 4 || part_area(quad) <= area)) {
    parts.part[0] = quad;
    parts.count = 1;
  }
  return parts;
}
