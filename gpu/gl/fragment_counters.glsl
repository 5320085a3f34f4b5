// Three counters of fragments (gpu/gl/fragment_counters.h): each of these adds one, where LKAO_COUNT is 1.
#if LKAO_COUNT
// Of each number the low and the high 32 bits: a frame may well have more than 2^32 fragments.
layout(binding = 0, offset = 0) uniform atomic_uint low_count_0;
layout(binding = 0, offset = 4) uniform atomic_uint high_count_0;
layout(binding = 0, offset = 8) uniform atomic_uint low_count_1;
layout(binding = 0, offset = 12) uniform atomic_uint high_count_1;
layout(binding = 0, offset = 16) uniform atomic_uint low_count_2;
layout(binding = 0, offset = 20) uniform atomic_uint high_count_2;
#define COUNT(low, high) \
  if (atomicCounterIncrement(low) == 0xffffffffu) atomicCounterIncrement(high)
#define COUNT_0 COUNT(low_count_0, high_count_0)
#define COUNT_1 COUNT(low_count_1, high_count_1)
#define COUNT_2 COUNT(low_count_2, high_count_2)
#else
#define COUNT_0
#define COUNT_1
#define COUNT_2
#endif
