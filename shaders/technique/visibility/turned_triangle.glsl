// A triangle as its rays see it: planes through the camera's centre and each edge, turned so that rays inside have no
// negative product, and the plane of inverse distance. As in src/omma/visibility/find_block-inl.h.
#include "technique/visibility/bodies.glsl"

layout(binding = 5) uniform samplerBuffer positions;
layout(binding = 9) uniform usamplerBuffer triangles;         // corners; of each mesh from its first texel on
layout(binding = 24) uniform usamplerBuffer triangle_texels;  // the numbers of each cluster's sixteen
layout(binding = 25) uniform usamplerBuffer part_texels;

// An instance within a body.
struct Part {
  float front;  // the sign that n . d has on the side that is seen; 0: both sides are
  uint alpha;   // as Material::Alpha counts
  float cutoff;
  uint first_triangle, first_texel;
  uint record;
};
const uint ALPHA_OPAQUE = 0u;
const int PART_TEXELS = 3;
const uint UNUSED = 0xffffffffu;
// A triangle whose plane passes this near to the centre, against what its edges and distance would allow, has no
// reliable plane: on which side the camera is, and how far the plane, is rounding.
const float EDGE_ON = 1e-5;

struct TurnedTriangle {
  vec3 edge[3], corner[3];
  vec3 inverse;   // this times the ray times the scale is 1/t
  bool unsure;    // seen edge-on: the distance comes from the corners
  bool two_sided; // and it may be seen from the other side
  float scale;
  uint id;
  uvec3 vertices;
  Part part;
};

Part part_of(uint number) {
  uvec4 first = texelFetch(part_texels, PART_TEXELS * int(number));
  uvec4 second = texelFetch(part_texels, PART_TEXELS * int(number) + 1);
  return Part(uintBitsToFloat(first.x), first.y, uintBitsToFloat(first.z), first.w, second.x, number);
}

float product(vec3 a, vec3 b) {
  precise float sum = a.x * b.x + a.y * b.y + a.z * b.z;
  return sum;
}

// `slot`: group, cluster of it, triangle of that. False where there is none, or its back is turned.
bool turned_triangle(uint slot, out TurnedTriangle t) {
  uvec2 placed = texelFetch(placed_group_texels, int(slot >> 8)).xy;
  uint cluster = group_of(placed.y).first + (slot >> 4 & 15u);
  uint number = texelFetch(triangle_texels, int(16u * cluster + (slot & 15u))).x;
  if (number == UNUSED) return false;
  Placement placement = placement_of(placed.x);
  t.part = part_of(placement.first_part + cluster_of(cluster).first);
  t.scale = placement.scale;
  t.id = t.part.first_triangle + number;
  t.vertices = texelFetch(triangles, int(t.part.first_texel + number)).xyz;
  for (int i = 0; i < 3; ++i) t.corner[i] = to_camera(placement, texelFetch(positions, int(t.vertices[i])).xyz);
  // Everything lies near 1, but for corners that are not finite.
  vec3 farthest = max(abs(t.corner[0]), max(abs(t.corner[1]), abs(t.corner[2])));
  if (!(farthest.x + farthest.y + farthest.z < 1e6)) return false;

  float square[3] = float[3](product(t.corner[0], t.corner[0]), product(t.corner[1], t.corner[1]),
                             product(t.corner[2], t.corner[2]));
  // From its nearest corner, whose products lose least.
  int base = square[2] < min(square[0], square[1]) ? 2 : square[0] < square[1] ? 0 : 1;
  vec3 nearest = t.corner[base];
  precise vec3 ab = t.corner[(base + 1) % 3] - nearest, ac = t.corner[(base + 2) % 3] - nearest;
  precise vec3 normal = cross(ab, ac);
  precise float volume = product(normal, nearest);
  // The squares of what rounding may make of the volume.
  precise float doubt = dot(ab, ab) * dot(ac, ac) * square[base] * (EDGE_ON * EDGE_ON);
  t.unsure = volume * volume <= doubt;
  t.two_sided = t.unsure && t.part.front == 0.0;
  if (normal == vec3(0.0)) return false;
  if (!t.unsure && volume * t.part.front < 0.0) return false;

  float side = (t.part.front == 0.0 ? volume : t.part.front) < 0.0 ? -1.0 : 1.0;
  for (int i = 0; i < 3; ++i) {
    // The product of both corners, without its loss of digits where they are close to each other, or one of them is far
    // away; the same to the bit, turned round, for the triangle on the other side.
    int from = (i + 1) % 3, to = (i + 2) % 3;
    vec3 p = t.corner[from], q = t.corner[to];
    precise vec3 near = square[from] < square[to] ? p : square[to] < square[from] ? q : 0.5 * (p + q), along = q - p;
    precise vec3 plane = vec3(near.y * along.z - near.z * along.y, near.z * along.x - near.x * along.z,
                              near.x * along.y - near.y * along.x);
    t.edge[i] = side * plane;
  }
  precise vec3 inverse = t.unsure ? vec3(0.0) : normal * (1.0 / volume);
  t.inverse = inverse;
  return true;
}

// False where no ray of the node meets it, or all of them see something nearer.
bool may_see(TurnedTriangle t, Node node) {
  if (!node.has_rays) return false;
  bool front = true, back = t.two_sided;
  for (int i = 0; i < 3; ++i) {
    float along = dot(t.edge[i], node.axis);
    float reach = sqrt(max(dot(t.edge[i], t.edge[i]), SMALLEST_SQUARE)) * (node.sine * (1.0 + SLACK) + 1e-6);
    front = front && along >= -reach;
    back = back && along <= reach;
  }
  if (!front && !back) return false;
  float nearest = length(t.inverse) * node.sine + abs(dot(t.inverse, node.axis));
  return t.unsure || nearest * t.scale * (1.0 + SLACK) >= node.farthest;
}

// The inverse distance; 0 where the ray passes by. `inside` becomes its products with the edges, as seen from the side
// that `turn` says: -1 for the other side.
float meet(TurnedTriangle t, vec3 ray, out vec3 inside, out float turn) {
  turn = 1.0;
  inside = vec3(product(t.edge[0], ray), product(t.edge[1], ray), product(t.edge[2], ray));
  bool front = all(greaterThanEqual(inside, vec3(0.0))), back = t.two_sided && all(lessThanEqual(inside, vec3(0.0)));
  if (!front && !back) return 0.0;
  if (!t.unsure) {
    precise float inverse = product(t.inverse, ray) * t.scale;
    return max(inverse, 0.0);
  }
  if (!front) {
    turn = -1.0;
    inside = -inside;
  }
  precise float distance = 0.0, doubt = 0.0;
  for (int i = 0; i < 3; ++i) {
    distance += inside[i] * product(t.corner[i], ray);
    float rounding = inside[i] * 1e-6 + product(abs(t.edge[i]), abs(ray)) * 3e-7;
    doubt += rounding * product(abs(t.corner[i]), abs(ray));
  }
  // A triangle around the centre, in a plane through it, is met nowhere else: there, terms cancel but for rounding.
  precise float inverse = (inside.x + inside.y + inside.z) * t.scale / distance;
  return distance > doubt ? inverse : 0.0;
}
