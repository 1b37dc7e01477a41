#include <ATen/TensorOperators.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/scalar_tensor.h>
#include <ATen/ops/tensor.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "engine/material/wood_maps.h"
#include "materials_fixture.h"
#include "one_pass.h"

namespace patina {
namespace {

using Inputs = std::vector<at::Tensor>;

class WoodInOnePass : public testing::Test {
 protected:
  /// The middle of the prior but for these.
  std::vector<double> parameters(const std::map<std::string, double>& but = {}) const {
    std::vector<double> values = prior_location(table_).continuous;
    for (const auto& [name, value] : but) values[*table_.find_continuous(name)] = value;
    return values;
  }

  at::Tensor grain(int n, at::ScalarType type) const {
    return (at::arange((n + 1) * (n + 1), type) * 0.37).sin().view({n + 1, n + 1});
  }

  /// One field of all that a cut shows.
  template <class F>
  at::Tensor maps(const F& of, const Inputs& parameters, int n, double size_cm) const {
    const WoodMaps made = of(parameters, noise_, grain(n, parameters.front().scalar_type()), size_cm);
    return at::cat({made.color.flatten(), made.height.flatten(), made.roughness.flatten()});
  }

  void expect_as_by_tensors(const std::map<std::string, double>& but, int n = 37, double size_cm = 3) const {
    std::string what = std::to_string(n) + " pixels, " + std::to_string(size_cm) + " cm";
    for (const auto& [name, value] : but) what += ", " + name + " " + std::to_string(value);
    SCOPED_TRACE(what);
    Inputs inputs;
    for (const double value : parameters(but)) inputs.push_back(at::scalar_tensor(value, at::kDouble));
    expect_same_by_scalars([&](const Inputs& i) { return maps(wood_maps, i, n, size_cm); },
                           [&](const Inputs& i) { return maps(wood_maps_by_tensors, i, n, size_cm); },
                           inputs);
  }

  const ParameterTable table_ = make_material("wood")->table();
  const WoodNoise noise_ = shared_irregularities().wood();
};

TEST_F(WoodInOnePass, EqualsTensorOperationsWithItsGradientAtManySizes) {
  for (const int n : {16, 37, 64, 129}) expect_as_by_tensors({}, n);
}

TEST_F(WoodInOnePass, EqualsTensorOperationsAtEveryWidthOfRings) {
  for (const double size_cm : {0.5, 3.0, 9.0, 25.0}) expect_as_by_tensors({}, 37, size_cm);
}

TEST_F(WoodInOnePass, EqualsTensorOperationsAtEveryProfileOfARing) {
  // Ramps that end before the next ring or not, that meet before the top, and steep ones.
  for (const auto& [early, late, fraction] :
       {std::array{0.2, 0.2, 0.5}, {0.4, 0.1, 0.1}, {0.2, 0.4, 0.9}, {0.4, 0.4, 0.35}, {0.05, 0.06, 0.5}})
    expect_as_by_tensors({{"ew_ramp_width", early}, {"lw_ramp_width", late}, {"lw_fraction", fraction}});
}

TEST_F(WoodInOnePass, EqualsTensorOperationsAtEveryMixtureOfLevelsOfNoise) {
  for (const auto& [scale, angle] :
       {std::pair{0.4, 20.0}, {11.0, 1.0}, {11.0, 20.0}, {40.0, 1.0}, {40.0, 88.0}, {3000.0, 88.0}})
    expect_as_by_tensors({{"ssn_scale", scale}, {"cut_angle", angle}, {"ssn_power", 0.7}});
  for (const double scale : {0.3, 9.0, 40.0, 3000.0}) expect_as_by_tensors({{"grn_scale", scale}});
}

TEST_F(WoodInOnePass, EqualsTensorOperationsWithinACellOfGnarlAndAcrossPeriods) {
  for (const double scale : {0.05, 2.0, 20.0})
    expect_as_by_tensors({{"gdn_scale", scale}, {"gdn_amplitude", 0.3}});
}

TEST_F(WoodInOnePass, EqualsTensorOperationsWhereBlocksOfRowsMeet) {
  // Rings that bend from row to row, so that the step to the next one is not the step before.
  expect_as_by_tensors({{"gdn_scale", 30}, {"gdn_amplitude", 0.3}}, 129);
}

TEST_F(WoodInOnePass, EqualsTensorOperationsWhereRoughnessIsCutOff) {
  expect_as_by_tensors({{"rough", 0.9}, {"ew_rough", 0.3}});
}

/// Of parameters in float32, as they are.
WoodMaps maps_of(const std::vector<double>& parameters, const WoodNoise& noise, const at::Tensor& grain) {
  return wood_maps(at::tensor(parameters, at::kFloat), noise, grain, 3);
}

TEST_F(WoodInOnePass, OfAPlaceThatIsNoNumberIsNoneAndReadsNothingOutsideOfTheNoise) {
  for (const float odd :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1e30F})
    for (const char* name : {"center_x", "center_z", "ring_size", "ssn_scale", "grn_scale", "gdn_scale"})
      maps_of(parameters({{name, static_cast<double>(odd)}}), noise_, grain(17, at::kFloat));
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto all_none = [](const at::Tensor& map) { return map.isnan().all().item<bool>(); };
  EXPECT_TRUE(all_none(maps_of(parameters({{"center_x", none}}), noise_, grain(17, at::kFloat)).color));
  for (const char* name : {"center_y", "center_z", "ring_size", "ssn_scale", "grn_scale", "gdn_scale"}) {
    const WoodMaps made = maps_of(parameters({{name, none}}), noise_, grain(17, at::kFloat));
    EXPECT_TRUE(all_none(made.color) || all_none(made.height)) << name;
  }
}

TEST_F(WoodInOnePass, OfBlackWoodIsBlackWithANumberForItsGradient) {
  const at::Tensor black =
      at::tensor(parameters({{"albedo_r", 0}, {"albedo_g", 0}, {"albedo_b", 0}, {"ssn_power", 0}}),
                 at::kFloat)
          .set_requires_grad(true);
  const WoodMaps made = wood_maps(black, noise_, grain(17, at::kFloat), 3);
  made.color.sum().backward();
  EXPECT_LT(made.color.max().item<float>(), 1e-6F);
  EXPECT_TRUE(black.grad().isfinite().all().item<bool>());
}

}  // namespace
}  // namespace patina
