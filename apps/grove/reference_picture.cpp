#include "reference_picture.h"

#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "frame_names.h"

namespace grove::app {

void ReferencePicture::add_option(CLI::App& verb) {
  verb.add_option("--compare", file_, "Say how far the picture is from this one (.exr, .hdr or .pfm of the same size): RMSE, relMSE, FLIP")
      ->type_name("FILE");
}

ReferencePicture ReferencePicture::of_frame(std::uint32_t number) const {
  ReferencePicture result;
  if (is_named()) result.file_ = frame_name(file_.string(), number, "--compare");
  return result;
}

bool ReferencePicture::differs_by_frame() const {
  return is_named() && has_frame_number(file_.string(), "--compare");
}

void ReferencePicture::read(std::uint32_t width, std::uint32_t height) {
  if (!file_.empty()) image_ = read_reference(file_, width, height);
}

void ReferencePicture::compare(const ColourImage& picture, const DisplaySettings& display, const Console& console) {
  if (!image_) return;
  console.status("comparing with " + file_.string());
  difference_ = compare_pictures(*image_, picture, std::exp2(display.exposure), display.tone_map);
  console.say("difference " + text());
}

std::string ReferencePicture::text() const {
  if (!difference_) return {};
  return fmt::format("RMSE {:.4g}, relMSE {:.4g}, FLIP {:.4g}, HDR-FLIP {:.4g}, mean {:+.2f} % against {}", difference_->rmse,
                     difference_->relative_mse, difference_->flip, difference_->hdr_flip, 100.0 * difference_->relative_bias,
                     file_.string());
}

nlohmann::ordered_json ReferencePicture::figures() const {
  if (!difference_) return nullptr;
  return {{"reference", file_.string()}, {"rmse", difference_->rmse},         {"relative_mse", difference_->relative_mse},
          {"flip", difference_->flip},   {"hdr_flip", difference_->hdr_flip}, {"relative_bias", difference_->relative_bias}};
}

}  // namespace grove::app
