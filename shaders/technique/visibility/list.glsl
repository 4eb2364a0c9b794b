// Lists that one program writes and the next one reads. Their counters go on counting where a list is full, so that one
// knows how long it should have been.
layout(std430, binding = 0) buffer CountBlock { uint counts[]; };
layout(std430, binding = 1) writeonly buffer ListBlock { uvec2 list[]; };
uniform uint list_counter;   // of the list that is written
uniform uint list_capacity;

void append_if(bool wanted, uvec2 entry) {
  // Not an `if`: software rasterizers go through its body even where nobody wants it.
  for (; wanted; wanted = false) {
    uint at = atomicAdd(counts[list_counter], 1u);
    if (at < list_capacity) list[at] = entry;
  }
}

layout(binding = 18) uniform usamplerBuffer task_texels;   // the list that is read
layout(binding = 19) uniform usamplerBuffer count_texels;  // all counters
uniform uint task_counter;
uniform uint task_capacity;

uint invocation() { return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x; }
uint task_count() { return min(texelFetch(count_texels, int(task_counter)).x, task_capacity); }
uvec2 task_at(uint number) { return texelFetch(task_texels, int(number)).xy; }
