// Reads PATINA_KERNEL once for each target of target.h, in whose instructions what it defines is built: as
// namespaces ...::baseline, ...::v3, ...::v4. To be included once by a file that defines PATINA_KERNEL, after
// all other headers, and followed by functions that call PATINA_ON_TARGET. (Attributes of a function,
// target_clones, are no way: what it inlines has been taken apart for the oldest processor before.)
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "engine/simd/target.h"

#define PATINA_TARGET baseline
#define PATINA_LANES 4
#include "engine/simd/lanes.h"
#include PATINA_KERNEL
#undef PATINA_LANES
#undef PATINA_TARGET

#if defined(__x86_64__)
#pragma GCC push_options
#pragma GCC target("arch=x86-64-v3")
#define PATINA_TARGET v3
#define PATINA_LANES 8
#include "engine/simd/lanes.h"
#include PATINA_KERNEL
#undef PATINA_LANES
#undef PATINA_TARGET
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("arch=x86-64-v4")
#define PATINA_TARGET v4
#define PATINA_LANES 16
#include "engine/simd/lanes.h"
#include PATINA_KERNEL
#undef PATINA_LANES
#undef PATINA_TARGET
#pragma GCC pop_options
#endif
