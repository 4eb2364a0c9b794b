// What the vertex stage of a splitting pass hands to its geometry stage: a triangle as one point.
#include "technique/subdivision/record.glsl"

#define CANDIDATE Candidate { \
  flat uvec4 texel[RECORD_TEXELS]; \
  flat uint faces; /* 0: it turns away */ \
  flat uvec3 corners; /* vertices of a triangle that nothing has split yet */ \
}
