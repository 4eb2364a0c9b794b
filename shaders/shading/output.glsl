// What a fragment leaves behind: a shaded colour, or any of the other channels, each at the attachment that its symbol
// names. Matches output_defines in technique/target.cpp.
#include "shading/material.glsl"

#ifdef OUTPUT_COLOR
layout(location = OUTPUT_COLOR) out vec4 out_color;
#endif
#ifdef OUTPUT_DISTANCE
layout(location = OUTPUT_DISTANCE) out float out_distance;
#endif
#ifdef OUTPUT_Z
layout(location = OUTPUT_Z) out float out_z;
#endif
#ifdef OUTPUT_NORMAL
layout(location = OUTPUT_NORMAL) out vec4 out_normal;
#endif
#ifdef OUTPUT_POSITION
layout(location = OUTPUT_POSITION) out vec4 out_position;
#endif
#ifdef OUTPUT_UV
layout(location = OUTPUT_UV) out vec2 out_uv;
#endif
#ifdef OUTPUT_ID
layout(location = OUTPUT_ID) out int out_id;
#endif
#ifdef OUTPUT_OBJECT
layout(location = OUTPUT_OBJECT) out int out_object;
#endif
#ifdef OUTPUT_MATERIAL
layout(location = OUTPUT_MATERIAL) out int out_material;
#endif

void write_outputs(Surface surface) {
#ifdef OUTPUT_COLOR
  out_color = shade(surface);
#endif
#ifdef OUTPUT_DISTANCE
  out_distance = length(surface.position);
#endif
#ifdef OUTPUT_Z
  out_z = -surface.position.z;
#endif
#ifdef OUTPUT_NORMAL
  out_normal = vec4(mat3(frame.worldFromCamera) * surface.normal, 0.0);
#endif
#ifdef OUTPUT_POSITION
  out_position = frame.worldFromCamera * vec4(surface.position, 1.0);
#endif
#ifdef OUTPUT_UV
  out_uv = surface.uv;
#endif
#ifdef OUTPUT_ID
  out_id = surface.triangle;
#endif
#ifdef OUTPUT_OBJECT
  out_object = surface.object;
#endif
#ifdef OUTPUT_MATERIAL
  out_material = surface.material;
#endif
}
