#pragma once

#include "grove/render/denoise/guides.h"
#include "grove/render/denoise/illumination.h"

namespace grove {

/// What tells how bright areas of a picture are, with how sure it is of each pixel.
struct BrightnessEvidence {
  Illumination samples;  ///< of all samples there are
  /// Where lights may have changed meanwhile, those of the newest frame alone; else empty. An area whose newest samples differ from all by more than noise explains (two standard deviations, and
  /// for certain from 2.8 on) goes by them.
  Illumination newest;

  [[nodiscard]] bool has_newest() const { return !newest.red.empty(); }
};

/// Gives filtered light the brightness that the samples bear out: over areas of the picture large enough to be sure of it, `filtered` times albedo is to have the sum of the samples times albedo, whose
/// variances tell how sure that is. A filter that is led by luminance leaves out what is rare and bright (so does limiting fireflies), and a picture would come out too dark.
///
/// The ratio of the two is found in cells of 8 x 8 pixels, of 16 x 16, and so on to the whole picture, and for each cell drawn from that of the cell around it as far as its own relative
/// standard error is below `kTrustedError`; between cells it is interpolated. What the whole picture then lacks or has too much goes to where it is not sure. What is sure down to single cells (many samples, or none filtered) is scaled by a ratio near 1.
/// O(pixels); the same for any number of threads.
void keep_brightness(const BrightnessEvidence& evidence, const Guides& guides, Illumination& filtered);

}  // namespace grove
