#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "engine/comparison/rank_materials.h"

namespace patina {

/// {"summary", "sentence", "materials": [{"material", "parameters", "log_evidence", "error" (null: Laplace's
/// approximation), "quarters" (log likelihood of each, foretold by the opposite one), "glance" (log
/// probability, beside the evidence), "probability", "misfit", "misfit_of_another_sample" (of the first
/// alone), "seconds", "match": parameter values by name}]}, the preferred first
nlohmann::ordered_json ranking_json(const MaterialRanking& ranking);

/// Writes it as ranking.json into the directory of the run whose material was chosen by it: beside run.json,
/// since it decided the material and nothing that the draws depend on. @throws UserError
void write_ranking(const std::filesystem::path& run_directory, const MaterialRanking& ranking);

}  // namespace patina
