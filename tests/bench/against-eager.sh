#!/usr/bin/env bash
# What a render and its gradient cost beside the last version of this repository that made them of tensor operations
# throughout (the commit before 96f7e25, which is built in a folder of its own): 512 pixels, the middle of the prior,
# every parameter's gradient, one thread, medians of interleaved runs.
#   tests/bench/against-eager.sh BIN [ROUNDS [FOLDER]]
# BIN is the folder of bench-render. With a FOLDER the old version is built there, and found there again.
set -euo pipefail
bin=$(realpath "$1") rounds=${2:-5}
here=$(realpath "$(dirname "$0")/../..") old=${3:-}
[[ -x $bin/bench-render ]] || { echo "There is no bench-render in $bin: build the preset bench first." >&2; exit 1; }
if [[ -z $old ]]; then
  old=$(mktemp -d)
  trap 'git -C "$here" worktree remove --force "$old"; rm -rf "$old"' EXIT
fi
[[ -f $old/CMakeLists.txt ]] || git -C "$here" worktree add --force --detach "$old" 96f7e25^ >&2

cat > "$old/tests/bench/eager_render.cpp" <<'CPP'
#include <ATen/Parallel.h>
#include <ATen/ops/rand.h>
#include <ATen/ops/tensor.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include "engine/material/material.h"
#include "engine/material/registry.h"
#include "engine/material/shading.h"

using namespace patina;

int main() {
  constexpr int kResolution = 512, kRepeats = 5;
  at::set_num_threads(1);
  const at::Tensor by_image = at::rand({3, kResolution, kResolution});
  for (const std::string& name : material_names()) {
    const auto material = make_material(name);
    const Irregularities z(2);
    const Capture capture;
    const ParameterValues values = prior_location(material->table());
    std::vector<double> times;
    for (int i = -1; i < kRepeats; ++i) {
      const auto begin = std::chrono::steady_clock::now();
      const at::Tensor parameters = at::tensor(values.continuous, at::kFloat).set_requires_grad(true);
      const Surface surface = material->surface(parameters, values.discrete, z, capture, kResolution);
      display(shade(surface, capture, kResolution), DisplayCurve::srgb).backward(by_image);
      const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
      if (i >= 0) times.push_back(took.count());
    }
    std::nth_element(times.begin(), times.begin() + kRepeats / 2, times.end());
    std::printf("%s %.2f\n", name.c_str(), times[kRepeats / 2]);
  }
}
CPP
grep -q eager-render "$old/engine/CMakeLists.txt" || cat >> "$old/engine/CMakeLists.txt" <<'CMAKE'
add_executable(eager-render ../tests/bench/eager_render.cpp)
target_link_libraries(eager-render PRIVATE patina_material ${TORCH_LIBRARIES} jemalloc)
CMAKE
(cd "$old" && cmake --preset release && ninja -C build/release eager-render) >&2

results=$(mktemp)
for ((i = 0; i < rounds; ++i)); do
  "$old/build/release/bin/eager-render" | sed 's/^/eager /'
  "$bin/bench-render" --repeats 5 | sed -n 's/^| \([a-z]\+\) | [^|]* | \([0-9.]*\) |.*/now \1 \2/p'
done > "$results"
/usr/bin/python3 - "$results" <<'PY'
import collections, statistics, sys
times = collections.defaultdict(lambda: collections.defaultdict(list))
for line in open(sys.argv[1]):
    version, material, ms = line.split()
    times[material][version].append(float(ms))
print("| | tensors, ms | now, ms | times |\n|---|---|---|---|")
for material, of in times.items():
    ratios = [a / b for a, b in zip(of["eager"], of["now"])]
    print(f"| {material} | {statistics.median(of['eager']):.0f} | {statistics.median(of['now']):.1f} "
          f"| {statistics.median(ratios):.1f} ({min(ratios):.1f} to {max(ratios):.1f}) |")
PY
rm -f "$results"
