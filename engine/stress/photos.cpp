#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "engine/io/photo.h"
#include "engine/io/temporary_folder.h"
#include "engine/material/registry.h"
#include "engine/material/renderer.h"
#include "engine/posterior/prior_transform.h"
#include "engine/run/manifest_phase.h"
#include "engine/run/run.h"
#include "engine/run/stopwatch.h"
#include "engine/stress/scenarios.h"
#include "engine/stress/spoil.h"

namespace patina {
namespace {

constexpr int kPhotoSide = 128, kResolution = 64;  // pixels
constexpr std::uint64_t kZSeed = 20;               // of the photo; the run has another

/// A photo that should be matched, and what of it is known.
struct Case {
  std::string material;  ///< that is fitted
  Image photo;
  std::map<std::string, double> truth;  ///< by name, of the parameters that the answer is judged by
};

/// Parameters that are not all at the middle of their priors: half a prior sd to either side.
ParameterValues some_values(const ParameterTable& table) {
  ParameterValues values = prior_location(table);
  for (std::size_t i = 0; i < values.continuous.size(); ++i)
    values.continuous[i] = PriorTransform(table.continuous[i].prior).value(i % 2 == 0 ? 0.5 : -0.5);
  return values;
}

using Change = std::function<double(const Parameter&, double value)>;

/// @param width  of the sample and of the image, in those of a usual photo; camera and light stay
Image render_of(const std::string& material, const ParameterValues& values, double width = 1) {
  const Renderer renderer(material, kZSeed, {width * Capture{}.size_cm, Capture{}.camera_cm});
  return renderer.render(values, static_cast<int>(width * kPhotoSide));
}

/// A render, with some parameters changed, judged by all of them.
Case render_case(const std::string& material, const Change& change) {
  const ParameterTable table = material_table(material);
  ParameterValues values = some_values(table);
  Case made{material, {}, {}};
  for (std::size_t i = 0; i < values.continuous.size(); ++i) {
    const Parameter& parameter = table.continuous[i];
    values.continuous[i] = change(parameter, values.continuous[i]);
    made.truth[parameter.name] = values.continuous[i];
  }
  made.photo = render_of(material, values);
  return made;
}

double unchanged(const Parameter&, double value) { return value; }

/// Those whose name holds a word, at their lowest.
Change lowest(std::vector<std::string> words) {
  return [words = std::move(words)](const Parameter& parameter, double value) {
    for (const std::string& word : words)
      if (parameter.name.find(word) != std::string::npos) return parameter.prior.low;
    return value;
  };
}

/// A render spoiled, judged by its parameters all the same.
using Spoil = std::function<Image(const Image&)>;
Case spoiled(const std::string& material, const Spoil& spoil) {
  Case made = render_case(material, unchanged);
  made.photo = spoil(made.photo);
  return made;
}

std::vector<Draw> run_to_the_end(DrawSource& run) {
  while (!has_ended(run.status().phase)) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  if (run.status().phase == RunPhase::failed) throw std::runtime_error(run.status().message);
  std::vector<Draw> draws = run.take_draws();
  std::erase_if(draws, &Draw::warmup);
  return draws;
}

/// The parameter whose true value is furthest from its mean, in posterior sds.
Error furthest(const RunSummary& summary, const std::map<std::string, double>& truth) {
  Error worst{"", -1, 0};
  for (const QuantitySummary& q : summary.quantities) {
    const auto known = truth.find(q.name);
    if (known == truth.end()) continue;
    const double size = std::abs(q.mean - known->second) / q.sd;
    if (!(size <= worst.size)) worst = {q.name, size, q.mcse_mean / q.sd};
  }
  if (truth.empty()) worst.size = std::numeric_limits<double>::infinity();
  return worst;
}

Evidence try_photo(const Case& posed, const Attempt& attempt) {
  RunSettings settings;
  settings.material = posed.material;
  settings.resolution = kResolution;
  settings.kernel = attempt.kernel;
  settings.seed = attempt.seed;
  settings.warmup = 150;
  settings.draws = 250;
  settings.stop = {};
  Photo photo;
  photo.image = posed.photo;
  photo.original_width = photo.original_height = posed.photo.width;
  const TemporaryFolder folder;
  const auto run = start_run(settings, photo, folder.path() / "run");
  Evidence evidence;
  evidence.summary = summarize_draws(run->table(), run_to_the_end(*run));
  evidence.alarms = run->status().alarms;
  evidence.alarms.insert(evidence.alarms.end(), evidence.summary.alarms.begin(),
                         evidence.summary.alarms.end());
  evidence.error = furthest(evidence.summary, posed.truth);
  evidence.limit = 3;
  evidence.is_short = true;
  return evidence;
}

Scenario photo_scenario(std::string name, std::string what, std::function<Case()> pose) {
  return {std::move(name), std::move(what), "render", [pose = std::move(pose)](const Attempt& attempt) {
            const Case posed = pose();
            double seconds = 0;
            Evidence evidence;
            {
              const Stopwatch stopwatch(seconds);
              evidence = try_photo(posed, attempt);
            }
            evidence.seconds = seconds;
            return evidence;
          }};
}

/// A render of another material: no parameters of this one are known.
Case of_another(const std::string& material) {
  const std::string other = material == "wood" || material == "metal" ? "leather" : "wood";
  return {material, render_of(other, some_values(material_table(other))), {}};
}

/// A render under light of another colour: no photo tells it from a surface of another colour, so that it is
/// judged by all that is no colour.
Case tinted(const std::string& material, double r, double g, double b) {
  Case made = spoiled(material, [=](const Image& photo) { return exposed(photo, r, g, b); });
  std::erase_if(made.truth, [](const auto& parameter) {
    const std::string& name = parameter.first;
    return name.ends_with("_r") || name.ends_with("_g") || name.ends_with("_b");
  });
  return made;
}

/// A render exposed to so many times the light, which is what `light` says of such a photo.
Case exposed_to(const std::string& material, double times) {
  Case made = spoiled(material, [=](const Image& photo) { return exposed(photo, times, times, times); });
  made.truth.at("light") *= times;
  return made;
}

/// A part of a photo that shows more of the same surface, under the same light.
Case part_of_wider(const std::string& material, const Spoil& part) {
  Case made = render_case(material, unchanged);
  made.photo = part(render_of(material, some_values(material_table(material)), 1.5));
  return made;
}

}  // namespace

std::vector<Scenario> photo_scenarios(const std::string& m) {
  const auto spoil = [&](const char* name, const char* what, const Spoil& change) {
    return photo_scenario(name, what, [=] { return spoiled(m, change); });
  };
  const auto wider = [&](const char* name, const char* what, const Spoil& part) {
    return photo_scenario(name, what, [=] { return part_of_wider(m, part); });
  };
  const auto light = [&](const char* name, const char* what, double times) {
    return photo_scenario(name, what, [=] { return exposed_to(m, times); });
  };
  return {
      photo_scenario("photo", "a photo that nothing is wrong with",
                     [=] { return render_case(m, unchanged); }),
      photo_scenario("smooth", "every roughness at its smallest",
                     [=] {
                       return render_case(m, lowest({"rough", "Rough"}));
                     }),
      photo_scenario("flat", "no bumps at all",
                     [=] {
                       return render_case(m, lowest({"fscale", "height", "fsigma"}));
                     }),
      light("black", "a photo in the dark", 0.001),
      light("underexposed", "a twentieth of the light", 0.05),
      light("saturated", "thirty times the light", 30),
      photo_scenario("constant", "one grey, nothing else",
                     [=] {
                       return Case{m, grey(kPhotoSide, 0.5F), {}};
                     }),
      photo_scenario("wrong material", "a photo of another material", [=] { return of_another(m); }),
      wider("tilted", "a sample tilted by 25 degrees",
            [](const Image& i) { return tilted(i, 25, kPhotoSide); }),
      wider("flash off centre", "a crop whose highlight is at a corner's side",
            [](const Image& i) { return cropped(i, 0, 0, kPhotoSide); }),
      photo_scenario("white balance", "red doubled, blue halved; judged by all but colours",
                     [=] { return tinted(m, 2, 1, 0.5); }),
      spoil("blurred", "out of focus by two pixels", [](const Image& i) { return blurred(i, 2); }),
      spoil("over-sharpened", "an unsharp mask of 300 %",
            [](const Image& i) { return sharpened(i, 1.5, 3); }),
      spoil("downscaled", "a fifth of the pixels, scaled up again",
            [](const Image& i) { return downscaled(i, kPhotoSide / 5); }),
  };
}

}  // namespace patina
