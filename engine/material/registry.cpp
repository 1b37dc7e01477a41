#include "engine/material/registry.h"

#include <utility>

#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/material/bump.h"
#include "engine/material/flake.h"
#include "engine/material/leather.h"
#include "engine/material/metal.h"
#include "engine/material/plaster.h"
#include "engine/material/prior_file.h"
#include "engine/material/translucent.h"
#include "engine/material/wood.h"

namespace patina {
namespace {

struct Entry {
  const char* name;
  Signature (*signature)();
  std::shared_ptr<const Material> (*make)(ParameterTable);
};

template <typename M>
Entry entry(const char* name) {
  return {name, &M::signature, [](ParameterTable table) -> std::shared_ptr<const Material> {
            return std::make_shared<M>(std::move(table));
          }};
}

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{entry<Bump>("bump"),
                                      entry<Leather>("leather"),
                                      entry<Plaster>("plaster"),
                                      entry<Flake>("flake"),
                                      entry<Metal>("metal"),
                                      entry<Wood>("wood"),
                                      entry<Translucent>("translucent")};
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
  return read_parameter_table(data_directory() / "materials" / (name + ".json"), entry.signature());
}

std::shared_ptr<const Material> make_material(const std::string& name) {
  return find(name).make(material_table(name));
}

}  // namespace patina
