#pragma once

namespace patina {

/// Sets how many threads one tensor operation started from the calling thread may use. OpenMP keeps that
/// number per thread, so that each thread that renders calls this once, first; the first of all prepares BLAS
/// (prepare_openblas()).
void use_tensor_threads(int count);

/// The machine's hardware threads, at least 1.
int hardware_threads();

}  // namespace patina
