#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/cli/arguments.h"
#include "engine/cli/command.h"
#include "engine/cli/print.h"
#include "engine/format.h"
#include "engine/io/file.h"
#include "engine/io/params_json.h"
#include "engine/io/photo.h"
#include "engine/run/predicted_start.h"
#include "engine/run/threads.h"
#include "engine/sampling/rng.h"

namespace patina {
namespace {

constexpr int kDraws = 1000;          // that a spread is measured by
constexpr double kSaysNothing = 0.9;  // of the prior's sd, as for a posterior

struct PredictOptions {
  std::filesystem::path photo, out;
  std::string material, crop;
  CaptureArguments capture;
  bool json = false;
};

/// Standard deviations of the predicted parameters, in their units.
Eigen::VectorXd spreads(const Prediction& prediction) {
  Rng rng(1);
  Eigen::MatrixXd draws(kDraws, prediction.mean.size());
  for (Eigen::Index i = 0; i < kDraws; ++i) {
    const ParameterValues drawn = prediction.draw(rng);
    draws.row(i) = Eigen::Map<const Eigen::RowVectorXd>(drawn.continuous.data(), draws.cols());
  }
  return (draws.rowwise() - draws.colwise().mean()).colwise().norm() / std::sqrt(kDraws - 1.0);
}

nlohmann::ordered_json as_json(const Prediction& prediction) {
  const ParameterValues values = prediction.likeliest();
  const Eigen::VectorXd sds = spreads(prediction);
  nlohmann::ordered_json parameters = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < values.continuous.size(); ++i)
    parameters[prediction.table.continuous[i].name] = {{"value", values.continuous[i]},
                                                       {"sd", sds[static_cast<Eigen::Index>(i)]}};
  for (std::size_t i = 0; i < values.discrete.size(); ++i)
    parameters[prediction.table.discrete[i].name] = {
        {"value", values.discrete[i]},
        {"probability", prediction.level_probabilities[i][values.discrete[i]]}};
  return {{"material", prediction.table.material}, {"parameters", parameters}};
}

std::string as_text(const Prediction& prediction) {
  const ParameterValues values = prediction.likeliest();
  const Eigen::VectorXd sds = spreads(prediction), of_prior = prediction.deviations();
  std::string text;
  for (std::size_t i = 0; i < values.continuous.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    text += format("%-16s %10.4g +- %-10.3g %s\n", prediction.table.continuous[i].name.c_str(),
                   values.continuous[i], sds[k], of_prior[k] > kSaysNothing ? "as before the photo" : "");
  }
  for (std::size_t i = 0; i < values.discrete.size(); ++i) {
    const DiscreteParameter& choice = prediction.table.discrete[i];
    const int level = values.discrete[i];
    text += format("%-16s %10s, at %.0f %%\n", choice.name.c_str(),
                   choice.levels[static_cast<std::size_t>(level)].c_str(),
                   100 * prediction.level_probabilities[i][level]);
  }
  return text;
}

int predict(const PredictOptions& options) {
  use_tensor_threads(hardware_threads());
  check_material_argument(options.material);
  PhotoOptions photo;
  if (!options.crop.empty()) photo.crop = parse_crop(options.crop);
  const Prediction prediction =
      prediction_for(options.material, load_photo(options.photo, photo).image, options.capture.capture());
  if (!options.out.empty())
    write_file_atomically(options.out, params_to_json(prediction.table, prediction.likeliest()));
  if (options.json)
    print(as_json(prediction));
  else
    print(as_text(prediction));
  return kDone;
}

}  // namespace

void add_predict(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<PredictOptions>();
  CLI::App& command =
      *app.add_subcommand("predict", "A first guess at a photo's parameters, by a trained network, at once");
  command.add_option("PHOTO", options->photo, "Flash photo of a flat sample, seen from above")->required();
  command.add_option("--material", options->material, "The material's name")->type_name("NAME");
  command
      .add_option("--crop", options->crop,
                  "Square of the photo to use, in its pixels from the top left (default: the central square)")
      ->type_name("X,Y,SIDE");
  options->capture.add_to(command);
  command
      .add_option("--out", options->out,
                  "Where to write the parameters, as export does: for render --params, or fit --start")
      ->type_name("FILE.json");
  command.add_flag("--json", options->json, "Print one JSON document");
  command.callback([options, &chosen] { chosen = [options] { return predict(*options); }; });
}

}  // namespace patina
