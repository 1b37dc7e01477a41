#pragma once

namespace patina {

/// Sets OpenBLAS up for many threads that each do their own algebra: one thread a call (its pool is behind
/// one lock, for which chains would queue), in the instructions that the processor has. A processor that is
/// newer than the library (0.3.21 of Debian 12 is of 2022) it takes for one of 2004, "Prescott", whose
/// products of matrices are several times as slow; what OPENBLAS_CORETYPE names stays. Nothing where another
/// BLAS is in use. Before any thread calls BLAS.
void prepare_openblas();

}  // namespace patina
