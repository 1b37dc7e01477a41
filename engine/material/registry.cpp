#include "engine/material/registry.h"

#include <functional>
#include <utility>

#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/material/bump.h"
#include "engine/material/leather.h"
#include "engine/material/prior_file.h"

namespace patina {
namespace {

struct Entry {
  const char* name;
  std::size_t parameters, choices;  ///< what the code reads; the file must have as many
  std::function<std::shared_ptr<const Material>(ParameterTable)> make;
};

template <typename M>
std::shared_ptr<const Material> make(ParameterTable table) {
  return std::make_shared<M>(std::move(table));
}

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      {"bump", 8, 0, make<Bump>},
      {"leather", 13, 2, make<Leather>},
  };
  return all;
}

const Entry& find(const std::string& name) {
  std::string known;
  for (const Entry& entry : entries()) {
    if (name == entry.name) return entry;
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw UserError("There is no material '" + name + "': use one of " + known + ".");
}

}  // namespace

std::vector<std::string> material_names() {
  std::vector<std::string> names;
  for (const Entry& entry : entries()) names.emplace_back(entry.name);
  return names;
}

ParameterTable material_table(const std::string& name) {
  const Entry& entry = find(name);
  const auto file = data_directory() / "materials" / (name + ".json");
  ParameterTable table = read_parameter_table(file);
  if (table.continuous.size() != entry.parameters || table.discrete.size() != entry.choices)
    throw UserError("The material file " + file.string() + " does not have the parameters of " + name +
                    ": restore it.");
  return table;
}

std::shared_ptr<const Material> make_material(const std::string& name) {
  return find(name).make(material_table(name));
}

}  // namespace patina
