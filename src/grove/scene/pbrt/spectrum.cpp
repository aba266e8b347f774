// Spectra to RGB by integration against the CIE 1931 colour matching functions, in the analytic fit of
//   Wyman, Sloan, Shirley 2013, "Simple Analytic Approximations to the CIE XYZ Color Matching Functions" (multi-lobe fit, listing 1).
// pbrt renders with spectra; we reduce them once, when the scene is read.

#include "grove/scene/pbrt/spectrum.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <system_error>
#include <vector>

#include "grove/scene/pbrt/named_spectra.h"
#include "grove/scene/pbrt/numbers.h"
#include "grove/scene/read_file.h"

namespace grove::pbrt {
namespace {

constexpr float kFirstWavelength = 360.0F;
constexpr float kLastWavelength = 830.0F;
// Far more than any measured spectrum has; the whole file is read into memory.
constexpr std::uintmax_t kMaxSpectrumFile = 1U << 20;

float lobe(float wavelength, float centre, float width_below, float width_above) {
  const float t = (wavelength - centre) / (wavelength < centre ? width_below : width_above);
  return std::exp(-0.5F * t * t);
}

Vec3 matching_functions(float w) {
  return {1.056F * lobe(w, 599.8F, 37.9F, 31.0F) + 0.362F * lobe(w, 442.0F, 16.0F, 26.7F) - 0.065F * lobe(w, 501.1F, 20.4F, 26.2F),
          0.821F * lobe(w, 568.8F, 46.9F, 40.5F) + 0.286F * lobe(w, 530.9F, 16.3F, 31.1F),
          1.217F * lobe(w, 437.0F, 11.8F, 36.0F) + 0.681F * lobe(w, 459.0F, 26.0F, 13.8F)};
}

/// The spectrum's XYZ; `one` is that of the spectrum that is 1 everywhere.
template <typename Spectrum>
Vec3 integrate(const Spectrum& spectrum, Vec3& one) {
  Vec3 xyz(0.0F);
  one = Vec3(0.0F);
  for (float w = kFirstWavelength; w <= kLastWavelength; w += 1.0F) {
    const Vec3 m = matching_functions(w);
    xyz += spectrum(w) * m;
    one += m;
  }
  return xyz;
}

Vec3 with_luminance_one(const Vec3& xyz) {
  if (!(xyz.y > 0.0F) || !std::isfinite(xyz.x + xyz.y + xyz.z)) return Vec3(0.0F);
  return glm::max(xyz_to_rgb(xyz / xyz.y), Vec3(0.0F));
}

float piecewise_linear(std::span<const float> pairs, float wavelength) {
  const std::size_t count = pairs.size() / 2;
  std::size_t low = 0, high = count;  // the first entry beyond the wavelength
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (pairs[2 * middle] <= wavelength) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  if (low == 0) return pairs[1];
  if (low == count) return pairs[2 * count - 1];
  const float t = (wavelength - pairs[2 * low - 2]) / (pairs[2 * low] - pairs[2 * low - 2]);
  return (1.0F - t) * pairs[2 * low - 1] + t * pairs[2 * low + 1];
}

void check_pairs(const std::vector<float>& pairs, const std::function<void(std::string_view)>& fail) {
  if (pairs.empty() || pairs.size() % 2 != 0) fail("a spectrum takes pairs of wavelength and value");
  for (std::size_t i = 0; i < pairs.size(); i += 2) {
    if (!std::isfinite(pairs[i]) || !std::isfinite(pairs[i + 1])) fail("a spectrum must have finite numbers");
    if (i > 0 && !(pairs[i] > pairs[i - 2])) fail("the wavelengths of a spectrum must ascend");
  }
}

std::vector<float> read_spectrum_file(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (!error && size > kMaxSpectrumFile) throw InputError(file.string(), "", "too large for a spectrum");
  const std::vector<std::byte> bytes = read_file(file);
  Tokenizer tokens(std::make_shared<std::string>(file.string()), std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  std::vector<float> pairs;
  for (Token token = tokens.next(); token.kind != TokenKind::end; token = tokens.next()) {
    const auto value = parse_float(token.text);
    if (!value) tokens.place(token).fail("expected the wavelengths and values of a spectrum");
    pairs.push_back(*value);
  }
  check_pairs(pairs, [&](std::string_view problem) { throw InputError(file.string(), "", problem); });
  return pairs;
}

Vec3 to_rec709(const Vec3& c, ColourSpace space) {
  switch (space) {
    case ColourSpace::dci_p3:
      return {1.2249401F * c.x - 0.2249404F * c.y, -0.0420569F * c.x + 1.0420571F * c.y,
              -0.0196376F * c.x - 0.0786361F * c.y + 1.0982735F * c.z};
    case ColourSpace::rec2020:
      return {1.6604910F * c.x - 0.5876411F * c.y - 0.0728499F * c.z, -0.1245505F * c.x + 1.1328999F * c.y - 0.0083494F * c.z,
              -0.0181508F * c.x - 0.1005789F * c.y + 1.1187297F * c.z};
    case ColourSpace::aces2065_1:
      return {2.5216861F * c.x - 1.1341309F * c.y - 0.3875552F * c.z, -0.2764799F * c.x + 1.3727190F * c.y - 0.0962391F * c.z,
              -0.0153780F * c.x - 0.1529753F * c.y + 1.1683533F * c.z};
    case ColourSpace::srgb:
      break;
  }
  return c;
}

Vec3 limit(const Vec3& c, SpectrumUse use) {
  const Vec3 positive = glm::max(c, Vec3(0.0F));
  return use == SpectrumUse::albedo ? glm::min(positive, Vec3(1.0F)) : positive;
}

Vec3 rgb_value(const Parameter& p, const ParameterList& parameters, SpectrumUse use) {
  if (p.numbers.size() != 3) p.place.fail("\"" + p.name + "\" takes three numbers");
  for (const float x : p.numbers) {
    if (!std::isfinite(x)) p.place.fail("\"" + p.name + "\" must have finite numbers");
  }
  return limit(to_rec709({p.numbers[0], p.numbers[1], p.numbers[2]}, parameters.colour_space()), use);
}

// Version 3 allowed a factor after the temperature.
Vec3 blackbody_value(const Parameter& p) {
  if (p.numbers.size() > 2) p.place.fail("\"" + p.name + "\" takes a temperature in kelvin");
  for (const float x : p.numbers) {
    if (!std::isfinite(x)) p.place.fail("\"" + p.name + "\" must have finite numbers");
  }
  return blackbody_to_rgb(p.numbers[0]) * (p.numbers.size() == 2 ? p.numbers[1] : 1.0F);
}

// The pairs of a spectrum that is not known by name.
std::vector<float> spectrum_pairs(const Parameter& p, const Context& context) {
  if (p.strings.empty()) {
    check_pairs(p.numbers, [&](std::string_view problem) { p.place.fail("\"" + p.name + "\": " + std::string(problem)); });
    return p.numbers;
  }
  const std::filesystem::path file = resolve_file(context.directory, p.strings[0]);
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    p.place.fail("\"" + p.strings[0] + "\" is neither a named spectrum such as metal-Cu-eta or glass-BK7 nor a file");
  return read_spectrum_file(file);
}

}  // namespace

Vec3 spectrum_to_rgb(std::span<const float> wavelengths_and_values, SpectrumUse use) {
  Vec3 one;
  const Vec3 xyz = integrate([&](float w) { return piecewise_linear(wavelengths_and_values, w); }, one);
  if (use == SpectrumUse::illuminant) return with_luminance_one(xyz);
  // Each channel against its own white, so that a constant spectrum is exactly grey.
  return limit(xyz_to_rgb(xyz) / xyz_to_rgb(one), use);
}

Vec3 blackbody_to_rgb(float kelvin) {
  if (!(kelvin > 0.0F)) return Vec3(0.0F);
  // Planck's law without its constant factor, which the normalisation removes; 1.4388e7 nm K is the second radiation constant.
  const auto planck = [kelvin](float w) {
    const double metres = double{w} * 1e-3;
    return static_cast<float>(1.0 / (std::pow(metres, 5.0) * std::expm1(1.438777e7 / (double{w} * double{kelvin}))));
  };
  Vec3 one;
  return with_luminance_one(integrate(planck, one));
}

std::optional<Vec3> colour(const ParameterList& parameters, std::string_view name, SpectrumUse use, const Context& context) {
  const Parameter* p = parameters.find(name);
  if (p == nullptr) return std::nullopt;
  switch (p->type) {
    case ParameterType::rgb:
      return rgb_value(*p, parameters, use);
    case ParameterType::blackbody:
      return blackbody_value(*p);
    case ParameterType::real:
    case ParameterType::integer:
      return limit(Vec3(parameters.number(name, 0.0F)), use);
    case ParameterType::spectrum:
      break;
    default:
      return std::nullopt;
  }
  if (!p->strings.empty()) {
    if (p->strings.size() != 1) p->place.fail("\"" + p->name + "\" takes the name of one spectrum");
    if (const auto known = named_spectrum(p->strings[0])) return limit(*known, use);
  }
  return spectrum_to_rgb(spectrum_pairs(*p, context), use);
}

std::optional<float> spectral_number(const ParameterList& parameters, std::string_view name, const Context& context) {
  const Parameter* p = parameters.find(name);
  if (p == nullptr) return std::nullopt;
  if (p->type == ParameterType::spectrum && (p->strings.empty() || !named_spectrum(p->strings[0])))
    return piecewise_linear(spectrum_pairs(*p, context), 587.6F);
  const std::optional<Vec3> rgb = colour(parameters, name, SpectrumUse::unbounded, context);
  return rgb ? std::optional<float>(rgb->y) : std::nullopt;
}

}  // namespace grove::pbrt
