#include "gui/window/explorer_library.h"

#include <dlfcn.h>

#include <chrono>
#include <filesystem>
#include <stdexcept>

namespace patina {
namespace {

Explore load() {
  const auto bin = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const std::filesystem::path file = bin.parent_path() / PATINA_EXPLORER_LIBRARY;
  // Every symbol now: what is missing must not end the program in the middle of something. Global, for the
  // engine looks up its BLAS by name (engine/run/openblas.cpp).
  void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
  void* const entry = library != nullptr ? ::dlsym(library, kExploreName) : nullptr;
  if (entry == nullptr)
    throw std::runtime_error(std::string("the explorer cannot be loaded, install Patina anew: ") +
                             ::dlerror());
  return reinterpret_cast<Explore>(entry);
}

}  // namespace

ExplorerLibrary::ExplorerLibrary() : loading_(std::async(std::launch::async, load)) {}

bool ExplorerLibrary::ready() const {
  return loading_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace patina
