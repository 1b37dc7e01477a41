#pragma once

#include <string>
#include <vector>

namespace patina {

/// What a network's features and their Gram matrices are computed on. Renders, and summaries once they are
/// made, are in main memory in either case.
enum class Device { cpu, cuda };

/// "cpu", "cuda"
std::vector<std::string> device_names();

/// @throws UserError for another name
Device device_named(const std::string& name);

/// Whether the program can use it: for cuda, libtorch must have been built with CUDA, and find a card.
bool is_at_hand(Device device);

/// @throws UserError unless is_at_hand()
void check_at_hand(Device device);

}  // namespace patina
