#include "gui/priority.h"

#include <sys/resource.h>
#include <unistd.h>

namespace patina {
namespace {

// A step changes a thread's share of a contended core by a quarter (sched(7)); a lowered priority cannot be
// raised again.
void lower_to(int nice) { ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), nice); }

}  // namespace

void yield_to_frames() { lower_to(5); }
void yield_to_all() { lower_to(15); }

}  // namespace patina
