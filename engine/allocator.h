#pragma once

/// How jemalloc keeps memory. Included once by a program, in the file of its main(), for it defines what
/// jemalloc reads at start (`malloc_conf`, jemalloc(3)). Renders and networks give back large buffers all the
/// time: without decay they are kept, in huge pages, and the next one costs no page faults, which are dearer
/// than the arithmetic on it. Buffers kept side by side become one, and by default one that is more than 64
/// times as large as a request is left alone and new memory taken, without end:
/// lg_extent_max_active_fit:64 has it split.
extern "C" {
const char* malloc_conf = "dirty_decay_ms:-1,muzzy_decay_ms:-1,lg_extent_max_active_fit:64,thp:always";
}
