#include "engine/comparison/ranking_json.h"

#include <nlohmann/json.hpp>

#include "engine/io/file.h"
#include "engine/io/params_json.h"
#include "engine/material/registry.h"

namespace patina {

using Json = nlohmann::ordered_json;

Json ranking_json(const MaterialRanking& ranking) {
  Json materials = Json::array();
  for (const RankedMaterial& m : ranking.materials)
    materials.push_back({{"material", m.material},
                         {"parameters", m.parameters},
                         {"log_evidence", m.log_evidence},
                         {"error", m.error ? Json(*m.error) : Json(nullptr)},
                         {"quarters", m.quarters},
                         {"glance", m.glance},
                         {"probability", m.probability},
                         {"misfit", m.misfit ? Json(*m.misfit) : Json(nullptr)},
                         {"misfit_of_another_sample",
                          m.misfit_of_another_sample ? Json(*m.misfit_of_another_sample) : Json(nullptr)},
                         {"seconds", m.seconds},
                         {"match", Json::parse(params_to_json(material_table(m.material), m.match))}});
  return {{"summary", ranking.summary}, {"sentence", ranking.sentence}, {"materials", materials}};
}

void write_ranking(const std::filesystem::path& run_directory, const MaterialRanking& ranking) {
  write_file_atomically(run_directory / "ranking.json", ranking_json(ranking).dump(2) + "\n");
}

}  // namespace patina
