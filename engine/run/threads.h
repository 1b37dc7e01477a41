#pragma once

namespace patina {

/// Sets how many threads one tensor operation started from the calling thread may use. OpenMP keeps that
/// number per thread, so that each thread that renders calls this once, first.
void use_tensor_threads(int count);

/// The machine's hardware threads, at least 1.
int hardware_threads();

/// Lowers the calling thread's scheduling priority a little (nice +5), and with it that of threads it starts
/// later, so that a window stays smooth while chains take all cores.
void yield_to_the_window();

}  // namespace patina
