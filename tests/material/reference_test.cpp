#include <ATen/TensorOperators.h>
#include <ATen/ops/from_blob.h>
#include <ATen/ops/linspace.h>
#include <ATen/ops/stack.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/io/image_file.h"
#include "materials_fixture.h"

namespace patina {
namespace {

const std::filesystem::path kRenders = std::filesystem::path(PATINA_SHARED_DIR) / "reference/renders";

struct Reference {
  std::string name, material;
  std::map<std::string, double> parameters;
};

std::vector<Reference> references() {
  std::vector<Reference> all;
  std::ifstream file(kRenders / "renders.json");
  if (!file) return all;
  for (const auto& entry : nlohmann::json::parse(file)) {
    Reference reference{entry["file"], entry["material"], entry["parameters"]};
    if (std::ranges::count(material_names(), reference.material) == 1) all.push_back(std::move(reference));
  }
  return all;
}

at::Tensor image_of(const Reference& reference) {
  Image image = read_image(kRenders / reference.name);
  return at::from_blob(image.pixels.data(), {image.height, image.width, image.channels})
      .permute({2, 0, 1})
      .clone();
}

/// The forward model at the reference's parameters, those in `changed` multiplied.
at::Tensor render_like(const Reference& reference, int choice,
                       const std::map<std::string, double>& changed = {}) {
  const auto material = make_material(reference.material);
  ParameterValues values = prior_location(material->table());
  for (const auto& [name, value] : reference.parameters) {
    const auto factor = changed.find(name);
    values.continuous.at(material->table().find_continuous(name).value()) =
        value * (factor == changed.end() ? 1 : factor->second);
  }
  // Each choice is another z: another seed, or another map where the material has a choice of maps.
  const bool has_maps = !values.discrete.empty();
  for (int& level : values.discrete) level = choice;
  static const std::array<Irregularities, 3> others{Irregularities(1), Irregularities(2), Irregularities(3)};
  const Irregularities& z = has_maps ? shared_irregularities() : others[static_cast<std::size_t>(choice)];
  const at::Tensor image = render(*material, tensor_of(values.continuous, at::kFloat), values.discrete, 512,
                                  DisplayCurve::gamma22, z);
  return (image * 255).round() / 255;  // as the reference was stored;
}

/// Mean colour of 8 concentric rings, [8, 3], in 8-bit levels.
at::Tensor ring_means(const at::Tensor& image) {
  const std::int64_t n = image.size(1);
  const at::Tensor v = (at::linspace(0, static_cast<double>(n - 1), n) + 0.5) / n - 0.5;
  const at::Tensor ring = ((v.view({n, 1}).square() + v.square()).sqrt() * 16).to(at::kInt).clamp_max(7);
  std::vector<at::Tensor> means;
  for (int i = 0; i < 8; ++i) {
    const at::Tensor inside = (ring == i).to(at::kFloat);
    means.push_back((image * inside).sum({1, 2}) * 255 / inside.sum());
  }
  return at::stack(means);
}

/// Log energy of the detail that each halving of the luminance takes away, finest first, [4]. Detail of a
/// single pixel is left out: the smoothest leather has half as much of it as its reference.
at::Tensor log_detail(const at::Tensor& image) {
  at::Tensor level = image.mean(0);
  std::vector<at::Tensor> energies;
  for (int i = 0; i < 5; ++i) {
    const std::int64_t n = level.size(0) / 2;
    const at::Tensor half = level.view({n, 2, n, 2}).mean({1, 3});
    if (i > 0) energies.push_back((level.square().mean() - half.square().mean()).log());
    level = half;
  }
  return at::stack(energies);
}

/// How far `statistic` of the reference lies from that of renders with three z: the largest distance to their
/// mean, in units of the statistic, beyond twice their own spread.
double excess(at::Tensor (*statistic)(const at::Tensor&), const Reference& reference,
              const std::map<std::string, double>& changed = {}) {
  std::vector<at::Tensor> ours;
  for (int choice = 0; choice < 3; ++choice)
    ours.push_back(statistic(render_like(reference, choice, changed)));
  const at::Tensor mean = at::stack(ours).mean(0);
  const at::Tensor spread = std::get<0>((at::stack(ours) - mean).abs().max(0));
  return ((statistic(image_of(reference)) - mean).abs() - 2 * spread).max().item<double>();
}

class ReferenceRenders : public testing::Test {
 protected:
  void SetUp() override {
    if (all.empty()) GTEST_SKIP() << "no reference renders at " << kRenders;
  }
  const std::vector<Reference> all = references();
};

/// Whether a few plateaus, wherever they lie, are most of what there is to see: no two z look alike.
bool is_left_to_chance(const Reference& reference) {
  return reference.name == "plaster_1.png" || reference.name == "plaster_2.png";
}

// What a spread over three z leaves open, in 8-bit levels and in log energy. The references' noise
// is another map than ours and has fewer spots.
double level_tolerance(const Reference& reference) {
  if (is_left_to_chance(reference)) return 10;
  return reference.material == "wood" ? 2.5 : 1;  // wherever its few rings meet the highlight
}

double log_energy_tolerance(const Reference& reference) {
  if (is_left_to_chance(reference)) return 0.5;
  const std::string& material = reference.material;
  return material == "leather" || material == "plaster" || material == "metal" ? 0.15 : 0.1;
}

/// Factors that make another material of it: by the size of its features, and by their strength.
struct Changes {
  std::map<std::string, double> size, strength;
};

const Changes& changes(const std::string& material) {
  static const std::map<std::string, Changes> all{
      {"bump", {{{"fsigma", 1.5}}, {{"fscale", 0.5}}}},
      {"leather", {{{"scale", 1.5}}, {{"height", 0.5}}}},
      {"plaster", {{{"scale", 0.3}}, {{"height", 0.5}}}},
      {"flake", {{{"scale", 1.5}}, {{"flakeNDF", 0.7}}}},
      {"metal", {{{"fsigmax", 8}}, {{"roughx", 1.2}}}},  // the scratches themselves are finer than the pixels
      {"wood", {{{"ring_size", 1.5}}, {{"lw_power", 0.7}}}}};
  return all.at(material);
}

TEST_F(ReferenceRenders, HaveTheColoursOfOursAtTheSameParameters) {
  for (const Reference& reference : all)
    EXPECT_LT(excess(ring_means, reference), level_tolerance(reference)) << reference.name;
}

TEST_F(ReferenceRenders, HaveTheDetailOfOursAtTheSameParameters) {
  for (const Reference& reference : all)
    EXPECT_LT(excess(log_detail, reference), log_energy_tolerance(reference)) << reference.name;
}

TEST_F(ReferenceRenders, AreToldApartFromOursAtOtherParameters) {
  for (const Reference& reference : all) {
    if (is_left_to_chance(reference)) continue;
    EXPECT_GT(excess(ring_means, reference, {{"light", 1.1}}), level_tolerance(reference)) << reference.name;
    for (const auto& factors : {changes(reference.material).size, changes(reference.material).strength})
      EXPECT_GT(excess(log_detail, reference, factors), log_energy_tolerance(reference))
          << reference.name << ", " << factors.begin()->first;
  }
}

}  // namespace
}  // namespace patina
