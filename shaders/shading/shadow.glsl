// How much of a light reaches a surface: maps of what the light sees, compared with where the surface's own plane lies
// on the ray of each texel. A plane then never shadows itself, however steeply the light falls, and what remains to be
// allowed for is how far the map's edges and depths are off: a part of a texel, along the normal. Matches MapRecord in
// technique/gpu_scene.cpp and shading/shadow_layers.h.

const float LEVEL_BIAS = 0.05, STEEP_BIAS = 0.5;  // texels: where light falls straight, where it grazes

layout(binding = 26) uniform sampler2DArray shadow_maps;  // near depth / distance; flat maps: / distance ahead

struct ShadowMap {
  vec4 right, down, ahead;  // rows of mapFromCamera
  float focal, centre;      // texels
  bool flat_map;            // perspective, or the paraboloid's stereographic
  float near;               // metres
};

vec4 map_texel(int number, int part) {
  return texelFetch(light_texels, 4 * (int(frame.counts.x) + number) + part);
}

// The map of a light that looks at a place the straightest.
int map_towards(LightRecord light, vec3 position) {
  int first = int(light.cone.z), last = first + int(light.cone.w) - 1;
  int nearest = first;
  float farthest_ahead = -1e30;
  for (int i = first; i <= last; ++i) {
    float ahead = dot(map_texel(i, 2), vec4(position, 1.0));
    if (ahead > farthest_ahead) {
      farthest_ahead = ahead;
      nearest = i;
    }
  }
  return nearest;
}

ShadowMap shadow_map(int number) {
  vec4 lens = map_texel(number, 3);
  return ShadowMap(map_texel(number, 0), map_texel(number, 1), map_texel(number, 2), lens.x, lens.y, lens.z != 0.0,
                   lens.w);
}

vec3 to_map(ShadowMap map, vec4 v) {
  return vec3(dot(map.right, v), dot(map.down, v), dot(map.ahead, v));
}

// What a texel's distance is a multiple of.
vec3 ray_of_texel(ShadowMap map, vec2 texel) {
  vec2 at = (texel + 0.5 - map.centre) / map.focal;
  float quarter = 0.25 * dot(at, at);
  return map.flat_map ? vec3(at, 1.0) : vec3(at, 1.0 - quarter) / (1.0 + quarter);
}

// Share of the light that reaches the surface: a quadratic B-spline over 3 x 3 texels.
float light_reaching(LightRecord light, Surface surface) {
  if (light.cone.w == 0.0) return 1.0;
  int number = map_towards(light, surface.position);
  ShadowMap map = shadow_map(number);
  vec3 place = to_map(map, vec4(surface.position, 1.0));
  vec3 plane = normalize(to_map(map, vec4(surface.plane, 0.0)));
  float height = dot(plane, place);
  if (height < 0.0) {
    plane = -plane;
    height = -height;
  }
  float far = length(place);
  // A texel's side there, across the light, in metres; and the distance as the map counts it.
  float scale = map.flat_map ? place.z : 0.5 * (far + place.z);
  float texel = scale / map.focal;
  float distance = map.flat_map ? place.z : far;
  float steepness = length(cross(plane, place)) / far;
  height -= texel * (LEVEL_BIAS + STEEP_BIAS * steepness);

  vec2 at = map.centre + map.focal * place.xy / scale;
  vec2 size = vec2(textureSize(shadow_maps, 0).xy);
  // Beyond a sun's map nothing casts shadows, beyond a spot's there is no light.
  if (any(lessThan(at, vec2(0.0))) || any(greaterThan(at, size))) return 1.0;
  vec2 middle = floor(at), part = at - middle - 0.5;
  vec2 weight[3] = vec2[3](0.5 * (0.5 - part) * (0.5 - part), 0.75 - part * part, 0.5 * (0.5 + part) * (0.5 + part));
  float reached = 0.0;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      vec2 neighbour = middle + vec2(i - 1, j - 1);
      float along = dot(plane, ray_of_texel(map, neighbour));
      // Where the ray hardly meets the plane, or never does, the surface has long ended.
      float reach = min(height / max(along, 1e-6), 2.0 * distance);
      float stored = texelFetch(shadow_maps, ivec3(clamp(ivec2(neighbour), ivec2(0), ivec2(size) - 1), number), 0).r;
      if (stored * reach <= map.near) reached += weight[i].x * weight[j].y;
    }
  }
  return reached;
}
