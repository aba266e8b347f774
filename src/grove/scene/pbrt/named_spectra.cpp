// The metals are read off the measurements of Johnson and Christy (1972), Rakic (1995), Stephens and Malitson (1952), DeVore (1951)
// and Querry (1985) as refractiveindex.info collects them; the glasses are Schott's nd, under the names that pbrt-v4 uses; the
// illuminants are the chromaticities of CIE 15.

#include "grove/scene/pbrt/named_spectra.h"

#include <array>
#include <string>

namespace grove::pbrt {
namespace {

struct Metal {
  std::string_view name;
  Vec3 eta;
  Vec3 k;
};

const std::array<Metal, 7> kMetals{{{"Ag", {0.1279F, 0.1251F, 0.1401F}, {3.8159F, 3.3322F, 2.6062F}},
                                    {"Al", {1.2549F, 0.9547F, 0.6582F}, {7.3842F, 6.6757F, 5.6435F}},
                                    {"Au", {0.2044F, 0.3547F, 1.3798F}, {3.0346F, 2.6997F, 1.8279F}},
                                    {"Cu", {0.3167F, 0.9649F, 1.1573F}, {3.1108F, 2.5776F, 2.4539F}},
                                    {"CuZn", {0.4440F, 0.5270F, 1.0940F}, {3.6950F, 2.7650F, 1.8290F}},
                                    {"MgO", {1.7360F, 1.7405F, 1.7503F}, {0.0F, 0.0F, 0.0F}},
                                    {"TiO2", {2.8886F, 2.9563F, 3.1196F}, {0.0F, 0.0F, 0.0F}}}};

struct Glass {
  std::string_view name;
  float eta;
};

// pbrt's F5, F10 and F11 are the dense flints SF5, SF10 and SF11.
constexpr std::array<Glass, 7> kGlasses{{{"glass-BK7", 1.5168F},
                                         {"glass-BAF10", 1.6700F},
                                         {"glass-FK51A", 1.4866F},
                                         {"glass-LASF9", 1.8503F},
                                         {"glass-F5", 1.6727F},
                                         {"glass-F10", 1.7283F},
                                         {"glass-F11", 1.7847F}}};

struct Illuminant {
  std::string_view name;
  float x, y;
};

constexpr std::array<Illuminant, 16> kIlluminants{{{"stdillum-A", 0.44757F, 0.40745F},
                                                   {"stdillum-D50", 0.34567F, 0.35850F},
                                                   {"stdillum-D65", 0.31271F, 0.32902F},
                                                   {"illum-acesD60", 0.32168F, 0.33767F},
                                                   {"stdillum-F1", 0.31310F, 0.33727F},
                                                   {"stdillum-F2", 0.37208F, 0.37529F},
                                                   {"stdillum-F3", 0.40910F, 0.39430F},
                                                   {"stdillum-F4", 0.44018F, 0.40329F},
                                                   {"stdillum-F5", 0.31379F, 0.34531F},
                                                   {"stdillum-F6", 0.37790F, 0.38835F},
                                                   {"stdillum-F7", 0.31292F, 0.32933F},
                                                   {"stdillum-F8", 0.34588F, 0.35875F},
                                                   {"stdillum-F9", 0.37417F, 0.37281F},
                                                   {"stdillum-F10", 0.34609F, 0.35986F},
                                                   {"stdillum-F11", 0.38052F, 0.37713F},
                                                   {"stdillum-F12", 0.43695F, 0.40441F}}};

}  // namespace

Vec3 xyz_to_rgb(const Vec3& xyz) {
  return {3.2404542F * xyz.x - 1.5371385F * xyz.y - 0.4985314F * xyz.z, -0.9692660F * xyz.x + 1.8760108F * xyz.y + 0.0415560F * xyz.z,
          0.0556434F * xyz.x - 0.2040259F * xyz.y + 1.0572252F * xyz.z};
}

Vec3 chromaticity_to_rgb(float x, float y) {
  return glm::max(xyz_to_rgb({x / y, 1.0F, (1.0F - x - y) / y}), Vec3(0.0F));
}

std::optional<Vec3> named_spectrum(std::string_view name) {
  for (const Metal& metal : kMetals) {
    const std::string stem = "metal-" + std::string(metal.name);
    if (name == stem + "-eta") return metal.eta;
    if (name == stem + "-k") return metal.k;
  }
  for (const Glass& glass : kGlasses) {
    if (name == glass.name) return Vec3(glass.eta);
  }
  for (const Illuminant& illuminant : kIlluminants) {
    if (name == illuminant.name) return chromaticity_to_rgb(illuminant.x, illuminant.y);
  }
  return std::nullopt;
}

}  // namespace grove::pbrt
