// The picture from its cube faces: each pixel's ray finds its face and reads it.
#include "common/camera.glsl"

#include "common/frame.glsl"
#include "shading/footprint.glsl"

// Where a face's texels lie: scale * (s, t) + offset in shares of its layer, (s, t) the tangents in the face's frame.
uniform vec2 face_scale[6];
uniform vec2 face_offset[6];
uniform int face_layer[6];

// Faces in the order +X -X +Y -Y +Z -Z of the camera frame. Each is right, down, ahead (technique/image_based/cube.cpp).
uniform mat3 faceFromCamera[6];

int face_of(vec3 d) {
  vec3 size = abs(d);
  if (size.x >= size.y && size.x >= size.z) return d.x > 0.0 ? 0 : 1;
  if (size.y >= size.z) return d.y > 0.0 ? 2 : 3;
  return d.z > 0.0 ? 4 : 5;
}

vec3 on_face(int face, vec3 d) {
  vec3 p = faceFromCamera[face] * d;
  return vec3(p.xy / p.z * face_scale[face] + face_offset[face], float(face_layer[face]));
}

#ifdef OUTPUT_COLOR
layout(binding = 0) uniform sampler2DArray faces;
layout(location = 0) out vec4 color;

// Faces hold the scene alone, colour times coverage; what lies behind needs no resampling.
vec4 over_background(vec4 face, vec3 direction) {
  return vec4(face.rgb + (1.0 - face.a) * background(direction), 1.0);
}

#ifdef FILTER_ANISOTROPIC
// Change of the texture coordinate for a change of the ray, by the quotient rule.
vec2 change(int face, vec3 p, vec3 dd) {
  vec3 dp = faceFromCamera[face] * dd;
  return (dp.xy * p.z - p.xy * dp.z) / (p.z * p.z) * face_scale[face];
}

vec4 sample_faces(int face, PixelRay ray) {
  vec3 p = faceFromCamera[face] * ray.direction;
  vec2 dx = change(face, p, ray.dx), dy = change(face, p, ray.dy);
  vec3 at = on_face(face, ray.direction);
#ifdef FILTER_TAPS
  Footprint footprint = footprint_of(dx, dy, vec2(textureSize(faces, 0).xy));
  vec4 sum = vec4(0.0);
  for (float i = 0.5; i < footprint.taps; i += 1.0) {
    vec2 offset = footprint.axis * (i / footprint.taps - 0.5);
    sum += textureLod(faces, vec3(at.xy + offset, at.z), footprint.lod);
  }
  return sum / footprint.taps;
#else
  return textureGrad(faces, at, dx, dy);
#endif
}

void main() {
  PixelRay ray = camera_ray(gl_FragCoord.xy + pixel_offset);
  color = ray.valid ? over_background(sample_faces(face_of(ray.direction), ray), ray.direction) : vec4(0.0, 0.0, 0.0, 1.0);
}
#else
void main() {
  vec3 direction;
  bool valid = camera_unproject(gl_FragCoord.xy + pixel_offset, direction);
  color = valid ? over_background(textureLod(faces, on_face(face_of(direction), direction), 0.0), direction)
                : vec4(0.0, 0.0, 0.0, 1.0);
}
#endif

#else
// Labels and distances are never blended: the nearest texel. A triangle's id, an object's and a material's are whole
// numbers; each channel is copied in a pass of its own.
#ifdef INTEGER
layout(binding = 0) uniform isampler2DArray faces;
layout(location = 0) out ivec4 value;
uniform int integer_nothing;
#define NOTHING_VALUE ivec4(integer_nothing)
#else
layout(binding = 0) uniform sampler2DArray faces;
layout(location = 0) out vec4 value;
uniform vec4 nothing;
#define NOTHING_VALUE nothing
#endif

void main() {
  vec3 direction;
  bool valid = camera_unproject(gl_FragCoord.xy + pixel_offset, direction);
  vec3 at = on_face(face_of(direction), direction);
  ivec2 texel = ivec2(floor(at.xy * vec2(textureSize(faces, 0).xy)));
  value = valid ? texelFetch(faces, ivec3(texel, int(at.z)), 0) : NOTHING_VALUE;
}
#endif
